package org.collektive.runtime

import org.junit.jupiter.api.Test
import java.util.concurrent.Callable
import java.util.concurrent.Executors
import kotlin.test.assertEquals
import kotlin.test.assertNotSame
import kotlin.test.assertSame
import kotlin.test.assertTrue

class PathTreeTest {
    private val tree = PathTree()

    private fun PathTree.child(parent: PathNode, token: Any?) = find(parent, token) ?: enter(parent, token)

    @Test
    fun `equal tokens below one parent are one path`() {
        val a = tree.child(tree.root, "a")
        assertSame(a, tree.child(tree.root, String(charArrayOf('a'))))
        assertNotSame(a, tree.child(tree.root, "b"))
        assertNotSame(tree.child(a, "a"), a)
        assertSame(tree.child(a, null), tree.child(a, null))
    }

    @Test
    fun `tokens with equal hashes are distinguished`() {
        assertEquals("Aa".hashCode(), "BB".hashCode())
        assertNotSame(tree.child(tree.root, "Aa"), tree.child(tree.root, "BB"))
    }

    @Test
    fun `a million pivots are freed`() {
        val kept = tree.child(tree.root, "kept")
        var sweeps = 0
        for (pivot in 0 until 1_000_000) {
            val used = tree.child(kept, pivot)
            if (tree.needsSweep) {
                tree.keepOnly { it(used) }
                sweeps++
                assertSame(used, tree.child(kept, pivot))
            }
        }
        assertTrue(sweeps > 100)
        assertSame(kept, tree.child(tree.root, "kept"))
    }

    @Test
    fun `threads agree on all paths`() {
        val pool = Executors.newFixedThreadPool(4)
        try {
            val work = Callable { List(20_000) { tree.child(tree.child(tree.root, it % 100), it) } }
            val (first, second, third) = pool.invokeAll(listOf(work, work, work)).map { it.get() }
            for (index in first.indices) {
                assertSame(first[index], second[index])
                assertSame(first[index], third[index])
            }
        } finally {
            pool.shutdown()
        }
    }
}
