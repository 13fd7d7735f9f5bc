package it.unibo.collektive.path

/** The tokens of this path, the outermost first, or the path itself if they are unknown. */
public val Path.tokens: List<Any?>
    get() = when (this) {
        is FullPath -> path
        is SerializablePath -> known ?: listOf(this)
    }
