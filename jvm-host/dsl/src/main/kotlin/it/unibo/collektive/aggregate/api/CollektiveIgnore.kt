package it.unibo.collektive.aggregate.api

/** Keeps the compiler plugin away from a declaration (and all within); [reason] tells readers why that is safe. */
@Target(
    AnnotationTarget.FILE,
    AnnotationTarget.CLASS,
    AnnotationTarget.FUNCTION,
    AnnotationTarget.PROPERTY,
    AnnotationTarget.PROPERTY_GETTER,
    AnnotationTarget.CONSTRUCTOR,
)
@Retention(AnnotationRetention.BINARY)
public annotation class CollektiveIgnore(val reason: String)
