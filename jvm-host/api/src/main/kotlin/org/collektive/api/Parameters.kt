package org.collektive.api

/** Parameters of a program by name; all of those it declares, and no others. */
public class Parameters(values: Map<String, String>) {
    private val names = values.keys.toTypedArray()
    private val texts = values.values.toTypedArray()

    // Read once, so that a program may ask in every round.
    private val numbers = Array(texts.size) { texts[it].toDoubleOrNull() }

    /** The text of [name]. @throws NoSuchElementException when the program declares no such parameter. */
    public operator fun get(name: String): String = texts[indexOf(name)]

    /** The number [name]. @throws IllegalArgumentException when its text is not a number. */
    public fun double(name: String): Double {
        val index = indexOf(name)
        return requireNotNull(numbers[index]) { "parameter '$name' must be a number, but is '${texts[index]}'" }
    }

    /** The whole number [name]. @throws IllegalArgumentException when its text is not one. */
    public fun int(name: String): Int {
        val number = double(name)
        require(number == number.toInt().toDouble()) { "parameter '$name' must be a whole number, but is '${get(name)}'" }
        return number.toInt()
    }

    /** The switch [name]. @throws IllegalArgumentException when its text is neither `true` nor `false`. */
    public fun boolean(name: String): Boolean =
        requireNotNull(get(name).toBooleanStrictOrNull()) { "parameter '$name' must be true or false, but is '${get(name)}'" }

    private fun indexOf(name: String): Int {
        val index = names.indexOf(name)
        if (index < 0) throw NoSuchElementException("the program declares no parameter '$name', only ${names.asList()}")
        return index
    }
}
