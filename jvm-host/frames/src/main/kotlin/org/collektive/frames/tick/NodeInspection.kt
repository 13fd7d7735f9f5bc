package org.collektive.frames.tick

import org.collektive.engine.NodeState

/**
 * The inspected node of a tick, as text. The constructor calls users' code.
 *
 * @property values stored values and their paths, ascending by path.
 */
public class NodeInspection(state: NodeState) {
    internal val node = state.id
    internal val roundNanos = state.roundNanos
    internal val values: List<Pair<String, String>> =
        state.values.map { (path, value) -> path.take(MAX_PATH) to text(value) }.sortedBy(Pair<String, String>::first)

    private fun text(value: Any?): String {
        val text = try {
            value.toString()
        } catch (failure: Throwable) {
            // Only this value has no text.
            "toString() failed: ${failure.javaClass.name}"
        }
        val type = value?.javaClass
        return when {
            type != null && text.startsWith("${type.name}@") -> type.simpleName
            text.length > MAX_TEXT -> "${text.take(MAX_TEXT)}…"
            else -> text
        }
    }

    public companion object {
        /** Maximum number of values. */
        public const val MAX_VALUES: Int = 200

        private const val MAX_TEXT = 120
        private const val MAX_PATH = 1000
    }
}
