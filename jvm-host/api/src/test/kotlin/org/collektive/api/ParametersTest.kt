package org.collektive.api

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

class ParametersTest {
    private val parameters = Parameters(mapOf("step" to "1.5", "count" to "3", "loud" to "true", "name" to "x"))

    @Test
    fun `a value is read as text, number, integer or boolean`() {
        assertEquals("1.5", parameters["step"])
        assertEquals(1.5, parameters.double("step"))
        assertEquals(3, parameters.int("count"))
        assertEquals(true, parameters.boolean("loud"))
    }

    @Test
    fun `an unknown name throws, and the message lists the known names`() {
        val error = assertFailsWith<NoSuchElementException> { parameters["stpe"] }
        assertEquals("unknown parameter 'stpe'; the program declares [step, count, loud, name]", error.message)
    }

    @Test
    fun `a text of another kind throws, and the message quotes the text`() {
        assertEquals(
            "parameter 'name' must be a number, but is 'x'",
            assertFailsWith<IllegalArgumentException> { parameters.double("name") }.message,
        )
        assertEquals(
            "parameter 'step' must be an integer, but is '1.5'",
            assertFailsWith<IllegalArgumentException> { parameters.int("step") }.message,
        )
        assertEquals(
            "parameter 'count' must be true or false, but is '3'",
            assertFailsWith<IllegalArgumentException> { parameters.boolean("count") }.message,
        )
    }
}
