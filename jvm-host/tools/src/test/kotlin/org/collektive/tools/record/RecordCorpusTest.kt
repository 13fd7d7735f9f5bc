package org.collektive.tools.record

import org.collektive.host.ProbeJars
import org.collektive.host.Step
import org.collektive.host.TestSession
import org.collektive.host.TestShim
import org.collektive.host.record.Chunk
import org.collektive.host.record.RecordWriter
import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.TestFactory
import org.junit.jupiter.api.io.TempDir
import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.nio.file.Files
import java.nio.file.Path
import kotlin.io.path.name
import kotlin.io.path.readBytes
import kotlin.io.path.writeBytes
import kotlin.test.assertEquals

/** Runs the corpus of `./collektive test --fuzz` for records, which contains a seed and an input for each bug that fuzzing found. */
class RecordCorpusTest {
    @field:TempDir
    lateinit var folder: Path

    @TestFactory
    fun `the reader passes on all records of the corpus`(): List<DynamicTest> {
        val files = Files.list(CORPUS).use { it.sorted().toList() }
        return files.map { DynamicTest.dynamicTest(it.name) { RecordFuzzer.run(it.readBytes()) } }
    }

    @Test
    fun `the seed is a record of the current format`() {
        val seed = CORPUS.resolve("record-plain")
        if (System.getProperty("collektive.seeds") == "write") seed.writeBytes(RecordFuzzer.sealed(withoutJar(recorded())))
        assertEquals(TICKS, RecordFuzzer.run(seed.readBytes()), "$seed: write it again with -Dcollektive.seeds=write")
    }

    private fun recorded(): ByteArray {
        val file = folder.resolve("seed.clkrec")
        val session = TestSession(TestShim())
        check(session.open(jars = listOf(ProbeJars.harmless.toString()), record = file.toString()) >= 0)
        for (tick in 1L..TICKS) {
            session.ok(
                Step(tick).apply {
                    if (tick == 1L) added = List(3) { Step.Added(it) }
                    linked = listOf(0 to 1, 1 to 2)
                    due = listOf(0, 1, 2)
                    if (tick == 2L) wind = 1f
                },
            )
        }
        session.close()
        return file.readBytes()
    }

    /** Replaces the jar with two bytes, because it is the largest part of a record, and the reader does not interpret it. */
    private fun withoutJar(record: ByteArray): ByteArray {
        val bytes = ByteBuffer.wrap(record).order(ByteOrder.LITTLE_ENDIAN)
        var at = RecordWriter.MAGIC.size
        while (bytes.getInt(at) != Chunk.JAR) at += Chunk.HEADER_BYTES + bytes.getInt(at + Int.SIZE_BYTES)
        val end = at + Chunk.HEADER_BYTES + bytes.getInt(at + Int.SIZE_BYTES)
        val kept = Chunk.HEADER_BYTES + Int.SIZE_BYTES + bytes.getInt(at + Chunk.HEADER_BYTES) + 2
        bytes.putInt(at + Int.SIZE_BYTES, kept - Chunk.HEADER_BYTES)
        return record.copyOf(at + kept) + record.copyOfRange(end, record.size)
    }

    private companion object {
        const val TICKS = 3
        val CORPUS: Path = Path.of("src/test/corpus/record")
    }
}
