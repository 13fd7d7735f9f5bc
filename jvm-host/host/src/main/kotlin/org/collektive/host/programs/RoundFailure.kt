package org.collektive.host.programs

import org.collektive.engine.UnusableAnswer

/** Describes the failure of a round to the program's author: one line, then the stack frames in the user's code. */
internal object RoundFailure {
    private const val MAX_MESSAGE = 2000
    private const val MAX_FRAMES = 20

    fun describe(failure: Throwable, place: String?): String = buildString {
        append(lineWithPlace(failure, place))
        frames(failure)
        var cause = failure.cause
        var depth = 0
        while (cause != null && depth++ < MAX_CAUSES) {
            append("\ncaused by ").append(line(cause))
            frames(cause)
            cause = cause.cause
        }
    }

    private fun lineWithPlace(failure: Throwable, place: String?): String {
        val line = line(failure)
        // An answer is packed after the program has returned, and errors of the runtime already contain their place.
        return if (place == null || failure is UnusableAnswer || place in line) line else "$line [$place]"
    }

    private fun line(failure: Throwable): String {
        val text = when {
            failure is UnusableAnswer -> failure.message.orEmpty()

            failure is StackOverflowError -> "$failure: the recursion does not end"

            failure is IncompatibleClassChangeError || failure is NoClassDefFoundError && failure.cause is ClassNotFoundException ->
                "$failure: a jar is missing or of another version; build the programs again with the jars that run them"

            else -> failure.toString()
        }
        return text.take(MAX_MESSAGE).replace('\n', ' ').replace('\r', ' ')
    }

    private fun StringBuilder.frames(failure: Throwable) {
        val own = failure.stackTrace.filter { it.classLoaderName == ProgramLoader.NAME }
        for (frame in own.take(MAX_FRAMES)) {
            append("\n    at ").append(frame.className).append('.').append(frame.methodName)
            append('(').append(frame.fileName).append(':').append(frame.lineNumber).append(')')
        }
        if (own.size > MAX_FRAMES) append("\n    ... ").append(own.size - MAX_FRAMES).append(" more")
    }

    private const val MAX_CAUSES = 4
}
