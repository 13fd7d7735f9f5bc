@file:OptIn(UnsafeDuringIrConstructionAPI::class)

package org.collektive.compiler.alignment

import org.collektive.compiler.names.DslNames
import org.jetbrains.kotlin.backend.common.extensions.DeclarationFinder
import org.jetbrains.kotlin.descriptors.DescriptorVisibilities
import org.jetbrains.kotlin.ir.IrElement
import org.jetbrains.kotlin.ir.declarations.IrClass
import org.jetbrains.kotlin.ir.declarations.IrDeclaration
import org.jetbrains.kotlin.ir.declarations.IrDeclarationOrigin
import org.jetbrains.kotlin.ir.declarations.IrFunction
import org.jetbrains.kotlin.ir.declarations.IrParameterKind
import org.jetbrains.kotlin.ir.declarations.IrProperty
import org.jetbrains.kotlin.ir.declarations.IrSimpleFunction
import org.jetbrains.kotlin.ir.expressions.IrFunctionAccessExpression
import org.jetbrains.kotlin.ir.expressions.IrGetValue
import org.jetbrains.kotlin.ir.symbols.IrClassSymbol
import org.jetbrains.kotlin.ir.symbols.IrSimpleFunctionSymbol
import org.jetbrains.kotlin.ir.symbols.UnsafeDuringIrConstructionAPI
import org.jetbrains.kotlin.ir.types.IrType
import org.jetbrains.kotlin.ir.types.getClass
import org.jetbrains.kotlin.ir.util.functions
import org.jetbrains.kotlin.ir.util.getPackageFragment
import org.jetbrains.kotlin.ir.util.getPropertyGetter
import org.jetbrains.kotlin.ir.util.isFakeOverride
import org.jetbrains.kotlin.ir.util.isFunctionTypeOrSubtype
import org.jetbrains.kotlin.ir.util.isNullable
import org.jetbrains.kotlin.ir.util.isSubtypeOfClass
import org.jetbrains.kotlin.ir.util.parentClassOrNull
import org.jetbrains.kotlin.ir.util.properties
import org.jetbrains.kotlin.ir.util.resolveFakeOverride
import org.jetbrains.kotlin.name.Name

/** The declarations of the DSL on the class path of the module under compilation. */
internal class DslSymbols private constructor(
    val aggregate: IrClassSymbol,
    val field: IrClassSymbol,
    val fieldContext: IrSimpleFunctionSymbol,
    val runningDevice: IrSimpleFunctionSymbol,
    val pushToken: IrSimpleFunctionSymbol,
    val pushBranchToken: IrSimpleFunctionSymbol,
    val pushLambdaToken: IrSimpleFunctionSymbol,
    val popToken: IrSimpleFunctionSymbol,
    val recordFailure: IrSimpleFunctionSymbol,
    val project: IrSimpleFunctionSymbol,
    classes: List<IrClass>,
) {
    private val values = Containment(this, classes) { isAggregate(it) || isField(it) }
    private val code = Containment(this, classes) { isAggregate(it) || isField(it) || isFunction(it) }

    fun isAggregate(type: IrType) = type.isSubtypeOfClass(aggregate)

    fun isField(type: IrType) = type.isSubtypeOfClass(field)

    /** Whether a value of [type] is or may contain an Aggregate or a Field. */
    fun containsDslType(type: IrType): Boolean = values.isIn(type)

    /** Whether the code in [element] has a value for which [containsDslType] holds. */
    fun usesDslType(element: IrElement): Boolean = values.isUsedIn(element)

    /** Whether a value of [type] is or may contain an Aggregate, a Field or a function, which may use one. */
    fun mayReachPrimitive(type: IrType): Boolean = code.isIn(type)

    private fun isFunction(type: IrType) = type.isFunctionTypeOrSubtype() || type.getClass()?.isFun == true

    /** Whether [declaration] belongs to Kotlin or the JDK. */
    fun isPlatform(declaration: IrDeclaration): Boolean = PLATFORM.any(declaration.getPackageFragment().packageFqName::startsWith)

    /**
     * The property in which an object of [type] stores the Aggregate of its program, or `null`. Implementations of Aggregate
     * are excluded, because their property is a delegate.
     */
    fun aggregateProperty(type: IrClass): IrProperty? =
        if (type.symbol.isSubtypeOfClass(aggregate)) null else type.properties.firstOrNull(::isAggregateProperty)

    private fun isAggregateProperty(property: IrProperty): Boolean {
        if (property.isVar || property.isDelegated) return false
        val getter = property.getter
        val kept = property.backingField?.type ?: getter?.takeIf(::isInheritedOrAbstract)?.returnType ?: return false
        return isAggregate(kept) && !kept.isNullable()
    }

    /** Whether [getter] is a plain, non-private getter that a superclass defines or a subclass must define. */
    private fun isInheritedOrAbstract(getter: IrSimpleFunction): Boolean {
        val real = generateSequence(getter) { it.overriddenSymbols.firstOrNull()?.owner }.firstOrNull { !it.isFakeOverride } ?: return false
        return real.origin == IrDeclarationOrigin.DEFAULT_PROPERTY_ACCESSOR && !DescriptorVisibilities.isPrivate(real.visibility) &&
            getter.parameters.all { it.kind == IrParameterKind.DispatchReceiver }
    }

    /** Whether [function] is a member of Aggregate, or overrides one. */
    fun isAggregateMember(function: IrFunction): Boolean = function.parentClassOrNull?.symbol == aggregate ||
        function is IrSimpleFunction && function.overriddenSymbols.any { isAggregateMember(it.owner) }

    /** Whether [type] delegates alignment to another Aggregate (`by`). Its members are then part of the program. */
    fun isAggregateByDelegation(type: IrClass): Boolean {
        if (!type.symbol.isSubtypeOfClass(aggregate)) return false
        val align = type.functions.firstOrNull { it.name == DslNames.align && isAggregateMember(it) }?.resolveFakeOverride()
        return align?.origin == IrDeclarationOrigin.DELEGATED_MEMBER
    }

    fun isFieldMember(function: IrFunction) = function.parentClassOrNull?.symbol == field

    /** Whether [call] reads this device's entry of a variable, which projection does not change. */
    fun readsLocalEntry(call: IrFunctionAccessExpression): Boolean {
        val property = (call.symbol.owner as? IrSimpleFunction)?.takeIf(::isFieldMember)?.correspondingPropertySymbol ?: return false
        return call.dispatchReceiver is IrGetValue && property.owner.name in LOCAL_ENTRY
    }

    /** Whether [function] is `align` or `dealign`. */
    fun isManualAlignment(function: IrFunction) =
        isAggregateMember(function) && (function.name == DslNames.align || function.name == DslNames.dealign)

    companion object {
        /** First segments of packages that contain no programs. */
        private val PLATFORM = listOf("kotlin", "kotlinx", "java", "javax").map(Name::identifier)

        private val LOCAL_ENTRY = setOf(DslNames.local, DslNames.localValue, DslNames.context)

        /** Finds the DSL for a module with these [classes]; `null` when it is not on the class path, so nothing needs to be aligned. */
        fun find(finder: DeclarationFinder, classes: List<IrClass>): DslSymbols? {
            val field = finder.findClass(DslNames.field) ?: return null
            return DslSymbols(
                aggregate = finder.findClass(DslNames.aggregate) ?: return null,
                field = field,
                fieldContext = field.getPropertyGetter(DslNames.context.asString()) ?: return null,
                runningDevice = finder.findFunctions(DslNames.runningDevice).singleOrNull() ?: return null,
                pushToken = finder.findFunctions(DslNames.pushToken).singleOrNull() ?: return null,
                pushBranchToken = finder.findFunctions(DslNames.pushBranchToken).singleOrNull() ?: return null,
                pushLambdaToken = finder.findFunctions(DslNames.pushLambdaToken).singleOrNull() ?: return null,
                popToken = finder.findFunctions(DslNames.popToken).singleOrNull() ?: return null,
                recordFailure = finder.findFunctions(DslNames.recordFailure).singleOrNull() ?: return null,
                project = finder.findFunctions(DslNames.project).singleOrNull() ?: return null,
                classes = classes,
            )
        }
    }
}
