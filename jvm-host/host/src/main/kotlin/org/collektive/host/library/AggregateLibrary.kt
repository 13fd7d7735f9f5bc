package org.collektive.host.library

import org.collektive.host.programs.JarBytes
import org.collektive.host.programs.JarLoader
import org.collektive.host.programs.ProgramJar
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import org.collektive.spi.DeviceRuntimes
import org.collektive.spi.RuntimeProvider
import org.collektive.spi.SharingRule
import java.io.IOException
import java.net.URLClassLoader
import java.nio.file.Files
import java.nio.file.NoSuchFileException
import java.nio.file.Path
import java.security.MessageDigest
import java.util.EnumMap
import java.util.ServiceLoader
import java.util.zip.ZipFile
import kotlin.io.path.exists
import kotlin.io.path.isDirectory
import kotlin.io.path.isRegularFile
import kotlin.io.path.listDirectoryEntries
import kotlin.io.path.name
import kotlin.io.path.readBytes

/**
 * The library that programs link to and the host does not: the DSL, its standard library, and the runtime that implements them.
 *
 * @property runtime the kind of this library.
 * @property loader the parent of the programs' class loader.
 */
public class AggregateLibrary private constructor(
    public val runtime: AggregateRuntime,
    public val loader: ClassLoader,
    private val provider: RuntimeProvider,
    private val folder: Path?,
) {
    /**
     * SHA-256 of the user's jars, concatenated in the order of their names, as the build tools write it into programs' jars; empty for the
     * built-in runtime.
     */
    public val hash: String by lazy { folder?.let { hash(userJars(it)) }.orEmpty() }

    /**
     * Creates the devices of one session, see [RuntimeProvider.runtimes].
     *
     * @throws HostException when a class or function that the runtime needs is missing in the jars.
     */
    public fun runtimes(rule: SharingRule): DeviceRuntimes = try {
        provider.runtimes(rule)
    } catch (e: LinkageError) {
        throw HostException(
            HostError.PROGRAM,
            "the $this does not work: $e. A jar is missing or of another version than $VERSION: put Collektive's dsl and stdlib, " +
                "both of that version, and their dependencies into that folder",
            e,
        )
    }

    /** Returns whether the library contains the class [name], such as `java/lang/String`. */
    internal fun contains(name: String): Boolean = loader.getResource("$name.class") != null

    override fun toString(): String = runtime.title + if (folder == null) "" else " of $folder"

    public companion object {
        /** The version of Collektive that the adapter supports. */
        public const val VERSION: String = "28.3"

        /** The folder of the host's jar; `null` if the host runs from a folder of classes, with all libraries on the class path. */
        private val home: Path? = Path.of(AggregateLibrary::class.java.protectionDomain.codeSource.location.toURI())
            .takeIf { it.isRegularFile() }?.parent

        private val last = EnumMap<AggregateRuntime, Pair<List<Any>, AggregateLibrary>>(AggregateRuntime::class.java)

        /**
         * Returns the library of [runtime]. Caches the last one of each runtime, so the next session uses compiled classes. Not thread-safe.
         *
         * @param folder the folder of the jars of [AggregateRuntime.COLLEKTIVE].
         * @throws HostException when a jar is missing or cannot be read.
         */
        public fun of(runtime: AggregateRuntime, folder: String): AggregateLibrary {
            val place = if (runtime == AggregateRuntime.BUILT_IN || home == null) null else place(folder)
            val jars = listOfNotNull(home?.resolve(runtime.jar)) + place?.let(::userJars).orEmpty()
            val key = jars.map(::state)
            last[runtime]?.let { (known, library) -> if (known == key) return library }
            return load(runtime, jars, place).also { last[runtime] = key to it }
        }

        private fun load(runtime: AggregateRuntime, jars: List<Path>, folder: Path?): AggregateLibrary {
            val host = AggregateLibrary::class.java.classLoader
            val loader = when {
                jars.isEmpty() -> host
                folder == null -> URLClassLoader("library", jars.map { it.toUri().toURL() }.toTypedArray(), host)
                else -> loaderInMemory(jars)
            }
            val provider = ServiceLoader.load(RuntimeProvider::class.java, loader).find { it.name == runtime.key }
                ?: throw HostException(
                    HostError.HOST,
                    "${runtime.jar} next to the host's jar does not contain the ${runtime.title}; reinstall the package",
                )
            return AggregateLibrary(runtime, loader, provider, folder)
        }

        /** Reads [jars] into memory, because users may replace them and Windows locks open files. The package's jar loads faster from its file. */
        internal fun loaderInMemory(jars: List<Path>): ClassLoader =
            JarLoader("library", jars.map { ProgramJar.open(JarBytes.read(it.toString())) }, AggregateLibrary::class.java.classLoader)

        private fun place(folder: String): Path {
            if (folder.isEmpty()) throw noJars("the setting 'runtimeJars' is empty")
            val place = Path.of(folder)
            if (!place.isDirectory()) throw noJars("folder $place does not exist")
            if (userJars(place).isEmpty()) throw noJars("folder $place contains no jar")
            return place
        }

        private fun noJars(what: String) = HostException(
            HostError.PROGRAM,
            "$what: put Collektive's dsl and stdlib, version $VERSION, and their dependencies into a folder and set 'runtimeJars' to it",
        )

        private fun userJars(folder: Path): List<Path> = folder.listDirectoryEntries("*.jar").sortedBy(Path::name)

        private fun hash(jars: List<Path>): String {
            val digest = MessageDigest.getInstance("SHA-256")
            for (jar in jars) digest.update(jar.readBytes())
            return digest.digest().joinToString("") { "%02x".format(it) }
        }

        /** Returns a key that changes when [jar] is replaced. */
        private fun state(jar: Path): Any = try {
            // Opening a pipe would wait for its writer.
            if (jar.exists() && !jar.isRegularFile()) throw IOException("it is not a file")
            // Class loaders silently ignore unreadable jars, so this opens the jar.
            ZipFile(jar.toFile()).close()
            Triple(jar, Files.getLastModifiedTime(jar), Files.size(jar))
        } catch (e: NoSuchFileException) {
            throw HostException(HostError.HOST, "library jar $jar does not exist; reinstall the package", e)
        } catch (e: IOException) {
            throw HostException(HostError.PROGRAM, "the library jar $jar cannot be read: $e; replace it with a valid copy", e)
        }
    }
}
