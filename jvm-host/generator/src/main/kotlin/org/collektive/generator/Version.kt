package org.collektive.generator

/** The version of the product. Generated C# contains it, and the editor asks to regenerate code of other versions. */
internal const val VERSION: String = "0.2.0"
