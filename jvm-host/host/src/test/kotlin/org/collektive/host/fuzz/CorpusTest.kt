package org.collektive.host.fuzz

import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.TestFactory
import java.nio.ByteBuffer
import java.nio.file.Files
import java.nio.file.Path
import kotlin.io.path.name
import kotlin.io.path.readBytes
import kotlin.io.path.writeBytes
import kotlin.test.assertContentEquals
import kotlin.test.assertTrue

/** Runs the corpus of `./collektive test --fuzz`, which contains seeds and an input for each bug that fuzzing found. */
class CorpusTest {
    @TestFactory
    fun `open passes on all inputs of the corpus`() = replay("open", OpenFuzzer, FuzzSeeds.open)

    @TestFactory
    fun `step passes on all inputs of the corpus`() = replay("step", StepFuzzer, FuzzSeeds.step)

    @TestFactory
    fun `control passes on all inputs of the corpus`() = replay("control", ControlFuzzer, FuzzSeeds.control - "control-recording")

    @Test
    fun `the seeds are frames of the current schema`() {
        for ((entry, seeds) in mapOf("open" to FuzzSeeds.open, "step" to FuzzSeeds.step, "control" to FuzzSeeds.control)) {
            for ((name, frame) in seeds) {
                val file = CORPUS.resolve("$entry/$name")
                if (System.getProperty("collektive.seeds") == "write") file.writeBytes(bytes(frame))
                assertContentEquals(bytes(frame), file.readBytes(), "$file: write it again with -Dcollektive.seeds=write")
            }
        }
    }

    private fun replay(entry: String, fuzzer: Fuzzer, accepted: Map<String, ByteBuffer>): List<DynamicTest> {
        val files = Files.list(CORPUS.resolve(entry)).use { it.sorted().toList() }
        return files.map { file ->
            DynamicTest.dynamicTest(file.name) {
                val isAccepted = fuzzer.run(file.readBytes())
                if (file.name in accepted) assertTrue(isAccepted, "a valid frame must be accepted")
            }
        }
    }

    private fun bytes(frame: ByteBuffer) = ByteArray(frame.capacity()).also { frame.get(0, it) }

    private companion object {
        val CORPUS: Path = Path.of("src/test/corpus")
    }
}
