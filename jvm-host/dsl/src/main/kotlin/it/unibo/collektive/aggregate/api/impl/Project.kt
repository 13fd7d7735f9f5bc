package it.unibo.collektive.aggregate.api.impl

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.CollektiveIgnore

/** Restricts [field] to the neighbours that are aligned here. The compiler plugin inserts the calls that a program needs. */
@CollektiveIgnore("it implements projection")
public fun <ID : Any, T> project(field: Field<ID, T>): Field<ID, T> = checkNotNull(org.collektive.alignment.project(field, "project", true))
