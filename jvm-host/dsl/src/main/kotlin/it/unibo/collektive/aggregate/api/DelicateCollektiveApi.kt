package it.unibo.collektive.aggregate.api

/** Marks declarations that can break alignment when misused. The documentation of each names the safe alternative. */
@RequiresOptIn("Can break alignment. Use the alternative in its documentation.", RequiresOptIn.Level.WARNING)
@Retention(AnnotationRetention.BINARY)
@Target(AnnotationTarget.CLASS, AnnotationTarget.FUNCTION, AnnotationTarget.CONSTRUCTOR)
public annotation class DelicateCollektiveApi
