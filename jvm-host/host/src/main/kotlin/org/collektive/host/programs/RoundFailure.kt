package org.collektive.host.programs

import org.collektive.engine.InvalidAnswerException

/** Describes the failure of a round for the program's author: one line, then the stack frames of user code. */
internal object RoundFailure {
    private const val MAX_MESSAGE = 2000
    private const val MAX_FRAMES = 20

    /** Describes [failure] at [place]. With [programs], the loader of the user's classes, inlined code is reported at the line of its call. */
    fun describe(failure: Throwable, place: String?, programs: ClassLoader? = null): String = buildString {
        append(lineWithPlace(failure, place))
        frames(failure, programs)
        var cause = failure.cause
        var depth = 0
        while (cause != null && depth++ < MAX_CAUSES) {
            append("\ncaused by ").append(line(cause))
            frames(cause, programs)
            cause = cause.cause
        }
    }

    private fun lineWithPlace(failure: Throwable, place: String?): String {
        val line = line(failure)
        // An invalid answer has no place in the program, and errors of the runtime already contain their place.
        return if (place == null || failure is InvalidAnswerException || place in line) line else "$line [$place]"
    }

    private fun line(failure: Throwable): String {
        val text = when {
            failure is InvalidAnswerException -> failure.message.orEmpty()

            failure is StackOverflowError -> "$failure: infinite recursion"

            failure is OutOfMemoryError -> "$failure${settingToRaise(failure)}"

            failure is IncompatibleClassChangeError || failure is NoClassDefFoundError && failure.cause is ClassNotFoundException ->
                "$failure: a jar is missing or has the wrong version; rebuild the programs against the jars that run them"

            else -> failure.toString()
        }
        return text.take(MAX_MESSAGE).replace('\n', ' ').replace('\r', ' ')
    }

    /** Returns which setting to raise, with its names in the inspector and in scenario files. */
    private fun settingToRaise(failure: OutOfMemoryError): String {
        val message = failure.message.orEmpty()
        val megabytes = Runtime.getRuntime().maxMemory() shr MEBI_BITS
        return when {
            "heap" in message || "GC overhead" in message ->
                ", with all $megabytes MB in use: raise the maximum heap in the JVM settings (jvm.maximumHeapMb), or store less data in the program"

            "Metaspace" in message -> ": raise -XX:MaxMetaspaceSize in the JVM settings' flags (jvm.flags), or load fewer classes"

            "direct" in message -> ": raise -XX:MaxDirectMemorySize in the JVM settings' flags (jvm.flags)"

            else -> ""
        }
    }

    private fun StringBuilder.frames(failure: Throwable, programs: ClassLoader?) {
        // The JVM's classes for lambdas have no file.
        val own = failure.stackTrace.filter { it.classLoaderName == ProgramLoader.NAME && it.fileName != null }
        for (frame in own.take(MAX_FRAMES)) {
            val line = programs?.let { lineInFile(frame, it) } ?: frame.lineNumber
            append("\n    at ").append(frame.className).append('.').append(frame.methodName)
            append('(').append(frame.fileName).append(':').append(line).append(')')
        }
        if (own.size > MAX_FRAMES) append("\n    ... ").append(own.size - MAX_FRAMES).append(" more")
    }

    private fun lineInFile(frame: StackTraceElement, programs: ClassLoader): Int? = try {
        InlineSourceMap.of(Class.forName(frame.className, false, programs)).inFile(frame.lineNumber)
    } catch (_: ClassNotFoundException) {
        null // A hidden class, generated at run time.
    }

    private const val MAX_CAUSES = 4
    private const val MEBI_BITS = 20
}
