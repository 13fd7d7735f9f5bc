package org.collektive.runtime

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import org.collektive.spi.Inbox
import org.collektive.spi.RoundProgram
import org.junit.jupiter.api.Test
import java.lang.ref.WeakReference
import kotlin.test.assertNull

@OptIn(DelicateCollektiveApi::class)
class PathStackTest {
    private val tree = PathTree()
    private val stack = PathStack(tree)
    private val device = AggregateDevice(0, tree, ThreadLocal.withInitial { stack }) { null }

    @Test
    fun `a popped pivot is freed`() = assertFreed(pushed().also { stack.popTo(0) })

    @Test
    fun `the path of a popped pivot is freed`() {
        val pivot = pushed()
        stack.path(device)
        stack.popTo(0)
        tree.keepOnly { }
        assertFreed(pivot)
    }

    @Test
    fun `the pivots of a failed round are freed by the next one`() {
        val pivot = WeakReference(Any())
        runCatching {
            val program = RoundProgram { aggregate, _ -> (aggregate as Aggregate<*>).align(pivot.get()).also { error("fails") } }
            device.round(NoLinks, program, null)
        }
        device.round(NoLinks, { _, _ -> null }, null)
        assertFreed(pivot)
    }

    private object NoLinks : Inbox {
        override val size get() = 0
        override val ids = emptyArray<Any>()

        override fun export(index: Int) = null

        override fun wasKnown(index: Int) = false
    }

    private fun pushed(): WeakReference<Any> = Any().let {
        stack.push(it)
        WeakReference(it)
    }

    private fun assertFreed(reference: WeakReference<Any>) {
        repeat(10) { if (reference.get() != null) System.gc() }
        assertNull(reference.get())
    }
}
