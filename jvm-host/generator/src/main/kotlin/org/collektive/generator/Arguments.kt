package org.collektive.generator

import java.nio.file.Files
import java.nio.file.Path

/**
 * The generator's command line.
 *
 * @property schemas the users' schemas, at least one.
 * @property include the folder that contains `types.fbs`.
 * @property csharp the output folder for C#; `null` generates none.
 * @property jvm the output folder for Java and Kotlin; `null` generates none.
 * @property layouts the output folder for a Java class with the layouts of all tables of any schema, such as `frame.fbs`; `null`
 *   generates none.
 */
internal class Arguments(
    val flatc: Path,
    val schemas: List<Path>,
    val include: Path,
    val csharp: Path?,
    val jvm: Path?,
    val layouts: Path? = null,
) {
    companion object {
        const val USAGE: String =
            "usage: java -jar collektive-generator.jar --flatc FILE --schema FILE.fbs [--schema FILE.fbs]... --include FOLDER " +
                "[--csharp FOLDER] [--jvm FOLDER] [--layouts FOLDER]"

        private val options = setOf("--flatc", "--schema", "--include", "--csharp", "--jvm", "--layouts")

        fun parse(words: Array<String>): Arguments {
            val values = HashMap<String, List<Path>>()
            for (i in words.indices step 2) {
                val option = words[i]
                if (option !in options) throw GeneratorException("unknown option $option\n$USAGE")
                val value = words.getOrNull(i + 1) ?: throw GeneratorException("$option needs a value\n$USAGE")
                val others = values[option].orEmpty()
                if (others.isNotEmpty() && option != "--schema") throw GeneratorException("$option is used twice\n$USAGE")
                values[option] = others.plusElement(Path.of(value))
            }

            fun required(option: String) = values[option] ?: throw GeneratorException("$option is missing\n$USAGE")
            fun optional(option: String) = values[option]?.single()
            val arguments = Arguments(
                required("--flatc").single(),
                required("--schema"),
                required("--include").single(),
                optional("--csharp"),
                optional("--jvm"),
                optional("--layouts"),
            )
            if (!Files.isExecutable(arguments.flatc)) throw GeneratorException("no flatc at ${arguments.flatc}: run ./collektive setup")
            arguments.schemas.find { !Files.isRegularFile(it) }?.let { throw GeneratorException("schema not found: $it") }
            if (!Files.isRegularFile(arguments.include.resolve(CORE_TYPES))) {
                throw GeneratorException("no $CORE_TYPES in ${arguments.include}: set --include to the folder that contains it")
            }
            return arguments
        }
    }
}

/** The file of value types that user schemas may include. Their code is part of the product, so it is not generated again. */
internal const val CORE_TYPES: String = "types.fbs"
