package org.collektive.generator

/** Names that are reserved in Java, Kotlin, C# or generated code. */
internal object ReservedNames {
    private fun words(text: String) = text.split(' ', '\n').filter { it.isNotEmpty() }.toSet()

    /** Kotlin's keywords, which need backticks. */
    val kotlin: Set<String> = words(
        """
        as break class continue do else false for fun if in interface is null object package return super this throw true try typealias
        typeof val var when while
        """,
    )

    /** The keywords of the three languages, and contextual keywords of C# that cannot be type names. */
    val reserved: Set<String> = kotlin + words(
        """
        abstract assert boolean byte case catch char const default double enum extends final finally float goto implements import
        instanceof int long native new private protected public short static strictfp switch synchronized throws transient void volatile
        record sealed yield base bool checked decimal delegate event explicit extern fixed foreach implicit internal lock
        namespace operator out override params readonly ref sbyte sizeof stackalloc string struct uint ulong unchecked unsafe ushort
        using virtual dynamic await async partial where global nameof nint nuint
        """,
    )

    /** Types of Java, Kotlin, C# and the runtimes that generated code uses without a namespace. */
    val types: Set<String> = words(
        """
        BaseVector Boolean BooleanArray BooleanVector Byte ByteArray ByteBuffer ByteOrder ByteVector Class Constants Double DoubleArray
        DoubleVector EditorBrowsableAttribute EditorBrowsableState FlatBufferBuilder FlatBufferConstants Float FloatArray FloatVector
        IFlatbufferObject Int IntArray IntVector
        JvmOverloads LayoutKind List Long LongArray LongVector Map Short ShortArray ShortVector String StringOffset StringVector Struct
        StructLayoutAttribute SuppressWarnings Table UnionVector VectorOffset
        """,
    )

    /** First parts of namespaces that libraries or generated Kotlin use. */
    val roots: Set<String> = words(
        """
        java javax jdk sun kotlin kotlinx System Microsoft Mono Unity UnityEngine UnityEditor Bridge actuatorReader actuatorType
        actuatorWriter builder constant data depth fault globalReader i init it items name pack place result sensorReader sensorType
        sensorView target types
        """,
    )

    /** The product's namespaces, whose classes take precedence in the host. */
    val packages: Set<String> = words(
        """
        com com.google com.google.flatbuffers org org.collektive org.collektive.frame org.collektive.frames org.collektive.frames.data
        org.collektive.schema org.collektive.host org.collektive.api org.collektive.engine Collektive Collektive.Bridge Collektive.Unity
        Collektive.FlatBuffers it it.unibo
        """,
    )
}
