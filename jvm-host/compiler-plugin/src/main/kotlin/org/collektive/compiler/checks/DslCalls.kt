package org.collektive.compiler.checks

import org.collektive.compiler.names.DslNames
import org.jetbrains.kotlin.fir.FirSession
import org.jetbrains.kotlin.fir.expressions.FirFunctionCall
import org.jetbrains.kotlin.fir.references.toResolvedFunctionSymbol
import org.jetbrains.kotlin.fir.resolve.fullyExpandedType
import org.jetbrains.kotlin.fir.resolve.toRegularClassSymbol
import org.jetbrains.kotlin.fir.symbols.impl.FirFunctionSymbol
import org.jetbrains.kotlin.fir.types.ConeDefinitelyNotNullType
import org.jetbrains.kotlin.fir.types.ConeFlexibleType
import org.jetbrains.kotlin.fir.types.ConeKotlinType
import org.jetbrains.kotlin.fir.types.ConeTypeParameterType
import org.jetbrains.kotlin.fir.types.classId
import org.jetbrains.kotlin.fir.types.coneType
import org.jetbrains.kotlin.name.ClassId
import org.jetbrains.kotlin.name.Name

/** The function that a call was resolved to. */
internal val FirFunctionCall.callee: FirFunctionSymbol<*>? get() = calleeReference.toResolvedFunctionSymbol()

/** Returns whether this is the member [name] of Aggregate, or the extension function of that name in the DSL's package. */
internal fun FirFunctionSymbol<*>.isDsl(name: Name): Boolean =
    callableId.callableName == name && callableId.packageName == DslNames.apiPackage

context(session: FirSession)
internal fun ConeKotlinType.isField(): Boolean = isOf(DslNames.field)

context(session: FirSession)
internal fun ConeKotlinType.isAggregate(): Boolean = isOf(DslNames.aggregate)

context(session: FirSession)
private fun ConeKotlinType.isOf(type: ClassId): Boolean = when (val expanded = fullyExpandedType(session)) {
    is ConeTypeParameterType -> expanded.lookupTag.typeParameterSymbol.resolvedBounds.any { it.coneType.isOf(type) }

    is ConeDefinitelyNotNullType -> expanded.original.isOf(type)

    is ConeFlexibleType -> expanded.upperBound.isOf(type)

    else ->
        expanded.classId == type ||
            expanded.toRegularClassSymbol(session)?.resolvedSuperTypes?.any { it.isOf(type) } == true
}
