package it.unibo.collektive.aggregate.api

/**
 * Excludes a declaration and everything inside it from the compiler plugin.
 *
 * @property explanation the reason why this is safe.
 */
@Target(
    AnnotationTarget.FILE,
    AnnotationTarget.CLASS,
    AnnotationTarget.FUNCTION,
    AnnotationTarget.PROPERTY,
    AnnotationTarget.PROPERTY_GETTER,
    AnnotationTarget.CONSTRUCTOR,
)
@Retention(AnnotationRetention.BINARY)
public annotation class CollektiveIgnore(val explanation: String)
