package org.collektive.alignment

/** The readable part of a token: the called function or the arm of a branch. Other pivots are converted with `toString`. */
public fun readable(pivot: Any?): String = token(pivot)?.let { it.groupValues[1] } ?: pivot.toString()

/** The source location that a token names, such as `Swarm.kt:12`; `null` for other pivots and for tokens inside lambda programs. */
public fun location(pivot: Any?): String? = token(pivot)?.let { it.groupValues[2].ifEmpty { null } }

private fun token(pivot: Any?): MatchResult? = (pivot as? String)?.let(TOKEN::matchEntire)

private val TOKEN = Regex("([^@]+)@([^@]+:\\d+)?#[0-9a-f]{16}")
