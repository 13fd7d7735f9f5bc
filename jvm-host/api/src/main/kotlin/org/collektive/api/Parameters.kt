package org.collektive.api

import kotlin.enums.enumEntries

/** One node's values of the parameters that its program declares. Immutable and thread-safe. */
public class Parameters(values: Map<String, String>) {
    private val names = values.keys.toTypedArray()
    private val texts = values.values.toTypedArray()

    // Numbers are parsed only once, because programs read parameters in every round.
    private val numbers = Array(texts.size) { texts[it].toDoubleOrNull() }

    /**
     * Returns the text of the parameter [name].
     *
     * @throws NoSuchElementException when the program does not declare the parameter; [double], [int], [boolean] and [enum] throw it, too.
     */
    public operator fun get(name: String): String = texts[indexOf(name)]

    /**
     * Returns the parameter [name] as a number.
     *
     * @throws IllegalArgumentException when its text is not a number.
     */
    public fun double(name: String): Double {
        val index = indexOf(name)
        return requireNotNull(numbers[index]) { "parameter '$name' must be a number, but is '${texts[index]}'" }
    }

    /**
     * Returns the parameter [name] as an integer.
     *
     * @throws IllegalArgumentException when its text is not an integer in the range of [Int].
     */
    public fun int(name: String): Int {
        val number = double(name)
        require(number == number.toInt().toDouble()) { "parameter '$name' must be an integer, but is '${get(name)}'" }
        return number.toInt()
    }

    /**
     * Returns the parameter [name] as a boolean.
     *
     * @throws IllegalArgumentException when its text is neither `true` nor `false`.
     */
    public fun boolean(name: String): Boolean =
        requireNotNull(get(name).toBooleanStrictOrNull()) { "parameter '$name' must be true or false, but is '${get(name)}'" }

    /**
     * Returns the constant of [T] that the parameter [name] names.
     *
     * @throws IllegalArgumentException when [T] has no such constant.
     */
    public inline fun <reified T : Enum<T>> enum(name: String): T {
        val text = get(name)
        val constants = enumEntries<T>()
        return requireNotNull(constants.find { it.name == text }) { "parameter '$name' must be one of $constants, but is '$text'" }
    }

    private fun indexOf(name: String): Int {
        val index = names.indexOf(name)
        if (index < 0) throw NoSuchElementException("unknown parameter '$name'; the program declares ${names.asList()}")
        return index
    }
}
