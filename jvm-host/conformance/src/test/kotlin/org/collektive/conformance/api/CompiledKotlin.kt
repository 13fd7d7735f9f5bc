package org.collektive.conformance.api

import java.io.File
import java.net.URLClassLoader
import java.util.jar.JarFile
import kotlin.metadata.jvm.KotlinClassMetadata

/** Returns the Kotlin classes in the folder or jar [place] with their metadata, sorted by name. */
internal fun compiledKotlin(place: File): List<Pair<Class<*>, KotlinClassMetadata>> {
    val loader = URLClassLoader(arrayOf(place.toURI().toURL()), Declarations::class.java.classLoader)
    val files = when {
        place.isFile -> JarFile(place).use { jar -> jar.entries().toList().map { it.name } }
        else -> place.walk().map { it.relativeTo(place).invariantSeparatorsPath }.toList()
    }
    return files.filter { it.endsWith(".class") && !it.startsWith("META-INF") }.sorted().mapNotNull { name ->
        val type = loader.loadClass(name.removeSuffix(".class").replace('/', '.'))
        type.getAnnotation(Metadata::class.java)?.let { type to KotlinClassMetadata.readStrict(it) }
    }
}
