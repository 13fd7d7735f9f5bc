@file:OptIn(DelicateCollektiveApi::class)

package org.collektive.runtime

import it.unibo.collektive.aggregate.AlignmentClashException
import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.api.share
import kotlinx.serialization.SerializationException
import kotlinx.serialization.json.Json
import org.collektive.alignment.popToken
import org.collektive.alignment.pushToken
import org.collektive.alignment.recordFailure
import org.collektive.testkit.Network
import org.junit.jupiter.api.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertIs
import kotlin.test.assertTrue

/**
 * Tests that the error of a program names the node, the path and the source location, and affects no other node. Runs on all kinds of
 * devices.
 */
class ErrorsTest {
    /** Runs [body] in the way that a compiled program calls a function [name] in [line] of Swarm.kt. */
    private inline fun <R> Aggregate<Int>.call(name: String, line: Int, body: () -> R): R {
        val depth = pushToken(this, "$name@Swarm.kt:$line#0123456789abcdef")
        try {
            return body()
        } catch (failure: Throwable) {
            recordFailure(this, failure)
            throw failure
        } finally {
            popToken(this, depth)
        }
    }

    /**
     * Returns the error of [program] inside `helper`, on the middle node of three in a row. Checks that the rounds before and after it
     * succeed.
     */
    private fun failure(route: String, program: Aggregate<Int>.() -> Any?): Throwable {
        val network = Network(routes.getValue(route)(), 0, 1, 2, isParallel = true).line(0, 1, 2)
        fun outcomes(fails: Boolean) = network.outcomes {
            val count = call("count", 1) { evolve(0) { it + 1 } }
            if (fails && localId == 1) {
                call("helper", 7) { program() }
            } else {
                count to call("near", 2) { neighboring(count).neighbors.list.size }
            }
        }
        repeat(2) { outcomes(fails = false) }
        val failed = outcomes(fails = true)
        assertEquals(listOf<Any?>(3 to 1, 3 to 1), listOf(0, 2).map { failed.getValue(it).getOrThrow() }, "the other nodes' rounds, $route")
        val afterwards = outcomes(fails = false).values.map { it.getOrThrow() }
        assertEquals(listOf<Any?>(4 to 1, 3 to 2, 4 to 1), afterwards, "the next rounds, $route")
        return failed.getValue(1).exceptionOrNull() ?: error("nothing failed, $route")
    }

    private inline fun <reified E : Throwable> assertMessage(what: String, place: String, noinline program: Aggregate<Int>.() -> Any?) =
        routes.keys.forEach { route ->
            val error = assertIs<E>(failure(route, program), route)
            assertContains(error.message.orEmpty(), what, message = route)
            assertTrue(error.message.orEmpty().endsWith(" [$place]"), "$route: ${error.message}")
        }

    @Test
    fun `two primitives at one path`() =
        assertMessage<AlignmentClashException>("alignedOn(key) { }", "node 1 at helper > share (Swarm.kt:9)") {
            call("share", 9) { share(1) { it.local.value } }
            call("share", 9) { share(1) { it.local.value } }
        }

    @Test
    fun `fields of different devices`() =
        assertMessage<IllegalStateException>("one has values for [0, 2, 1], the other for [1]", "node 1 at helper (Swarm.kt:7)") {
            // Other devices do not reach this path.
            val alone = call("alone", 8) { neighboring(2) }
            Field.make(this, arrayOf(0, 2), arrayOf(1, 1), 1).alignedMap(alone) { _, a, b -> a + b }
        }

    @Test
    fun `a value for a device that is not a neighbour`() =
        assertMessage<NoSuchElementException>("no value for device 99, only for [1]", "node 1 at helper (Swarm.kt:7)") {
            call("neighboring", 8) { neighboring(1) }[99]
        }

    @Test
    fun `a field as a value or a result`() {
        assertMessage<IllegalStateException>("a field cannot be a value of a field", "node 1 at helper (Swarm.kt:7)") {
            val field = call("neighboring", 8) { neighboring(1) }
            field.mapToConstant(field)
        }
        assertMessage<IllegalStateException>("alignedOn returned a field", "node 1 at helper > alignedOn > key (Swarm.kt:8)") {
            call("alignedOn", 8) { alignedOn("key") { neighboring(1) } }
        }
    }

    @Test
    fun `a pivot that cannot be a key`() {
        val place = "node 1 at helper (Swarm.kt:7)"
        for (pivot in listOf(intArrayOf(1), arrayOf("a"), { 1 })) {
            assertMessage<IllegalArgumentException>("cannot be a pivot: it is compared by identity", place) {
                alignedOn(pivot) { evolve(0) { it } }
            }
        }
        assertMessage<IllegalArgumentException>("a Field cannot be a pivot", place) {
            val field = call("near", 2) { neighboring(1) }
            alignedOn(field) { evolve(0) { it } }
        }
    }

    @Test
    fun `a pivot without its own toString is rejected when messages are serialised`() {
        class Key
        val error = failure(JSON) { alignedOn(Key()) { evolve(0) { it } } }
        assertContains(error.message.orEmpty(), "cannot be a pivot where messages are serialised: its class does not override toString")
        assertContains(error.message.orEmpty(), "[node 1 at helper > ")
    }

    @Test
    fun `a value that cannot be serialised`() {
        class Plain
        val type = assertIs<SerializationException>(failure(JSON) { call("share", 9) { share(Plain()) { it.local.value } } })
        assertContains(type.message.orEmpty(), "Plain cannot be sent: they have no serializer; mark the class with @Serializable")
        assertTrue(type.message.orEmpty().endsWith("[node 1 at helper > share (Swarm.kt:9)]"), type.message)
        // The mailboxes of these devices serialise a message only when it is read.
        val value = assertFailsWith<SerializationException> {
            failure(JSON) { call("neighboring", 8) { neighboring(Double.NaN) }.local.value }
        }
        assertContains(value.message.orEmpty(), "NaN cannot be sent: ")
        assertTrue(value.message.orEmpty().endsWith("[node 1 at helper > neighboring (Swarm.kt:8)]"), value.message)
    }

    @Test
    fun `infinite recursion`() {
        fun Aggregate<Int>.deeper(): Int = call("deeper", 3) { alignedOn("key") { deeper() } } + 1
        for (route in routes.keys - "in place") {
            val error = assertIs<StackOverflowError>(failure(route) { deeper() })
            val expected =
                Regex(
                    "infinite recursion \\[node 1 at helper > deeper > key > deeper > .* > … \\([0-9,]+ more\\) > .* \\(Swarm.kt:3\\)]",
                )
            assertTrue(expected.matches(error.message.orEmpty()), error.message)
        }
    }

    private companion object {
        const val JSON = "mailboxes with JSON"

        val routes = mapOf(
            "in place" to { AggregateRuntimes() },
            "mailboxes" to { mailboxes(null) },
            JSON to { mailboxes(Json) },
        )
    }
}
