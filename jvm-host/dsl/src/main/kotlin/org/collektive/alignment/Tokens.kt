package org.collektive.alignment

/** The part of a token that people read, the called function or the arm of a branch; other pivots as text. */
public fun readable(pivot: Any?): String = token(pivot)?.let { it.groupValues[1] } ?: pivot.toString()

/** The place in the program's sources that a token names, `Swarm.kt:12`; `null` for other pivots. */
public fun location(pivot: Any?): String? = token(pivot)?.let { it.groupValues[2] }

private fun token(pivot: Any?): MatchResult? = (pivot as? String)?.let(TOKEN::matchEntire)

private val TOKEN = Regex("([^@]+)@([^@]+:\\d+)#[0-9a-f]{16}")
