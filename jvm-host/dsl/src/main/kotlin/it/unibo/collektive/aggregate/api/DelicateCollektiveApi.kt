package it.unibo.collektive.aggregate.api

/** Marks what can break alignment when used carelessly; each declaration names the safe way. */
@RequiresOptIn("Can break alignment; its documentation names the safe way.", RequiresOptIn.Level.WARNING)
@Retention(AnnotationRetention.BINARY)
@Target(AnnotationTarget.CLASS, AnnotationTarget.FUNCTION, AnnotationTarget.CONSTRUCTOR)
public annotation class DelicateCollektiveApi
