package org.collektive.architecture

import org.w3c.dom.Element
import org.w3c.dom.NodeList
import java.io.File
import javax.xml.parsers.DocumentBuilderFactory

/** What the POMs of `jvm-host` say. */
internal object Poms {
    val root = File(System.getProperty("collektive.root"))

    val modules: List<String> = elements(parent(), "module").map { it.textContent }

    /** The POM that all modules share. */
    fun parent(): Element = parse("jvm-host/pom.xml")

    fun of(module: String): Element = parse("jvm-host/$module/pom.xml")

    fun elements(parent: Element, name: String): List<Element> = parent.getElementsByTagName(name).toList()

    fun children(parent: Element): List<Element> = parent.childNodes.toList()

    private fun parse(path: String) = DocumentBuilderFactory.newInstance().newDocumentBuilder().parse(root.resolve(path)).documentElement

    private fun NodeList.toList() = (0 until length).mapNotNull { item(it) as? Element }
}
