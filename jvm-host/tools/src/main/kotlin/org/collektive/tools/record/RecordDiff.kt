package org.collektive.tools.record

import org.collektive.frames.session.types
import org.collektive.host.library.AggregateRuntime
import org.collektive.host.programs.JarBytes
import java.security.MessageDigest

/** Finds the first difference of two records with the same schema. Does not run the code of their jars. */
internal class RecordDiff(private val left: Record, private val right: Record, private val report: Report) {
    private val names = "A" to "B"
    private val runtimes = AggregateRuntime.of(left.settings.runtime()) to AggregateRuntime.of(right.settings.runtime())

    /** Compares the records up to the first difference. Returns whether settings, inputs and outputs are equal. */
    fun run(): Boolean {
        val types = left.settings.types
        for ((name, hash) in types.entries + right.settings.types.entries) {
            if (types[name] != hash || right.settings.types[name] != hash) {
                throw InvalidRecordException("the schemas of the records differ in type $name")
            }
        }
        if (left.settings.schema() != right.settings.schema()) {
            throw InvalidRecordException(
                "the schemas of the records differ: ${left.settings.schema()} in A, ${right.settings.schema()} in B",
            )
        }
        if (runtimes.first != runtimes.second) {
            report.line(
                "different runtimes: the ${runtimes.first.title} in A, the ${runtimes.second.title} in B; their programs' jars are not compared",
            )
        }
        val opened = ofOpen()
        opened?.let { report.line("different settings: $it") }
        return first(RecordedTypes.of(left.settings.schema(), left.jars)) && opened == null
    }

    private fun first(types: RecordedTypes): Boolean {
        var tick = 1L
        while (true) {
            val a = left.next()
            val b = right.next()
            if (a == null && b == null) {
                report.line("${tick - 1} ticks without a difference; the last digest is ${hex(lastDigest)}")
                return true
            }
            val difference = when {
                a == null || b == null -> "the record ${if (a == null) "A" else "B"} ends after tick ${tick - 1}, the other one continues"
                else -> ofSteps(types, a, b)
            }
            if (difference != null) {
                report.line("tick $tick: $difference")
                return false
            }
            if (a?.answer != null) {
                lastDigest = a.answer.response.digest()
                tick++
            }
            report.progress("diff", left)
        }
    }

    private var lastDigest = 0L

    private fun ofSteps(types: RecordedTypes, a: RecordedStep, b: RecordedStep): String? {
        Difference.ofRequests(types, a.request, b.request)?.let { return "input of ${it.line(names)}" }
        ofPrograms(a.jars, b.jars)?.let { return "input of $it" }
        val x = a.answer
        val y = b.answer
        return when {
            x == null && y == null -> null

            x == null -> "it failed in A (${a.failure}) but not in B"

            y == null -> "it failed in B (${b.failure}) but not in A"

            else -> Difference.ofAnswers(types, x, y)?.let { "output of ${it.line(names)}" }
                ?: if (x.response.digest() == y.response.digest()) null else "the digests differ, but all fields are equal"
        }
    }

    private fun ofOpen(): String? {
        Difference.ofOpen(left.settings, right.settings)?.let { return it.line(names) }
        return ofPrograms(left.jars, right.jars)
    }

    private fun ofPrograms(left: List<JarBytes>, right: List<JarBytes>): String? {
        // The runtimes have different compiler plugins, so their jars always differ.
        if (runtimes.first != runtimes.second) return null
        val a = left.joinToString(transform = ::sha256).ifEmpty { "absent" }
        val b = right.joinToString(transform = ::sha256).ifEmpty { "absent" }
        return if (a == b) null else "programs: SHA-256 $a in A, $b in B"
    }
}

internal fun sha256(jar: JarBytes): String = MessageDigest.getInstance("SHA-256").digest(jar.bytes).joinToString("") { "%02x".format(it) }
