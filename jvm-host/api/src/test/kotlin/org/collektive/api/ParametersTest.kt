package org.collektive.api

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

class ParametersTest {
    private val parameters = Parameters(mapOf("step" to "1.5", "count" to "3", "loud" to "true", "name" to "x", "shape" to "LINE"))

    private enum class Shape { RING, LINE }

    @Test
    fun `a value is read as text, number, integer, boolean or constant`() {
        assertEquals("1.5", parameters["step"])
        assertEquals(1.5, parameters.double("step"))
        assertEquals(3, parameters.int("count"))
        assertEquals(true, parameters.boolean("loud"))
        assertEquals(Shape.LINE, parameters.enum<Shape>("shape"))
    }

    @Test
    fun `an unknown name throws, and the message lists the known names`() {
        val error = assertFailsWith<NoSuchElementException> { parameters["stpe"] }
        assertEquals("unknown parameter 'stpe'; the program declares [step, count, loud, name, shape]", error.message)
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
        assertEquals(
            "parameter 'name' must be one of [RING, LINE], but is 'x'",
            assertFailsWith<IllegalArgumentException> { parameters.enum<Shape>("name") }.message,
        )
    }
}
