package org.collektive.generator

/** `home_position` and `homePosition` as `HomePosition`, the way flatc names C# members and Java getters. */
internal fun upperCamel(name: String): String =
    name.split('_', '-', '.', ' ').filter { it.isNotEmpty() }.joinToString("") { it.replaceFirstChar(Char::uppercaseChar) }

/** [name] in lower camel case. */
internal fun lowerCamel(name: String): String = upperCamel(name).replaceFirstChar(Char::lowercaseChar)
