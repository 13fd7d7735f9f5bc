package org.collektive.runtime

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.spi.DeviceRuntime
import org.collektive.spi.Export
import org.collektive.spi.Inbox
import org.collektive.spi.SharingRule

/** Devices of the real runtime in lockstep. Tests add and remove the links. */
internal class TestNetwork(vararg ids: Int, rule: SharingRule = SharingRule { null }) {
    private val runtimes = AggregateRuntimes(rule)
    private val members = sortedMapOf<Int, Member>()
    private var now = 0

    init {
        ids.forEach(::add)
    }

    fun add(id: Int) {
        members[id] = Member(id, runtimes.device(id))
    }

    fun remove(id: Int) {
        members.remove(id)
        members.values.forEach { it.since.remove(id) }
    }

    /** Links each pair of neighbours in [ids] both ways. */
    fun line(vararg ids: Int) = apply {
        for ((a, b) in ids.toList().zipWithNext()) {
            link(a, b)
            link(b, a)
        }
    }

    fun link(from: Int, to: Int) {
        members.getValue(to).since[from] = now
    }

    fun cut(from: Int, to: Int) {
        members.getValue(to).since.remove(from)
    }

    /** Runs one round of each device in [due]; returns what each returned or threw. */
    fun round(vararg due: Int = members.keys.toIntArray(), program: Aggregate<Int>.() -> Any?): Map<Int, Result<Any?>> {
        now++
        runtimes.tidy(members.values.map { it.runtime })
        val results = due.associateWith { id ->
            val member = members.getValue(id)
            runCatching { member.runtime.round(member, program) }
        }
        for ((id, result) in results) {
            if (result.isSuccess) {
                members.getValue(id).run { export = runtime.commit() }
                members.getValue(id).sentAt = now
            }
        }
        return results
    }

    /** [round] that fails when a program throws. */
    fun values(vararg due: Int = members.keys.toIntArray(), program: Aggregate<Int>.() -> Any?): Map<Int, Any?> =
        round(*due, program = program).mapValues { it.value.getOrThrow() }

    private inner class Member(val id: Int, val runtime: DeviceRuntime) : Inbox {
        /** The round after which the link of each sender was added. */
        val since = sortedMapOf<Int, Int>()
        var export: Export? = null
        var sentAt = 0

        override val size get() = since.size
        override val ids: Array<Any> get() = since.keys.toTypedArray()
        override fun export(index: Int) = members.getValue(since.keys.elementAt(index)).export

        override fun wasKnown(index: Int): Boolean {
            val sender = since.keys.elementAt(index)
            return since.getValue(sender) < members.getValue(sender).sentAt
        }
    }
}
