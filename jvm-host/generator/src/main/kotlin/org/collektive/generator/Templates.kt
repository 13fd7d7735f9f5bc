package org.collektive.generator

import com.samskivert.mustache.Mustache

/** Renders the templates of `schema/templates`, which are resources of this package. */
internal object Templates {
    private val compiler = Mustache.compiler().escapeHTML(false).strictSections(true)

    fun render(template: String, model: Any): String {
        val resource = "$template.mustache"
        val stream = Templates::class.java.getResourceAsStream(resource)
            ?: throw IllegalStateException("$resource is missing from the jar: rebuild the jar")
        return stream.reader().use { compiler.compile(it).execute(model) }
    }
}
