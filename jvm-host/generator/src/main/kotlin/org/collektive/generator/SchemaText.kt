package org.collektive.generator

import java.nio.charset.MalformedInputException
import java.nio.file.Files
import java.nio.file.Path

/** The text of a schema file. Distinguishes only words, strings and comments; flatc checks the grammar. */
internal class SchemaText(private val text: String) {
    private val starts = HashMap<String, Int>()
    private val rewritten = StringBuilder(text.length)
    private var line = 1
    private var namespace = ""
    private var type: String? = null
    private var depth = 0
    private val words = ArrayDeque<String>()

    /** The same lines, changed so that their comments cannot end comments of generated code. */
    val sanitized: String

    init {
        var at = 0
        while (at < text.length) {
            val end = endOf(at)
            val part = text.substring(at, end)
            when {
                part.startsWith("//") -> rewritten.append(sanitized(part))

                else -> {
                    rewritten.append(part)
                    if (!part.startsWith("/*")) accept(part)
                }
            }
            line += part.count { it == '\n' }
            at = end
        }
        sanitized = rewritten.toString()
    }

    /** The line of the type or field with the qualified [name], such as `a.b.Type.field`; `null` if it is not in this text. */
    fun lineOf(name: String): Int? = starts[name]

    /** The end of the comment, string, word or single character at [at]. */
    private fun endOf(at: Int): Int {
        val first = text[at]
        return when {
            text.startsWith("//", at) -> text.indexOfAny(charArrayOf('\n', '\r'), at).takeIf { it >= 0 } ?: text.length
            text.startsWith("/*", at) -> text.indexOf("*/", at + 2).let { if (it < 0) text.length else it + 2 }
            first == '"' || first == '\'' -> endOfString(at, first)
            isWord(first) -> (at + 1 until text.length).firstOrNull { !isWord(text[it]) } ?: text.length
            else -> at + 1
        }
    }

    private fun endOfString(at: Int, quote: Char): Int {
        var end = at + 1
        while (end < text.length && text[end] != quote) end += if (text[end] == '\\') 2 else 1
        return minOf(end + 1, text.length)
    }

    /** Processes a word or another character, and records the positions of types and their fields. */
    private fun accept(part: String) {
        if (part.isBlank()) return
        val before = words.lastOrNull()
        when {
            depth == 0 && before in TYPES && isWord(part[0]) -> type = name(part).also { starts.putIfAbsent(it, line) }
            depth == 1 && before in FIELD_STARTS && isWord(part[0]) -> type?.let { starts.putIfAbsent("$it.$part", line) }
        }
        if (part == "{" || part == "(") depth++
        if (part == "}" || part == ")") depth--
        if (part == ";" && depth == 0 && words.contains("namespace")) {
            namespace = words.toList().drop(words.indexOf("namespace") + 1).joinToString("")
        }
        if (part in END_OF_STATEMENT) words.clear()
        words.addLast(part)
    }

    private fun name(simple: String) = if (namespace.isEmpty()) simple else "$namespace.$simple"

    companion object {
        private val TYPES = setOf("table", "struct", "enum", "union")
        private val FIELD_STARTS = setOf("{", ";", ",")
        private val END_OF_STATEMENT = setOf("{", "}", ";", ",")

        private fun isWord(character: Char) = character == '_' || character in 'a'..'z' || character in 'A'..'Z' || character in '0'..'9'

        /** @throws GeneratorException when [file] is not text in UTF-8. */
        fun read(file: Path): SchemaText = try {
            val text = Files.readString(file)
            val zero = text.indexOf('\u0000')
            if (zero >= 0) {
                val line = 1 + text.substring(0, zero).count { it == '\n' }
                throw GeneratorException("${file.fileName}:$line: the file contains a NUL character; remove it, or save the file as text")
            }
            SchemaText(text)
        } catch (_: MalformedInputException) {
            throw GeneratorException("${file.fileName}:1: the file is not in UTF-8; save it with that encoding")
        }

        /** Returns a one-line comment without character sequences that start or end comments in Java, Kotlin or C#. */
        private fun sanitized(comment: String): String {
            val content = comment.indexOfFirst { it != '/' }.coerceIn(2, 3).coerceAtMost(comment.length)
            val text = withoutCommentEnds(comment.substring(content)).replace("\\", "&#92;")
            return comment.substring(0, content) + if (text.startsWith("/")) "&#47;" + text.drop(1) else text
        }

        /** Returns [text] on one line, without the start or end of block comments. */
        fun withoutCommentEnds(text: String): String = withoutLineEnds(text).replace("*/", "*&#47;").replace("/*", "/&#42;")

        /** Returns [text] with control characters, line separators and bidirectional controls replaced by spaces. */
        fun withoutLineEnds(text: String): String = text.map {
            if (it.isISOControl() || it in '\u2028'..'\u202E' || it in '\u2066'..'\u2069') ' ' else it
        }.joinToString("")
    }
}
