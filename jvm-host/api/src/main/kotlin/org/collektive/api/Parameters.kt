package org.collektive.api

/** The parameters that a program declares, by name, with one node's values. Immutable; safe on any thread. */
public class Parameters(values: Map<String, String>) {
    private val names = values.keys.toTypedArray()
    private val texts = values.values.toTypedArray()

    // Parsed once: programs read parameters in every round.
    private val numbers = Array(texts.size) { texts[it].toDoubleOrNull() }

    /**
     * The text of the parameter [name].
     *
     * @throws NoSuchElementException when the program declares no such parameter; so do [double], [int] and [boolean].
     */
    public operator fun get(name: String): String = texts[indexOf(name)]

    /**
     * The parameter [name] as a number.
     *
     * @throws IllegalArgumentException when its text is not a number.
     */
    public fun double(name: String): Double {
        val index = indexOf(name)
        return requireNotNull(numbers[index]) { "parameter '$name' must be a number, but is '${texts[index]}'" }
    }

    /**
     * The parameter [name] as a whole number.
     *
     * @throws IllegalArgumentException when its text is not a whole number in the range of [Int].
     */
    public fun int(name: String): Int {
        val number = double(name)
        require(number == number.toInt().toDouble()) { "parameter '$name' must be a whole number, but is '${get(name)}'" }
        return number.toInt()
    }

    /**
     * The parameter [name] as a switch.
     *
     * @throws IllegalArgumentException when its text is neither `true` nor `false`.
     */
    public fun boolean(name: String): Boolean =
        requireNotNull(get(name).toBooleanStrictOrNull()) { "parameter '$name' must be true or false, but is '${get(name)}'" }

    private fun indexOf(name: String): Int {
        val index = names.indexOf(name)
        if (index < 0) throw NoSuchElementException("the program declares no parameter '$name', only ${names.asList()}")
        return index
    }
}
