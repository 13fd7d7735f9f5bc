package org.collektive.compiler

import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.TestFactory
import kotlin.test.assertEquals

/** Tests that programs in all styles of Kotlin compute the expected results on all kinds of devices. */
class UsersProgramsTest {
    @TestFactory
    fun `user programs give the expected results`(): List<DynamicTest> = expected.map { (name, results) ->
        dynamicTest(name) {
            val program = compiled.program(name)
            for ((route, row) in rows()) {
                if (route == WITHOUT_STACK && name in NEED_STACK) continue
                val last = List(ROUNDS) { row.round(program).values.toList() }.last()
                assertEquals(results, last.toString(), route)
            }
        }
    }

    private companion object {
        const val ROUNDS = 12

        /** On devices without AlignmentStack, fields in loops clash, and fields in functions called in a branch are not restricted. */
        val NEED_STACK = setOf("containersOfFields", "propertiesOfFields")

        val source = checkNotNull(UsersProgramsTest::class.java.getResource("UsersPrograms.kt")).readText()

        val compiled = Compilation.of(source)

        /** The expected answers of the devices, by program. */
        val expected: Map<String, String> =
            Regex("// = (.*)\nfun Aggregate<Int>\\.(\\w+)\\(").findAll(source).associate { it.groupValues[2] to it.groupValues[1] }
    }
}
