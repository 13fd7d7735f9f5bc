package org.collektive.host.fuzz

import org.collektive.frame.RecordingAction
import org.collektive.host.ProbeSchema
import org.collektive.host.Step
import org.collektive.host.controlFrame
import org.collektive.host.openFrame
import java.nio.ByteBuffer

/** Valid frames by the names of their files in the corpus. */
internal object FuzzSeeds {
    /** The tick of all frames for `step`. */
    const val TICK = 2L

    private val jars = listOf(FuzzedPrograms.PATH)

    // The names are sorted, because the order of a `Map.of` differs from one run of the JVM to the next.
    private val types = ProbeSchema.types.toSortedMap()

    /** Returns the first tick of the network that [StepFuzzer] uses. */
    fun firstTick(tick: Long = 1) = Step(tick).apply {
        wind = 1f
        added = (0 until 5).map { Step.Added(it) }
        linked = listOf(0 to 1, 1 to 2, 2 to 3, 3 to 4, 4 to 0)
        due = (0 until 5).toList()
    }

    val open: Map<String, ByteBuffer> = mapOf(
        "open-plain" to openFrame(jars, types = types),
        "open-sequential-without-default" to openFrame(jars, types = types, program = "", threads = 1, schedule = 1),
        "open-network" to openFrame(jars, types = types, schedule = 2, network = listOf(0.1, 0.01, 0.02, 0.05, 0.2, 0.3)),
    )

    val step: Map<String, ByteBuffer> = mapOf(
        "step-nothing" to Step(TICK).apply { sensors = emptyList() },
        "step-due" to Step(TICK).apply { due = listOf(0, 2, 4) },
        "step-sensors" to Step(TICK).apply {
            due = listOf(1, 3)
            sensors = listOf(Step.Sensor(7, "label", 3), Step.Sensor(-1, "", 0))
        },
        "step-globals" to Step(TICK).apply {
            wind = 2.5f
            due = listOf(1)
        },
        "step-links" to Step(TICK).apply {
            unlinked = listOf(0 to 1, 3 to 4)
            linked = listOf(1 to 2, 2 to 0)
        },
        "step-nodes" to Step(TICK).apply {
            removed = listOf(0, 4)
            added = listOf(Step.Added(4), Step.Added(9, "sum"))
            linked = listOf(4 to 9, 9 to 1)
            due = listOf(1, 4, 9)
        },
    ).mapValues { it.value.bytes() }

    val control: Map<String, ByteBuffer> = mapOf(
        "control-plain" to controlFrame(),
        "control-flags" to controlFrame(flags = listOf("MaxHeapSize", "UseNoSuchThing", "TieredCompilation")),
        "control-recording" to controlFrame(recording = RecordingAction.Start, path = "target/fuzz.jfr"),
    )
}
