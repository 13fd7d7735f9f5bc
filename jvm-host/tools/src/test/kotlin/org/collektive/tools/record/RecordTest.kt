package org.collektive.tools.record

import org.collektive.host.Host
import org.collektive.host.ProbeJars
import org.collektive.host.Step
import org.collektive.host.TestSession
import org.collektive.host.TestShim
import org.collektive.host.programs.JarBytes
import org.collektive.host.record.Chunk
import org.collektive.host.record.RecordWriter
import org.collektive.host.shim.HostError
import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import org.junit.jupiter.api.io.TempDir
import java.io.ByteArrayOutputStream
import java.io.PrintStream
import java.io.RandomAccessFile
import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.nio.file.FileSystems
import java.nio.file.Files
import java.nio.file.Path
import java.nio.file.StandardCopyOption.REPLACE_EXISTING
import java.util.zip.CRC32
import kotlin.io.path.appendText
import kotlin.io.path.deleteExisting
import kotlin.io.path.deleteIfExists
import kotlin.io.path.exists
import kotlin.io.path.listDirectoryEntries
import kotlin.io.path.name
import kotlin.io.path.readBytes
import kotlin.io.path.writeBytes
import kotlin.random.Random
import kotlin.test.assertContains
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

@Tag("slow")
@Timeout(120)
class RecordTest {
    private val shim = TestShim()

    @field:TempDir
    lateinit var folder: Path

    /** Records a small swarm whose nodes change in every tick, and returns the file. [change] can alter each tick. */
    private fun record(name: String = "a", ticks: Int = TICKS, jar: Path = ProbeJars.programs, change: Step.() -> Unit = {}): Path {
        val file = folder.resolve("$name.clkrec")
        val session = TestSession(shim)
        check(session.open(jars = listOf(jar.toString()), record = file.toString()) >= 0) { shim.error }
        for (tick in 1..ticks) session.ok(step(tick).apply(change))
        session.close()
        return file
    }

    private fun step(number: Int) = Step(number.toLong()).apply {
        added = if (number == 1) List(NODES) { Step.Added(it) } else listOf(Step.Added(NODES + number))
        linked =
            listOf(number % NODES to (number + 1) % NODES, 0 to NODES + number).filter { (_, to) ->
                added.any { it.id == to } || to < NODES
            }
        due = (0 until NODES).toList()
        sensors = due.map { Step.Sensor(100 * number + it, points = it % 3) }
        wind = if (number % 4 == 0) number.toFloat() else null
    }

    /** The options that select the other runtime. The output folder of the host's build stands in for the folder of Collektive's jars. */
    private val collektive =
        arrayOf("--runtime", "collektive", "--runtime-jars", Path.of(Host::class.java.protectionDomain.codeSource.location.toURI()).parent)

    private class Result(val code: Int, val results: String, val messages: String)

    /** Returns the option with which a replay trusts its record, unless the arguments contain `--own`. */
    private fun trust(arguments: Array<out Any>) =
        if (arguments.firstOrNull() == "replay" && "--own" !in arguments) listOf("--trust") else emptyList()

    private fun run(vararg arguments: Any): Result {
        val results = ByteArrayOutputStream()
        val messages = ByteArrayOutputStream()
        val code = records(arguments.map { it.toString() } + trust(arguments), PrintStream(results), PrintStream(messages))
        return Result(code, results.toString(), messages.toString())
    }

    @Test
    fun `a replay computes the digests of the record`() {
        val result = run("replay", record())
        assertEquals(0, result.code, result.messages)
        assertContains(result.results, "$TICKS ticks replayed, all digests equal the record")
        assertContains(result.results, "seed 42")
        assertContains(result.results, sha256(JarBytes.read(ProbeJars.programs.toString())))
    }

    @Test
    fun `a replay prints output of programs with the node`() {
        val printing = summing("new Object() { int value() { System.out.println(\"heard\"); return sensors.value(); } }.value()")
        val result = run("replay", record(jar = printing))
        assertEquals(0, result.code, result.messages)
        assertContains(result.messages, "[node 1, program sum] heard")
    }

    @Test
    fun `a record contains its jars`() {
        val jar = folder.resolve("moved.jar")
        Files.copy(ProbeJars.programs, jar)
        val file = record(jar = jar)
        Files.delete(jar)
        assertEquals(0, run("replay", file).code)
    }

    @Test
    fun `a replay repeats reloads with the jars of the record`() {
        val jars = listOf("sensors.value() + 1", "sensors.value() + 2", "sensors.value() + 3").mapIndexed { index, value ->
            folder.resolve("reloaded-$index.jar").also { Files.copy(summing(value), it) }
        }
        val file = record { reload = if (tick % 3 == 0L) jars.getOrNull((tick / 3 - 1).toInt()) else null }
        jars.forEach(Files::delete)
        val result = run("replay", file)
        assertEquals(0, result.code, result.results + result.messages)
        assertContains(result.results, "$TICKS ticks replayed, all digests equal the record")
        val own = Files.createDirectory(folder.resolve("own"))
        Files.createFile(own.resolve(sha256(JarBytes.read(ProbeJars.programs.toString()))))
        val refused = run("replay", file, "--own", own)
        assertEquals(2, refused.code)
        assertContains(refused.messages, "programs that have never run here")
    }

    @Test
    fun `reloaded programs are compared by content`() {
        val jars = listOf("sensors.value()", "sensors.value() + 0").map(::summing)
        val path = folder.resolve("reloaded.jar")
        val records = listOf(jars[0] to path, jars[1] to path, jars[0] to folder.resolve("moved.jar")).mapIndexed { index, (jar, target) ->
            Files.copy(jar, target, REPLACE_EXISTING)
            record("$index") { reload = if (tick == 3L) target else null }
        }
        val result = run("diff", records[0], records[1])
        assertEquals(1, result.code)
        assertContains(result.results, "tick 3: input of programs: SHA-256 ${sha256(JarBytes.read(jars[0].toString()))} in A, ")
        assertEquals(0, run("diff", records[0], records[2]).code)
    }

    @Test
    fun `lists of user data with ids are compared in order`() {
        fun list(vararg values: Float) = values.map { mapOf("id" to 1, "x" to it) }
        assertEquals(
            "globals.targets[0].x: 1.0 in A, 2.0 in B",
            ObjectDifference.first(list(1f, 3f), list(2f, 3f), field = "globals.targets")?.line("A" to "B"),
        )
    }

    @Test
    fun `a changed program is reported at the first answer that differs`() {
        val file = record(jar = summing("sensors.value()"))
        assertEquals(0, run("replay", file, "--programs", summing("sensors.value() + 0")).code)
        val result = run("replay", file, "--programs", summing("sensors.value() + (sensors.value() == 403 ? 1 : 0)"))
        assertEquals(1, result.code)
        assertContains(result.results, "tick 4 is the first difference")
        assertContains(result.results, "node 3, actuators.value: 403 in the record, 404 in the replay")
        assertContains(result.results, "$TICKS ticks replayed, with differences")
    }

    @Test
    fun `a record is replayed on the other runtime, and the records of both do not differ`() {
        val file = record()
        val other = folder.resolve("other.clkrec")
        val replayed = run("replay", file, *collektive, "--out", other)
        assertEquals(0, replayed.code, replayed.results + replayed.messages)
        assertContains(replayed.results, "built-in runtime; recorded with")
        assertContains(
            replayed.results,
            Regex("all digests equal the record; the last digest is [0-9a-f]{16} \\(Collektive runtime\\)"),
        )
        val compared = run("diff", file, other)
        assertEquals(0, compared.code, compared.results)
        assertContains(compared.results, "different runtimes: the built-in runtime in A, the Collektive runtime in B")
        assertContains(compared.results, "$TICKS ticks without a difference")
        assertContains(run("replay", other).results, "Collektive runtime; recorded with")
    }

    @Test
    fun `a difference between the runtimes is found by comparing their records`() {
        val other = folder.resolve("other.clkrec")
        val programs = summing("sensors.value() + (aggregate.getClass().getName().contains(\"runtime.AggregateDevice\") ? 0 : 1)")
        val replayed = run("replay", record(jar = programs), *collektive, "--out", other)
        assertEquals(1, replayed.code, replayed.messages)
        val compared = run("diff", folder.resolve("a.clkrec"), other)
        assertEquals(1, compared.code)
        assertContains(compared.results, "tick 1: output of node 0, actuators.value: 100 in A, 101 in B")
    }

    @Test
    fun `an unknown runtime is refused`() {
        val result = run("replay", record(), "--runtime", "other")
        assertEquals(2, result.code)
        assertContains(result.messages, "unknown runtime 'other'; use one of builtIn, collektive")
    }

    @Test
    fun `a program that fails only in the replay is a difference`() {
        val result =
            run("replay", record(jar = summing("sensors.value()")), "--programs", summing("sensors.value() / (sensors.value() - 201)"))
        assertEquals(1, result.code)
        assertContains(result.results, "tick 1 is the first difference")
        assertContains(result.results, "1 rounds failed (0 in the record)")
    }

    @Test
    fun `records of the same run do not differ`() {
        val result = run("diff", record("a") { inspected = 1 }, record("b") { inspected = 1 })
        assertEquals(0, result.code, result.results)
        assertContains(result.results, "$TICKS ticks without a difference")
    }

    @Test
    fun `a difference is named by tick, node and field`() {
        val a = record("a")
        fun first(change: Step.() -> Unit): String {
            val result = run("diff", a, record("b", change = change))
            assertEquals(1, result.code)
            return result.results
        }
        assertContains(
            first {
                if (tick ==
                    3L
                ) {
                    sensors = sensors?.map {
                        Step.Sensor(
                            it.value + if (it.value ==
                                302
                            ) {
                                1
                            } else {
                                0
                            },
                            points = it.points,
                        )
                    }
                }
            },
            "tick 3: input of node 2, sensors.value: 302 in A, 303 in B",
        )
        assertContains(
            first {
                if (tick ==
                    2L
                ) {
                    sensors = sensors?.map { Step.Sensor(it.value, "x".takeIf { _ -> it.value == 204 }, it.points) }
                }
            },
            "tick 2: input of node 4, sensors.label: absent in A, \"x\" in B",
        )
        assertContains(
            first {
                if (tick ==
                    2L
                ) {
                    sensors = sensors?.map {
                        Step.Sensor(
                            it.value,
                            points = it.points + if (it.value ==
                                204
                            ) {
                                1
                            } else {
                                0
                            },
                        )
                    }
                }
            },
            "tick 2: input of node 4, sensors.points[0].x: ",
        )
        assertContains(
            first {
                if (tick ==
                    5L
                ) {
                    linked = linked + (3 to 1)
                }
            },
            "tick 5: input of link 3 -> 1, links: absent in A, present in B",
        )
        assertContains(
            first {
                if (tick ==
                    5L
                ) {
                    added = added + Step.Added(77, "probe")
                }
            },
            "tick 5: input of node 77, nodesAdded: absent in A, present in B",
        )
        assertContains(first { if (tick == 4L) wind = 5f }, "tick 4: input of globals.wind: 4.0 in A, 5.0 in B")
        assertContains(
            first {
                if (tick ==
                    6L
                ) {
                    due = due - 2
                    sensors = sensors?.filter { it.value != 602 }
                }
            },
            "tick 6: input of node 2, due: present in A, absent in B",
        )
    }

    @Test
    fun `the order of changes is not a difference`() {
        assertEquals(
            0,
            run(
                "diff",
                record("a"),
                record("b") {
                    linked = linked.reversed()
                    added = added.reversed()
                },
            ).code,
        )
    }

    @Tag("repeats")
    @Test
    fun `differences in outputs of the same input and in programs are reported`() {
        val result = run("diff", record("a", jar = summing("sensors.value()")), record("b", jar = summing("sensors.value() % 503")))
        assertEquals(1, result.code)
        assertContains(result.results, "different settings: programs: SHA-256")
        assertContains(result.results, "tick 5: output of node 3, actuators.value: 503 in A, 0 in B")
    }

    @Test
    fun `a record that ends earlier differs`() {
        val result = run("diff", record("a", ticks = 4), record("b"))
        assertEquals(1, result.code)
        assertContains(result.results, "tick 5: the record A ends after tick 4")
    }

    @Test
    fun `refused and endless steps are recorded, and replay in the same way`() {
        val file = folder.resolve("failed.clkrec")
        val session = TestSession(shim)
        check(session.open(program = "probe", record = file.toString()) >= 0)
        session.ok(
            Step(1).apply {
                added = listOf(Step.Added(1))
                due = listOf(1)
            },
        )
        assertEquals(HostError.FRAME.code.toLong(), session.step(Step(2).apply { removed = listOf(5) }.bytes()))
        session.ok(
            Step(2).apply {
                due = listOf(1)
                sensors = listOf(Step.Sensor(0, "throw"))
            },
        )
        val hung = Step(3).apply {
            due = listOf(1)
            sensors = listOf(Step.Sensor(0, "loop"))
        }
        assertEquals(HostError.SESSION_FAILED.code.toLong(), session.step(hung.bytes(), 200))
        session.close()
        Record.open(file).use { record ->
            val steps = List(4) { checkNotNull(record.next()) }
            assertEquals(listOf(true, false, true, false), steps.map { it.answer != null })
            assertContains(checkNotNull(steps[1].failure), "node 5")
            assertContains(checkNotNull(steps[3].failure), "limit")
            assertEquals(null, record.next())
        }
    }

    @Test
    fun `a record that cannot be written refuses the session`() {
        for (path in listOf(folder.resolve("no/such/folder/x").toString(), folder.toString(), "/dev/full", "a\u0000b")) {
            val session = TestSession(shim)
            assertEquals(HostError.ARGUMENT.code.toLong(), session.open(record = path), path)
            assertContains(shim.error, path)
        }
        val session = TestSession(shim)
        assertTrue(session.open(program = "nonesuch", record = folder.resolve("none").toString()) < 0)
        assertFalse(folder.resolve("none").exists())
    }

    @Test
    fun `a record truncated at any chunk is replayed up to that chunk`() {
        val whole = record(ticks = 4)
        val bytes = whole.readBytes()
        val chunks = chunks(bytes)
        val firstStep = chunks.indexOfFirst { it.kind == Chunk.STEP }
        for ((index, chunk) in chunks.withIndex()) {
            if (index == 0) continue
            val ticks = maxOf(0, (index - firstStep) / 2)
            for (length in listOf(
                chunk.offset,
                chunk.offset + 5,
                chunk.offset + Chunk.HEADER_BYTES,
                chunk.offset + Chunk.HEADER_BYTES + chunk.payload.remaining() / 2,
            )) {
                // This length is the whole record, because the last chunk has no payload.
                if (length == bytes.size.toLong()) continue
                val cut = folder.resolve("cut").also { it.writeBytes(bytes.copyOf(length.toInt())) }
                val result = run("replay", cut)
                assertEquals(2, result.code)
                assertContains(
                    result.messages,
                    "damaged at byte ${chunk.offset}, " + if (ticks == 0) "before the first tick" else "after tick $ticks",
                )
                if (index >= firstStep) assertContains(result.results, "$ticks ticks replayed, all digests equal the record")
            }
        }
    }

    @Test
    fun `a replay of a damaged record keeps an earlier file`() {
        val earlier = record("earlier").readBytes()
        val cut = folder.resolve("cut").also { it.writeBytes(earlier.copyOf(earlier.size - 1)) }
        assertEquals(2, run("replay", cut, "--out", folder.resolve("earlier.clkrec")).code)
        assertContentEquals(earlier, folder.resolve("earlier.clkrec").readBytes())
        assertEquals(2, run("replay", cut, "--out", folder.resolve("new.clkrec")).code)
        assertEquals(setOf("earlier.clkrec", "cut"), folder.listDirectoryEntries().map { it.name }.toSet())
        val link = Files.createSymbolicLink(folder.resolve("link"), Path.of("cut"))
        assertEquals(0, run("replay", folder.resolve("earlier.clkrec"), "--out", link).code)
        assertEquals(earlier.size - 1L, Files.size(folder.resolve("cut")))
        assertFalse(Files.isSymbolicLink(link))
    }

    @Test
    fun `a flipped bit is reported at its chunk`() {
        val bytes = record(ticks = 2).readBytes()
        val chunks = chunks(bytes)
        val flipped = folder.resolve("flipped")
        val random = Random(3)
        for (at in bytes.indices) {
            // The jar is long, so only a few of its bytes are tested.
            val chunk = chunks.lastOrNull { it.offset <= at }
            if (chunk?.kind == Chunk.JAR && at > chunk.offset + 100 && at % 101 != 0) continue
            val damaged = bytes.copyOf().also { it[at] = (it[at].toInt() xor (1 shl random.nextInt(8))).toByte() }
            flipped.writeBytes(damaged)
            val error = assertFailsWith<RecordException>("byte $at") { readAll(flipped) }
            if (chunk == null) {
                assertTrue(error is InvalidRecordException)
            } else {
                assertContains(error.message.orEmpty(), "at byte ${chunk.offset},")
            }
        }
    }

    @Test
    fun `damage with a valid checksum is reported too`() {
        val bytes = record(ticks = 3).readBytes()
        val chunks = chunks(bytes).filter { it.kind != Chunk.JAR && it.payload.hasRemaining() }
        val random = Random(4)
        val file = folder.resolve("crafted")
        repeat(100) {
            val chunk = chunks[random.nextInt(chunks.size)]
            val damaged = bytes.copyOf()
            repeat(random.nextInt(1, 4)) {
                damaged[chunk.offset.toInt() + Chunk.HEADER_BYTES + random.nextInt(chunk.payload.remaining())] = random.nextInt().toByte()
            }
            seal(damaged, chunk)
            file.writeBytes(damaged)
            assertTrue(run("replay", file).code in 0..2)
            assertTrue(run("diff", file, folder.resolve("a.clkrec")).code in 0..2)
        }
    }

    @Test
    fun `a chunk that does not fit into memory, in a sparse file, is reported as damage`() {
        val bytes = record(ticks = 2).readBytes()
        val step = chunks(bytes).first { it.kind == Chunk.STEP }
        ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN).putInt(step.offset.toInt() + Int.SIZE_BYTES, Int.MAX_VALUE)
        val file = folder.resolve("sparse").also { it.writeBytes(bytes) }
        RandomAccessFile(file.toFile(), "rw").use { it.setLength(3L shl 30) }
        for (arguments in listOf(arrayOf<Any>("replay", file), arrayOf("diff", file, file))) {
            val result = run(*arguments)
            assertEquals(2, result.code)
            assertContains(result.messages, "damaged at byte ${step.offset}, before the first tick: the chunk has 2147483647 bytes")
        }
    }

    @Test
    fun `a pipe is not a record`() {
        val pipe = folder.resolve("pipe")
        assertEquals(0, ProcessBuilder("mkfifo", "$pipe").start().waitFor())
        val result = run("replay", pipe)
        assertEquals(2, result.code)
        assertContains(result.messages, "$pipe is not a regular file: enter the path of a record")
    }

    @Test
    fun `chunks in a wrong order are damage`() {
        val bytes = record(ticks = 2).readBytes()
        val chunks = chunks(bytes)
        val step = chunks.first { it.kind == Chunk.STEP }
        for (kind in listOf(Chunk.DONE, Chunk.HEAD, Chunk.END, 0x21212121)) {
            val damaged = bytes.copyOf()
            ByteBuffer.wrap(damaged).order(ByteOrder.LITTLE_ENDIAN).putInt(step.offset.toInt(), kind)
            seal(damaged, step)
            val file = folder.resolve("order").also { it.writeBytes(damaged) }
            val result = run("replay", file)
            assertEquals(2, result.code)
            assertContains(result.messages, "damaged at byte")
        }
    }

    @Test
    fun `a file that is not a record, or of another version or schema, is refused with the reason`() {
        val file = record()
        val bytes = file.readBytes()
        val other = folder.resolve("other")
        fun refused(vararg arguments: Any): String = run(*arguments).also { assertEquals(2, it.code, it.results) }.messages
        assertContains(refused("replay", folder.resolve("nowhere")), "the record ${folder.resolve("nowhere")} does not exist;")
        other.writeBytes(bytes.copyOf().also { it[0] = 'X'.code.toByte() })
        assertContains(refused("replay", other), "is not a record")
        other.writeBytes(bytes.copyOf().also { it[RecordWriter.MAGIC_TEXT.length] = 9 })
        assertContains(refused("replay", other), "version 9, but this release reads version 1")
        other.writeBytes(ByteArray(0))
        assertContains(refused("replay", other), "is not a record")
        assertContains(refused("replay", file, "--programs", folder.resolve("no.jar")), "no.jar")
        assertContains(refused("replay", file, "--jar", "x"), "--jar")
        assertContains(refused("diff", file), "two records")
        val changed = Record.open(file).use { record ->
            val open = record.open
            val hash = record.settings.types(0).hash()
            open.putLong((0..open.limit() - Long.SIZE_BYTES).first { open.getLong(it) == hash }, hash + 1)
            folder.resolve("schema").also { path -> RecordWriter.create(path.toString(), open, record.jars).use(RecordWriter::end) }
        }
        assertContains(refused("replay", changed), "type ")
        assertContains(refused("diff", file, changed), "the schemas of the records differ in type ")
    }

    @Test
    fun `unknown programs run only with --trust`() {
        val jar = summing("sensors.value()")
        val file = record(jar = jar)
        val own = Files.createDirectory(folder.resolve("own"))
        val refused = run("replay", file, "--own", own)
        assertEquals(2, refused.code)
        val hash = sha256(JarBytes.read(jar.toString()))
        assertContains(refused.messages, "$file contains programs that have never run here (SHA-256 $hash)")
        assertContains(refused.messages, "add --trust")
        assertFalse("ticks replayed" in refused.results)
        assertEquals(0, run("replay", file, "--own", own, "--trust").code)
        assertEquals(0, run("replay", file, "--own", own, "--programs", jar).code)
        Files.createFile(own.resolve(hash))
        assertEquals(0, run("replay", file, "--own", own).code)
    }

    @Test
    fun `a comparison does not run code of a record`() {
        val ran = folder.resolve("ran")
        val jar = ProbeJars.withClass(
            """
            package probe;
            import org.collektive.frames.data.*;
            public final class Bad implements DataSchema {
              static { try { java.nio.file.Files.createFile(java.nio.file.Path.of("$ran")); } catch (java.io.IOException e) { throw new Error(e); } }
              public String getName() { return "probe.Bad"; }
              public java.util.Map<String, Long> getTypes() { return java.util.Map.of(); }
              public Class<?> getSensorType() { return Bad.class; }
              public Class<?> getActuatorType() { return Bad.class; }
              public ElementReader sensorReader() { return null; }
              public View sensorView() { return null; }
              public ElementReader actuatorReader() { return null; }
              public ActuatorWriter actuatorWriter() { return null; }
              public GlobalReader globalReader() { return null; }
              @org.collektive.api.Program(name = "sum")
              public static ActuatorData sum(it.unibo.collektive.aggregate.api.Aggregate<Integer> aggregate, SensorData sensors) {
                return new ActuatorData(sensors.value());
              }
            }
            """.trimIndent(),
        )
        FileSystems.newFileSystem(jar).use { zip ->
            zip.getPath("META-INF/services/org.collektive.frames.data.DataSchema").appendText("probe.Bad\n")
        }
        val file = record(jar = jar)
        assertTrue(ran.deleteIfExists(), "the session must have loaded the class")
        val other = record("b", jar = jar) { if (tick == 3L) wind = 9f }
        ran.deleteExisting()
        val result = run("diff", file, other)
        assertContains(result.results, "tick 3: input of globals: absent in A, present in B")
        assertFalse(ran.exists(), "the comparison must not load a class of the record")
        assertEquals(2, run("replay", file, "--own", folder).code)
        assertFalse(ran.exists(), "a refused replay must not load a class of the record")
    }

    @Test
    fun `a record cannot print escape sequences`() {
        val jar = folder.resolve("\u001b[2Jhidden.jar")
        Files.copy(ProbeJars.programs, jar)
        val file = record(jar = jar)
        assertContains(run("replay", file).results, "?[2Jhidden.jar")
        val other = record("b", jar = jar) { sensors = sensors?.map { Step.Sensor(it.value, "\u001b[2J\nb", it.points) } }
        assertContains(run("diff", file, other).results, "\"?[2J?b\" in B")
    }

    /** Returns a jar whose program "sum" returns the value of [expression]. */
    private fun summing(expression: String): Path = ProbeJars.withClass(
        """
        package probe;
        public final class Bad {
          @org.collektive.api.Program(name = "sum")
          public static ActuatorData sum(it.unibo.collektive.aggregate.api.Aggregate<Integer> aggregate, SensorData sensors) {
            return new ActuatorData($expression);
          }
        }
        """.trimIndent(),
    )

    private fun readAll(file: Path) = Record.open(file).use { record -> generateSequence(record::next).count() }

    private fun chunks(bytes: ByteArray): List<Chunk> {
        val file = ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN)
        var at = RecordWriter.MAGIC.size
        return buildList {
            while (at < bytes.size) {
                val length = file.getInt(at + 4)
                add(Chunk(file.getInt(at), at.toLong(), ByteBuffer.wrap(bytes, at + Chunk.HEADER_BYTES, length)))
                at += Chunk.HEADER_BYTES + length
            }
        }
    }

    /** Corrects the checksum of the chunk at the position of [chunk]. */
    private fun seal(bytes: ByteArray, chunk: Chunk) {
        val crc = CRC32().apply {
            update(bytes, chunk.offset.toInt(), Chunk.CHECKSUM_AT)
            update(bytes, chunk.offset.toInt() + Chunk.HEADER_BYTES, chunk.payload.limit() - chunk.payload.position())
        }
        ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN).putInt(chunk.offset.toInt() + Chunk.CHECKSUM_AT, crc.value.toInt())
    }

    private companion object {
        const val TICKS = 8
        const val NODES = 6
    }
}
