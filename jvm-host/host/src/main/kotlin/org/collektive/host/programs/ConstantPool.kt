package org.collektive.host.programs

import java.io.ByteArrayInputStream
import java.io.DataInputStream
import java.io.IOException

/**
 * The constants of a class file.
 *
 * @property texts all texts.
 * @property classes the referenced classes, such as `java/lang/String`, without array classes.
 */
internal class ConstantPool private constructor(val texts: List<String>, val classes: List<String>) {
    companion object {
        /** Reads the class file [bytes]. Empty if it is damaged or of an unknown format: the JVM reports that when it loads the class. */
        fun of(bytes: ByteArray): ConstantPool = try {
            read(bytes)
        } catch (_: IOException) {
            EMPTY
        }

        private fun read(bytes: ByteArray): ConstantPool {
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

                    else -> return EMPTY
                }
                index++
            }
            return ConstantPool(texts.filterNotNull(), classes.mapNotNull { texts[it] }.filterNot { it.startsWith('[') })
        }

        private val EMPTY = ConstantPool(emptyList(), emptyList())

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
}
