package org.collektive.conformance.golden

import org.collektive.mailbox.MailboxRuntimes
import org.collektive.runtime.AggregateRuntimes
import org.collektive.spi.DeviceRuntimes
import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.TestFactory
import java.util.zip.GZIPInputStream
import kotlin.math.abs
import kotlin.math.max
import kotlin.test.Test
import kotlin.test.assertEquals

/**
 * Compares our answers with those of Collektive 28.3.2, in every round of every golden program.
 *
 * Programs whose answers differ on purpose are skipped. `Documentation~/from-collektive.md` lists the reasons.
 */
class GoldenTest {
    @Test
    fun `every program has recorded answers`() = assertEquals(answers.keys, programs.keys)

    @TestFactory
    fun `the built-in runtime gives the recorded answers`() = tests(::AggregateRuntimes)

    @TestFactory
    fun `the mailbox runtime gives the recorded answers`() = tests(::MailboxRuntimes)

    private fun tests(runtimes: () -> DeviceRuntimes) = programs.map { (name, program) ->
        DynamicTest.dynamicTest(name) {
            val ours = Topology.entries.flatMap { topology ->
                listOf(false, true).flatMap { GoldenNetwork(topology, it, runtimes()).answers(program) }
            }
            val theirs = answers.getValue(name)
            assertEquals(theirs.size, ours.size, "number of rounds")
            val differing = ours.indices.filter { !isSame(theirs[it], ours[it]) }
            val examples = differing.take(3).map { "round $it: expected ${theirs[it]}, found ${ours[it]}" }
            assertEquals(0, differing.size, "differing rounds of ${ours.size}: $examples")
        }
    }

    /** Returns whether the texts are equal except for the last digits of doubles, which differ because Collektive uses `hypot`. */
    private fun isSame(a: String, b: String): Boolean = a == b || NUMBER.split(a) == NUMBER.split(b) &&
        NUMBER.findAll(a).zip(NUMBER.findAll(b)).all { (x, y) -> isSame(x.value.toDouble(), y.value.toDouble()) }

    private fun isSame(a: Double, b: Double) = abs(a - b) <= 1e-9 * max(abs(a), abs(b))

    private companion object {
        val programs = goldenPrograms + moreGoldenPrograms
        val NUMBER = Regex("""-?\d+\.\d+(E-?\d+)?""")

        val answers: Map<String, List<String>> = buildMap {
            val packed = checkNotNull(GoldenTest::class.java.getResourceAsStream("answers.txt.gz"))
            GZIPInputStream(packed).bufferedReader().useLines { lines ->
                var program = ArrayList<String>()
                for (line in lines) {
                    if (line.startsWith("# ")) program = ArrayList<String>().also { put(line.drop(2), it) } else program += line
                }
            }
        }
    }
}
