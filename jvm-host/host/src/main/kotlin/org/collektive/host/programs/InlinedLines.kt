package org.collektive.host.programs

/**
 * The lines of a class that stand for code which the Kotlin compiler inlined. Such code has line numbers behind the end of its file; the compiler's
 * source map (JSR-45, stratum `KotlinDebug`) says from which line of the file it was called.
 */
internal class InlinedLines private constructor(private val ranges: List<Range>) {
    private class Range(val lines: IntRange, val calledFrom: Int)

    /** The line of the user's file for [line]: itself, unless its code was inlined. */
    fun inFile(line: Int): Int = ranges.find { line in it.lines }?.calledFrom ?: line

    companion object {
        private val NONE = InlinedLines(emptyList())
        private val ENTRY = Regex("""(\d+)(?:#\d+)?(?:,(\d+))?:(\d+)(?:,(\d+))?""")

        /** Of [type], read from its file once: a program may fail in each round. */
        fun of(type: Class<*>): InlinedLines = OF_CLASSES.get(type)

        private val OF_CLASSES = object : ClassValue<InlinedLines>() {
            override fun computeValue(type: Class<*>): InlinedLines {
                val file = type.getResourceAsStream("/" + type.name.replace('.', '/') + ".class") ?: return NONE
                return of(file.use { it.readAllBytes() })
            }
        }

        /** Of a class file. The map is a text in it. */
        fun of(classFile: ByteArray): InlinedLines {
            val map = String(classFile, Charsets.ISO_8859_1).substringAfter("SMAP\n", "").substringBefore("*E")
            val entries = map.substringAfter("*S KotlinDebug\n", "").substringAfter("*L\n", "").lineSequence()
            return InlinedLines(entries.mapNotNull { ENTRY.matchEntire(it)?.groupValues }.map(::range).toList())
        }

        /** Of an entry "input line, repetitions : first output line, output lines each". */
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
