package org.collektive.generator

/** The version of the product, which generated C# names: the editor asks to generate code of another version again. */
internal const val VERSION: String = "0.2.0"
