package org.collektive.generator

/** Converts `home_position` and `homePosition` to `HomePosition`, as flatc names C# members and Java getters. */
internal fun upperCamel(name: String): String =
    name.split('_', '-', '.', ' ').filter { it.isNotEmpty() }.joinToString("") { it.replaceFirstChar(Char::uppercaseChar) }

/** Converts [name] to lower camel case. */
internal fun lowerCamel(name: String): String = upperCamel(name).replaceFirstChar(Char::lowercaseChar)
