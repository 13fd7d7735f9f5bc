package org.collektive.conformance.architecture

import org.w3c.dom.Element
import org.w3c.dom.NodeList
import java.io.File
import javax.xml.parsers.DocumentBuilderFactory

/** The POMs of `jvm-host`. */
internal object Poms {
    val root = File(System.getProperty("collektive.root"))

    val modules: List<String> = elements(parse("jvm-host/pom.xml"), "module").map { it.textContent }

    fun of(module: String): Element = parse("jvm-host/$module/pom.xml")

    fun elements(parent: Element, name: String): List<Element> = parent.getElementsByTagName(name).toList()

    private fun parse(path: String) = DocumentBuilderFactory.newInstance().newDocumentBuilder().parse(root.resolve(path)).documentElement

    private fun NodeList.toList() = (0 until length).mapNotNull { item(it) as? Element }
}
