package it.unibo.collektive.path

/** Creates paths from tokens. All devices of a network must use the same factory. */
public interface PathFactory {
    /** The path of [tokens], the outermost first. */
    public operator fun invoke(tokens: List<Any?>): Path

    /** The path of [tokens], the outermost first. */
    public operator fun invoke(vararg tokens: Any?): Path = invoke(tokens.toList())
}

/** Creates [FullPath]s. */
public object FullPathFactory : PathFactory {
    override fun invoke(tokens: List<Any?>): Path = FullPath(tokens.toList())
}
