package org.collektive.compiler.names

import org.jetbrains.kotlin.name.CallableId
import org.jetbrains.kotlin.name.ClassId
import org.jetbrains.kotlin.name.FqName
import org.jetbrains.kotlin.name.Name

/** The names of the DSL declarations that the plugin uses. */
internal object DslNames {
    private val aggregatePackage = FqName("it.unibo.collektive.aggregate")
    val apiPackage = FqName("it.unibo.collektive.aggregate.api")
    private val alignmentPackage = FqName("org.collektive.alignment")

    val field = ClassId(aggregatePackage, Name.identifier("Field"))
    val aggregate = ClassId(apiPackage, Name.identifier("Aggregate"))
    val ignore = ClassId(apiPackage, Name.identifier("CollektiveIgnore"))
    val yieldingContext = ClassId(apiPackage, Name.identifier("YieldingContext"))

    val align = Name.identifier("align")
    val dealign = Name.identifier("dealign")
    val alignedOn = Name.identifier("alignedOn")
    val neighboring = Name.identifier("neighboring")
    val yielding = Name.identifier("yielding")
    val context = Name.identifier("context")
    val local = Name.identifier("local")
    val localValue = Name.identifier("localValue")

    val runningDevice = CallableId(alignmentPackage, Name.identifier("runningDevice"))
    val pushToken = CallableId(alignmentPackage, Name.identifier("pushToken"))
    val pushBranchToken = CallableId(alignmentPackage, Name.identifier("pushBranchToken"))
    val pushLambdaToken = CallableId(alignmentPackage, Name.identifier("pushLambdaToken"))
    val popToken = CallableId(alignmentPackage, Name.identifier("popToken"))
    val recordFailure = CallableId(alignmentPackage, Name.identifier("recordFailure"))
    val project = CallableId(alignmentPackage, Name.identifier("project"))
}
