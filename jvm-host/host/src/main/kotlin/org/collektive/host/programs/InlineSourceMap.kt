package org.collektive.host.programs

/**
 * Maps the lines of code that the Kotlin compiler inlined into a class to the lines of the calls.
 *
 * Inlined code has line numbers beyond the end of the file. The source map of the compiler (JSR-45, stratum `KotlinDebug`) contains the line
 * of each call.
 */
internal class InlineSourceMap private constructor(private val ranges: List<Range>) {
    private class Range(val lines: IntRange, val calledFrom: Int)

    /** Returns the line in the user's file: the line of the call if the code of [line] was inlined, otherwise [line]. */
    fun inFile(line: Int): Int = ranges.find { line in it.lines }?.calledFrom ?: line

    companion object {
        private val NONE = InlineSourceMap(emptyList())
        private val ENTRY = Regex("""(\d+)(?:#\d+)?(?:,(\d+))?:(\d+)(?:,(\d+))?""")

        /** Returns the source map of [type]. Cached, because a program may fail in each round. */
        fun of(type: Class<*>): InlineSourceMap = CACHE.get(type)

        private val CACHE = object : ClassValue<InlineSourceMap>() {
            override fun computeValue(type: Class<*>): InlineSourceMap {
                val file = type.getResourceAsStream("/" + type.name.replace('.', '/') + ".class") ?: return NONE
                return of(file.use { it.readAllBytes() })
            }
        }

        /** Returns the source map in [classFile], which contains it as text. */
        fun of(classFile: ByteArray): InlineSourceMap {
            val map = String(classFile, Charsets.ISO_8859_1).substringAfter("SMAP\n", "").substringBefore("*E")
            val entries = map.substringAfter("*S KotlinDebug\n", "").substringAfter("*L\n", "").lineSequence()
            return InlineSourceMap(entries.mapNotNull { ENTRY.matchEntire(it)?.groupValues }.map(::range).toList())
        }

        /** Parses an entry "input line, repetitions : first output line, output lines each". */
        private fun range(entry: List<String>): Range {
            val first = entry[OUTPUT].toInt()
            val count = (entry[REPETITIONS].toIntOrNull() ?: 1) * (entry[INCREMENT].toIntOrNull() ?: 1)
            return Range(first until first + count, entry[INPUT].toInt())
        }

        private const val INPUT = 1
        private const val REPETITIONS = 2
        private const val OUTPUT = 3
        private const val INCREMENT = 4
    }
}
