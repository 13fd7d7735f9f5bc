@file:OptIn(UnsafeDuringIrConstructionAPI::class)

package org.collektive.compiler.programs

import org.jetbrains.kotlin.backend.common.extensions.IrGenerationExtension
import org.jetbrains.kotlin.backend.common.extensions.IrPluginContext
import org.jetbrains.kotlin.ir.declarations.IrAnnotationContainer
import org.jetbrains.kotlin.ir.declarations.IrClass
import org.jetbrains.kotlin.ir.declarations.IrEnumEntry
import org.jetbrains.kotlin.ir.declarations.IrFile
import org.jetbrains.kotlin.ir.declarations.IrModuleFragment
import org.jetbrains.kotlin.ir.declarations.IrParameterKind
import org.jetbrains.kotlin.ir.declarations.IrSimpleFunction
import org.jetbrains.kotlin.ir.expressions.IrClassReference
import org.jetbrains.kotlin.ir.expressions.IrConst
import org.jetbrains.kotlin.ir.expressions.IrConstructorCall
import org.jetbrains.kotlin.ir.expressions.IrExpression
import org.jetbrains.kotlin.ir.expressions.IrVararg
import org.jetbrains.kotlin.ir.symbols.UnsafeDuringIrConstructionAPI
import org.jetbrains.kotlin.ir.types.classFqName
import org.jetbrains.kotlin.ir.util.getAnnotation
import org.jetbrains.kotlin.load.kotlin.PackagePartClassUtils
import org.jetbrains.kotlin.name.FqName
import java.io.File

/**
 * Lists the programs of a module below [output], so that tools can read them from a jar without a JVM.
 *
 * There is one UTF-8 file for each class that declares programs, `META-INF/collektive/programs/CLASS`, so an incremental compilation
 * rewrites only the files of the changed classes. An index without its class is stale. Each line is one record; its columns are
 * separated by tabs, and `\\`, `\t`, `\n`, `\r` stand for these characters in a column:
 *
 * - `program`: the program's name, and the qualified name of its sensor data type;
 * - `parameter`, for the program above: its name, its default, its description, and the constants of its enum class.
 */
internal class ProgramIndex(private val output: File) : IrGenerationExtension {
    override fun generate(moduleFragment: IrModuleFragment, pluginContext: IrPluginContext) {
        for ((className, files) in moduleFragment.files.groupBy(::className)) {
            val lines = files.flatMap(IrFile::declarations).filterIsInstance<IrSimpleFunction>().flatMap(::records)
            val index = output.resolve(FOLDER).resolve(className)
            if (lines.isEmpty()) {
                index.delete()
            } else {
                index.parentFile.mkdirs()
                index.writeText(lines.joinToString(""))
            }
        }
    }

    private fun records(function: IrSimpleFunction): List<String> {
        val program = function.getAnnotation(PROGRAM)?.arguments ?: return emptyList()
        val sensors = function.parameters.firstOrNull { it.kind == IrParameterKind.Regular }?.type?.classFqName?.asString().orEmpty()
        val parameters = (program.getOrNull(1) as? IrVararg)?.elements.orEmpty().filterIsInstance<IrConstructorCall>()
        return listOf(record("program", program[0].text(), sensors)) +
            parameters.map { it.arguments }.map {
                record("parameter", it[0].text(), it[1].text(), it[2].text(), *it.getOrNull(3).constants())
            }
    }

    /** The class that the top-level functions of [file] are compiled to. */
    private fun className(file: IrFile): String {
        val name = file.jvmName() ?: PackagePartClassUtils.getFilePartShortName(File(file.fileEntry.name).name)
        return if (file.packageFqName.isRoot) name else "${file.packageFqName.asString()}.$name"
    }

    private fun IrAnnotationContainer.jvmName(): String? = getAnnotation(JVM_NAME)?.arguments?.get(0)?.text()

    private fun IrExpression?.text(): String = (this as? IrConst)?.value as? String ?: ""

    private fun IrExpression?.constants(): Array<String> {
        val type = (this as? IrClassReference)?.symbol?.owner as? IrClass
        return type?.declarations.orEmpty().filterIsInstance<IrEnumEntry>().map { it.name.asString() }.toTypedArray()
    }

    private fun record(vararg columns: String) = columns.joinToString("\t", postfix = "\n") {
        it.replace("\\", "\\\\").replace("\t", "\\t").replace("\n", "\\n").replace("\r", "\\r")
    }

    private companion object {
        const val FOLDER = "META-INF/collektive/programs"
        val PROGRAM = FqName("org.collektive.api.Program")
        val JVM_NAME = FqName("kotlin.jvm.JvmName")
    }
}
