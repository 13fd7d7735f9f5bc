package org.collektive.host.library

import java.io.ByteArrayInputStream
import java.io.DataInputStream
import java.io.IOException

/** Lists the classes that a class file references, such as `java/lang/String`, without array classes. */
internal object ClassReferences {
    /** Returns the names in the class file [bytes]. Empty if it is damaged or of an unknown format: the JVM reports that when it loads the class. */
    fun of(bytes: ByteArray): List<String> = try {
        read(bytes)
    } catch (_: IOException) {
        emptyList()
    }

    private fun read(bytes: ByteArray): List<String> {
        val input = DataInputStream(ByteArrayInputStream(bytes))
        input.skipBytes(HEADER_BYTES)
        val count = input.readUnsignedShort()
        val texts = arrayOfNulls<String>(count)
        val classes = ArrayList<Int>()
        var index = 1
        while (index < count) {
            when (input.readUnsignedByte()) {
                UTF8 -> texts[index] = input.readUTF()

                CLASS -> classes += input.readUnsignedShort()

                LONG, DOUBLE -> {
                    input.skipBytes(Long.SIZE_BYTES)
                    // These constants take two entries.
                    index++
                }

                STRING, METHOD_TYPE, MODULE, PACKAGE -> input.skipBytes(Short.SIZE_BYTES)

                METHOD_HANDLE -> input.skipBytes(Short.SIZE_BYTES + 1)

                in OTHERS -> input.skipBytes(Int.SIZE_BYTES)

                else -> return emptyList()
            }
            index++
        }
        return classes.mapNotNull { texts[it] }.filterNot { it.startsWith('[') }
    }

    // Tags of the constant pool, Java Virtual Machine Specification 4.4.
    private const val HEADER_BYTES = 8
    private const val UTF8 = 1
    private const val LONG = 5
    private const val DOUBLE = 6
    private const val CLASS = 7
    private const val STRING = 8
    private const val METHOD_HANDLE = 15
    private const val METHOD_TYPE = 16
    private const val MODULE = 19
    private const val PACKAGE = 20

    /** Tags of numbers, references to members, names with types, and dynamic constants. */
    private val OTHERS = setOf(3, 4, 9, 10, 11, 12, 17, 18)
}
