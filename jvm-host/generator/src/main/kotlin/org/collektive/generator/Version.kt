package org.collektive.generator

/** The version of the product. Generated C# contains it, and the editor asks users to regenerate code that another version generated. */
internal const val VERSION: String = "0.2.0"
