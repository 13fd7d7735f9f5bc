package org.collektive.compiler.alignment

import org.jetbrains.kotlin.ir.declarations.IrDeclaration
import org.jetbrains.kotlin.ir.declarations.IrDeclarationWithName
import org.jetbrains.kotlin.ir.declarations.IrFile
import org.jetbrains.kotlin.ir.declarations.IrFunction
import org.jetbrains.kotlin.ir.util.kotlinFqName
import org.jetbrains.kotlin.ir.util.parents
import org.jetbrains.kotlin.ir.util.render

/**
 * Creates the tokens of one [file], such as `share@Swarm.kt:12#9c1d3a5e7f00b2d4`: the called function or chosen arm, its location, and a
 * 64-bit hash of module, file, enclosing declarations with their parameters, and the token's number among those for the same name inside
 * these.
 *
 * An entry is a lambda with an Aggregate receiver that is not inside other aggregate code, such as the lambda passed to
 * `Collektive.aggregate`. Inside an entry, tokens have no location, and the hash covers only declarations inside the entry. Two entries
 * with the same calls in the same order therefore align, wherever they are written, if each is the whole program of its device. If an
 * entry is called inside a program, its tokens are below the token of the entry itself, which has a location.
 *
 * Tokens are compared by their whole text, so error messages need no table of names. The text depends only on the sources, so it is the
 * same on all devices that run the same jar.
 */
internal class Tokens(private val module: String, private val file: IrFile) {
    private val placesIn = HashMap<Pair<IrDeclaration?, String>, Int>()

    /** Returns a new token for [what] at [offset] of the file. It is inside [owner], which is inside [entry] unless that is `null`. */
    fun next(what: String, offset: Int, owner: IrDeclaration, entry: IrDeclaration?): String {
        val signature = signature(owner, entry)
        // In named functions, a new call must not change the tokens of calls with other names: a reload would lose their state.
        val place = placesIn.merge(entry to (if (entry == null) "$signature\n$what" else signature), 1, Int::plus)
        if (entry != null) return "$what@#${hashed("$signature\n$place")}"
        val line = file.fileEntry.getLineNumber(offset) + 1
        return "$what@${file.shortName()}:$line#${hashed("$module\n${file.kotlinFqNameAndName()}\n$signature\n$place")}"
    }

    private fun hashed(text: String) = fnv1a(text).toULong().toString(HEX).padStart(HEX, '0')

    private fun IrFile.kotlinFqNameAndName() = "${packageFqName.asString()}/${shortName()}"

    private fun IrFile.shortName() = fileEntry.name.substringAfterLast('/').substringAfterLast('\\')

    private fun signature(owner: IrDeclaration, entry: IrDeclaration?): String =
        (sequenceOf(owner) + owner.parents.filterIsInstance<IrDeclaration>()).takeWhile { it !== entry }.joinToString("<") { declaration ->
            val name = (declaration as? IrDeclarationWithName)?.name?.asString().orEmpty()
            if (declaration is IrFunction) name + declaration.parameters.joinToString(",", "(", ")") { it.type.render() } else name
        }

    private fun fnv1a(text: String): Long {
        var hash = FNV_BASIS
        for (byte in text.encodeToByteArray()) hash = (hash xor (byte.toLong() and 0xff)) * FNV_PRIME
        return hash
    }

    private companion object {
        const val HEX = 16
        const val FNV_BASIS = -0x340d631b7bdddcdbL
        const val FNV_PRIME = 0x100000001b3L
    }
}
