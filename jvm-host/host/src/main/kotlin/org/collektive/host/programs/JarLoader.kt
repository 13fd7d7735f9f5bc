package org.collektive.host.programs

import java.io.ByteArrayInputStream
import java.io.InputStream
import java.net.URL
import java.net.URLConnection
import java.net.URLStreamHandler
import java.util.Collections
import java.util.Enumeration

/** A class loader that reads from memory and keeps no files open. Searches [parent] first, then [jars] in order. */
public open class JarLoader(name: String, private val jars: List<ProgramJar>, parent: ClassLoader) : ClassLoader(name, parent) {
    /** The class files of the jars. */
    internal val classFiles: List<ByteArray> get() = jars.flatMap { jar -> jar.entries.filterKeys { it.endsWith(".class") }.values }

    override fun findClass(name: String): Class<*> {
        val bytes = find(name.replace('.', '/') + ".class") ?: throw ClassNotFoundException(name)
        return defineClass(name, bytes, 0, bytes.size)
    }

    override fun findResource(name: String): URL? = jars.firstNotNullOfOrNull { it.urlOf(name) }

    override fun findResources(name: String): Enumeration<URL> = Collections.enumeration(jars.mapNotNull { it.urlOf(name) })

    private fun find(name: String): ByteArray? = jars.firstNotNullOfOrNull { it.entries[name] }

    private fun ProgramJar.urlOf(name: String): URL? {
        val bytes = entries[name] ?: return null
        return URL("memory", "", -1, "$path!/$name", MemoryHandler(bytes))
    }

    private class MemoryHandler(private val bytes: ByteArray) : URLStreamHandler() {
        override fun openConnection(url: URL): URLConnection = object : URLConnection(url) {
            override fun connect() {
                connected = true
            }

            override fun getInputStream(): InputStream = ByteArrayInputStream(bytes)
        }
    }

    private companion object {
        init {
            registerAsParallelCapable()
        }
    }
}
