@file:OptIn(UnsafeDuringIrConstructionAPI::class)

package org.collektive.compiler.alignment

import org.collektive.compiler.names.DslNames
import org.jetbrains.kotlin.backend.common.IrElementTransformerVoidWithContext
import org.jetbrains.kotlin.backend.common.extensions.IrPluginContext
import org.jetbrains.kotlin.backend.common.lower.DeclarationIrBuilder
import org.jetbrains.kotlin.backend.common.lower.irCatch
import org.jetbrains.kotlin.backend.common.lower.irThrow
import org.jetbrains.kotlin.ir.IrStatement
import org.jetbrains.kotlin.ir.builders.IrBlockBuilder
import org.jetbrains.kotlin.ir.builders.declarations.buildVariable
import org.jetbrains.kotlin.ir.builders.irBlock
import org.jetbrains.kotlin.ir.builders.irBoolean
import org.jetbrains.kotlin.ir.builders.irCall
import org.jetbrains.kotlin.ir.builders.irGet
import org.jetbrains.kotlin.ir.builders.irGetField
import org.jetbrains.kotlin.ir.builders.irReturn
import org.jetbrains.kotlin.ir.builders.irString
import org.jetbrains.kotlin.ir.builders.irTemporary
import org.jetbrains.kotlin.ir.builders.irTry
import org.jetbrains.kotlin.ir.declarations.IrAnnotationContainer
import org.jetbrains.kotlin.ir.declarations.IrAnonymousInitializer
import org.jetbrains.kotlin.ir.declarations.IrClass
import org.jetbrains.kotlin.ir.declarations.IrConstructor
import org.jetbrains.kotlin.ir.declarations.IrDeclaration
import org.jetbrains.kotlin.ir.declarations.IrDeclarationOrigin
import org.jetbrains.kotlin.ir.declarations.IrField
import org.jetbrains.kotlin.ir.declarations.IrFile
import org.jetbrains.kotlin.ir.declarations.IrFunction
import org.jetbrains.kotlin.ir.declarations.IrParameterKind
import org.jetbrains.kotlin.ir.declarations.IrProperty
import org.jetbrains.kotlin.ir.declarations.IrSimpleFunction
import org.jetbrains.kotlin.ir.declarations.IrValueDeclaration
import org.jetbrains.kotlin.ir.declarations.IrValueParameter
import org.jetbrains.kotlin.ir.declarations.IrVariable
import org.jetbrains.kotlin.ir.expressions.IrBlock
import org.jetbrains.kotlin.ir.expressions.IrBlockBody
import org.jetbrains.kotlin.ir.expressions.IrCall
import org.jetbrains.kotlin.ir.expressions.IrCatch
import org.jetbrains.kotlin.ir.expressions.IrConst
import org.jetbrains.kotlin.ir.expressions.IrConstructorCall
import org.jetbrains.kotlin.ir.expressions.IrExpression
import org.jetbrains.kotlin.ir.expressions.IrFunctionAccessExpression
import org.jetbrains.kotlin.ir.expressions.IrFunctionExpression
import org.jetbrains.kotlin.ir.expressions.IrGetObjectValue
import org.jetbrains.kotlin.ir.expressions.IrGetValue
import org.jetbrains.kotlin.ir.expressions.IrReturn
import org.jetbrains.kotlin.ir.expressions.IrStatementContainer
import org.jetbrains.kotlin.ir.expressions.IrStatementOrigin
import org.jetbrains.kotlin.ir.expressions.IrTypeOperatorCall
import org.jetbrains.kotlin.ir.expressions.IrWhen
import org.jetbrains.kotlin.ir.symbols.IrSimpleFunctionSymbol
import org.jetbrains.kotlin.ir.symbols.UnsafeDuringIrConstructionAPI
import org.jetbrains.kotlin.ir.types.IrSimpleType
import org.jetbrains.kotlin.ir.types.isNothing
import org.jetbrains.kotlin.ir.types.starProjectedType
import org.jetbrains.kotlin.ir.types.typeOrNull
import org.jetbrains.kotlin.ir.util.getPackageFragment
import org.jetbrains.kotlin.ir.util.hasAnnotation
import org.jetbrains.kotlin.ir.util.isFunctionTypeOrSubtype
import org.jetbrains.kotlin.ir.util.isNullable
import org.jetbrains.kotlin.ir.util.isSubtypeOfClass
import org.jetbrains.kotlin.ir.util.parentAsClass
import org.jetbrains.kotlin.ir.util.parentClassOrNull
import org.jetbrains.kotlin.ir.util.parents
import org.jetbrains.kotlin.ir.util.primaryConstructor
import org.jetbrains.kotlin.name.Name

/**
 * Rewrites the aggregate functions of one file:
 * - A call that can reach a primitive runs between the push and the pop of its token. Its arguments are evaluated before the push.
 * - An arm of a branch that contains such a call or reads a field also gets a token.
 * - A lambda with an Aggregate that is written outside aggregate functions runs below its own token, unless it is the whole program.
 * - Each read of a field goes through `project`, unless the region that reads it also made it.
 *
 * Pops are in `finally` blocks, so that no exit from a call (return, break, a caught exception) leaves a token on the stack. A `catch`
 * before each `finally` records the path of the failure while the stack still contains it.
 */
internal class AlignmentTransformer(
    private val plugin: IrPluginContext,
    private val dsl: DslSymbols,
    private val reach: AggregateReach,
    private val tokens: Tokens,
) : IrElementTransformerVoidWithContext() {
    /** The source of the current function's Aggregate; `null` outside aggregate functions. */
    private var source: Source? = null

    /** The outermost lambda with an Aggregate; `null` inside named aggregate functions. See [Tokens]. */
    private var entry: IrFunction? = null

    /** An Aggregate that is the [parameter] itself, or is stored in the parameter's [property]. Without a parameter, it is the running device. */
    private class Source(val parameter: IrValueParameter?, val property: IrProperty? = null)

    /** An arm, a function body or code between `align` and `dealign`. Different neighbours may be aligned inside it. */
    private class Region(val outer: Region?, val isBranch: Boolean)

    private var region: Region? = null
    private val regionOf = HashMap<IrValueDeclaration, Region?>()
    private val alignedBodies = HashSet<IrFunction>()

    /** Lambdas passed to primitives. Their parameters are new fields. */
    private val primitiveLambdas = HashSet<IrFunction>()

    /** Whether the current arm needs a token, because it contains an aligned call or a projected field. */
    private var dependsOnPath = false

    override fun visitFileNew(declaration: IrFile): IrFile = if (isIgnored(declaration)) declaration else super.visitFileNew(declaration)

    override fun visitClassNew(declaration: IrClass): IrStatement =
        if (isIgnored(declaration)) declaration else super.visitClassNew(declaration)

    override fun visitFieldNew(declaration: IrField): IrStatement =
        withSourceOfConstructor(declaration) { super.visitFieldNew(declaration) }

    override fun visitAnonymousInitializerNew(declaration: IrAnonymousInitializer): IrStatement =
        withSourceOfConstructor(declaration) { super.visitAnonymousInitializerNew(declaration) }

    /** Visits an initialiser of a class. It can read the parameters of the primary constructor, so the Aggregate may be one of them. */
    private inline fun <R> withSourceOfConstructor(initializer: IrDeclaration, visit: () -> R): R {
        val outer = source
        source = initializer.parentClassOrNull?.primaryConstructor?.let(::sourceIn) ?: sourceAround(initializer)
        return visit().also { source = outer }
    }

    override fun visitPropertyNew(declaration: IrProperty): IrStatement =
        if (isIgnored(declaration)) declaration else super.visitPropertyNew(declaration)

    override fun visitFunctionNew(declaration: IrFunction): IrStatement {
        if (isIgnored(declaration) || isForwarding(declaration)) return declaration
        val outerSource = source
        val outerRegion = region
        val outerEntry = entry
        source = sourceIn(declaration) ?: sourceAround(declaration)
        val outerDepends = dependsOnPath
        val isEntry = outerSource?.parameter == null && source?.parameter != null &&
            declaration.origin == IrDeclarationOrigin.LOCAL_FUNCTION_FOR_LAMBDA
        if (isEntry) {
            entry = declaration
            dependsOnPath = false
        }
        region = Region(outerRegion, isBranch = declaration in alignedBodies)
        if (declaration in primitiveLambdas) for (parameter in declaration.parameters) regionOf[parameter] = region
        val result = super.visitFunctionNew(declaration)
        if (isEntry) {
            if (dependsOnPath) alignEntry(declaration)
            dependsOnPath = outerDepends
        }
        source = outerSource
        region = outerRegion
        entry = outerEntry
        return result
    }

    override fun visitVariable(declaration: IrVariable): IrStatement {
        regionOf[declaration] = region
        return super.visitVariable(declaration)
    }

    override fun visitBlockBody(body: IrBlockBody): IrBlockBody = body.also(::visitStatements)

    override fun visitBlock(expression: IrBlock): IrExpression {
        if (expression.origin == IrStatementOrigin.SAFE_CALL) safeCalls += expression.statements.filterIsInstance<IrWhen>()
        return expression.also(::visitStatements)
    }

    /** The null checks that the compiler generates for `?.`. They are not branches of the program. */
    private val safeCalls = HashSet<IrWhen>()

    private fun visitStatements(container: IrStatementContainer) {
        val outer = region
        for (index in container.statements.indices) {
            val statement = container.statements[index].transform(this, null) as IrStatement
            container.statements[index] = statement
            val callee = (statement as? IrCall)?.symbol?.owner ?: continue
            if (source == null || !dsl.isManualAlignment(callee)) continue
            region = if (callee.name == DslNames.align) Region(region, isBranch = true) else region?.outer ?: outer
        }
        region = outer
    }

    override fun visitWhen(expression: IrWhen): IrExpression {
        if (source == null || expression in safeCalls) return super.visitWhen(expression)
        val outerRegion = region
        val outerDepends = dependsOnPath
        var depends = outerDepends
        for ((index, branch) in expression.branches.withIndex()) {
            branch.condition = branch.condition.transform(this, null)
            depends = depends || dependsOnPath
            dependsOnPath = false
            region = Region(outerRegion, isBranch = true)
            val arm = branch.result.transform(this, null)
            branch.result = if (dependsOnPath) aligned(arm, armName(expression, index)) else arm
            depends = depends || dependsOnPath
            dependsOnPath = outerDepends
            region = outerRegion
        }
        dependsOnPath = depends
        return expression
    }

    override fun visitGetValue(expression: IrGetValue): IrExpression {
        val declared = regionOf[expression.symbol.owner]
        val isInside = declared != null && declared === region || expression.origin == IrStatementOrigin.INITIALIZE_PROPERTY_FROM_PARAMETER
        return if (!isInside && dsl.isField(expression.type)) projected(expression, nameOf(expression), declared) else expression
    }

    /** Projects a value of another type that is read as a field, after `is` or with `as`. */
    override fun visitTypeOperator(expression: IrTypeOperatorCall): IrExpression {
        val value = expression.argument
        val name = when (value) {
            is IrGetValue -> nameOf(value)
            is IrFunctionAccessExpression -> callName(value)
            else -> "as"
        }
        val becomesField = dsl.isField(expression.type) && !dsl.isField(value.type)
        return super.visitTypeOperator(expression).let { if (becomesField) projected(it, name) else it }
    }

    /** Whether [call] may return an existing field, for example from a property, a list, a pair, or a function of these. */
    private fun mayReturnExistingField(call: IrCall) = dsl.isField(call.type) &&
        !dsl.isFieldMember(call.symbol.owner) && call.arguments.none { it != null && dsl.isField(it.type) } &&
        (call.arguments.none { it != null && dsl.isAggregate(it.type) } || mayReturnStored(call.symbol.owner) || !reach.mustAlign(call))

    /** Whether an aligned call of [callee] may return a stored field: from a delegate such as `lazy`, a data class, or the JDK. */
    private fun mayReturnStored(callee: IrFunction) = callee.origin == IrDeclarationOrigin.DELEGATED_PROPERTY_ACCESSOR ||
        callee.origin == IrDeclarationOrigin.GENERATED_DATA_CLASS_MEMBER || dsl.isPlatform(callee) && !reach.isKotlinBuiltIn(callee)

    private fun projected(field: IrExpression, name: String, declared: Region? = null): IrExpression {
        dependsOnPath = true
        val isInside = generateSequence(region) { it.outer }.takeWhile { it !== declared }.any { it.isBranch }
        return builderAt(field).run {
            irCall(dsl.project, field.type).apply {
                val given = (field.type as? IrSimpleType)?.arguments.orEmpty()
                for (index in typeArguments.indices) typeArguments[index] = given.getOrNull(index)?.typeOrNull ?: plugin.irBuiltIns.anyType
                arguments[0] = field
                arguments[1] = irString(token(name, field))
                arguments[2] = irBoolean(isInside)
            }
        }
    }

    private fun nameOf(read: IrGetValue) = read.symbol.owner.name.asString().trim('<', '>')

    override fun visitCall(expression: IrCall): IrExpression {
        val callee = expression.symbol.owner
        if (dsl.readsLocalEntry(expression)) return expression
        if (callee.name == DslNames.alignedOn && dsl.isAggregateMember(callee)) {
            functionArguments(expression).forEach { alignedBodies += it.function }
        } else if (callee.getPackageFragment().packageFqName == DslNames.apiPackage) {
            functionArguments(expression).forEach { primitiveLambdas += it.function }
        }
        if (dsl.isManualAlignment(callee)) dependsOnPath = true
        val needsProjection = mayReturnExistingField(expression)
        val result = visitAccess(expression)
        return if (needsProjection) projected(result, callName(expression)) else result
    }

    override fun visitConstructorCall(expression: IrConstructorCall): IrExpression = visitAccess(expression)

    private fun functionArguments(call: IrFunctionAccessExpression) = call.arguments.filterIsInstance<IrFunctionExpression>()

    private fun visitAccess(call: IrFunctionAccessExpression): IrExpression {
        val mustAlign = source != null && reach.mustAlign(call)
        call.transformChildren(this, null)
        return if (mustAlign) aligned(call) else call
    }

    /** Generates `arguments; push; try { call } catch (failure) { record it; rethrow it } finally { pop }`. */
    private fun aligned(call: IrFunctionAccessExpression): IrExpression {
        dependsOnPath = true
        val callee = call.symbol.owner
        val name = callName(call)
        return builderAt(call).irBlock(resultType = call.type) {
            for (parameter in callee.parameters) {
                val argument = call.arguments[parameter] ?: continue
                if (!isInlined(callee, parameter) && !isStable(argument)) {
                    call.arguments[parameter] = irGet(irTemporary(argument, nameHint = parameter.name.asString()))
                }
            }
            val given = call.arguments.firstOrNull { it is IrGetValue && dsl.isAggregate(it.type) && !it.type.isNullable() } as IrGetValue?
            align(call, token(name, call)) { if (given != null) irGet(given.symbol.owner, given.type) else current() }
        }
    }

    private fun aligned(arm: IrExpression, name: String): IrExpression =
        builderAt(arm).irBlock(resultType = arm.type) { align(arm, token(name, arm), dsl.pushBranchToken) { current() } }

    /** Runs the body of [lambda] below its own token, so that different lambdas called at one place are not aligned. */
    private fun alignEntry(lambda: IrFunction) {
        val statements = (lambda.body as? IrBlockBody)?.statements ?: return
        val last = statements.lastOrNull() as? IrExpression
        val result = (last as? IrReturn)?.takeIf { it.returnTargetSymbol == lambda.symbol }?.value
        val type = (result ?: last)?.type?.takeIf { result != null || it.isNothing() } ?: plugin.irBuiltIns.unitType
        val token = tokens.next("lambda", lambda.startOffset, lambda, null)
        DeclarationIrBuilder(plugin, lambda.symbol, lambda.startOffset, lambda.endOffset).run {
            val code = irBlock(resultType = type) {
                for (statement in statements) +(if (statement === last && result != null) result else statement)
            }
            val aligned = irBlock(resultType = type) { align(code, token, dsl.pushLambdaToken) { current() } }
            statements.clear()
            statements += if (result == null) aligned else irReturn(aligned)
        }
    }

    private fun IrBlockBuilder.align(
        body: IrExpression,
        token: String,
        pushFunction: IrSimpleFunctionSymbol = dsl.pushToken,
        aggregate: IrBlockBuilder.() -> IrExpression,
    ) {
        val push = irCall(pushFunction).apply {
            arguments[0] = aggregate()
            arguments[1] = irString(token)
        }
        val depth = irTemporary(push, nameHint = "depth")
        val pop = irCall(dsl.popToken).apply {
            arguments[0] = aggregate()
            arguments[1] = irGet(depth)
        }
        +irTry(body.type, body, listOf(recordAndRethrow(aggregate)), pop)
    }

    /** Generates `catch (failure: Throwable) { recordFailure(aggregate, failure); throw failure }`. */
    private fun IrBlockBuilder.recordAndRethrow(aggregate: IrBlockBuilder.() -> IrExpression): IrCatch {
        val failure = buildVariable(
            scope.getLocalDeclarationParent(),
            startOffset,
            endOffset,
            IrDeclarationOrigin.CATCH_PARAMETER,
            Name.identifier("failure"),
            plugin.irBuiltIns.throwableType,
        )
        val recordCall = irCall(dsl.recordFailure).apply {
            arguments[0] = aggregate()
            arguments[1] = irGet(failure)
        }
        return irCatch(
            failure,
            irBlock(resultType = plugin.irBuiltIns.nothingType) {
                +recordCall
                +irThrow(irGet(failure))
            },
        )
    }

    /** Reads the Aggregate of the enclosing function. */
    private fun IrBlockBuilder.current(): IrExpression {
        val source = checkNotNull(source)
        val parameter = source.parameter ?: return irCall(dsl.runningDevice)
        val given = irGet(parameter)
        val property = source.property
        val getter = property?.getter
        val field = property?.backingField
        return when {
            field != null -> irGetField(given, field)
            getter != null -> irCall(getter).apply { arguments[0] = given }
            dsl.isAggregate(parameter.type) -> given
            else -> irCall(dsl.fieldContext, dsl.aggregate.starProjectedType).apply { arguments[0] = given }
        }
    }

    /** Whether the compiler inlines a lambda passed for [parameter]; it must then stay a literal argument. */
    private fun isInlined(callee: IrFunction, parameter: IrValueParameter) =
        callee.isInline && !parameter.isNoinline && parameter.type.isFunctionTypeOrSubtype()

    /** Whether [argument] may be evaluated later: it has no side effects, and its value does not change. */
    private fun isStable(argument: IrExpression): Boolean = when (argument) {
        is IrConst, is IrFunctionExpression, is IrGetObjectValue -> true
        is IrGetValue -> argument.symbol.owner.let { it is IrValueParameter || it is IrVariable && !it.isVar }
        is IrTypeOperatorCall -> isStable(argument.argument)
        else -> argument.type.isNothing()
    }

    private fun sourceIn(function: IrFunction): Source? {
        val (self, given) = function.parameters.partition { it.kind == IrParameterKind.DispatchReceiver }
        val parameter = given.firstOrNull { dsl.isAggregate(it.type) }
            ?: given.firstOrNull { dsl.isField(it.type) && !it.type.isNullable() }
            ?: self.firstOrNull { function.parentClassOrNull?.let(dsl::isAggregateByDelegation) == true }
        return if (parameter != null) Source(parameter) else self.firstOrNull()?.let { storedIn(it, function.parentAsClass) }
    }

    /** Returns the Aggregate that [self], of class [type], or an enclosing object stores in a property, or `null`. */
    private fun storedIn(self: IrValueParameter, type: IrClass): Source? {
        dsl.aggregateProperty(type)?.let { return Source(self, it) }
        return if (type.isInner) type.parentAsClass.let { outer -> outer.thisReceiver?.let { storedIn(it, outer) } } else null
    }

    /** The Aggregate of the function around [code], or the running device. Not all code in a function needs the running device. */
    private fun sourceAround(code: IrDeclaration) = source?.takeIf { it.parameter != null } ?: runningDevice(code)

    /** The device that runs [code] if it uses an Aggregate or a Field, or `null`. Implementations of Aggregate are not programs. */
    private fun runningDevice(code: IrDeclaration): Source? {
        if (code.parents.any { it is IrClass && it.symbol.isSubtypeOfClass(dsl.aggregate) }) return null
        return if (dsl.usesDslType(code)) Source(null) else null
    }

    private fun isIgnored(declaration: IrAnnotationContainer) = declaration.hasAnnotation(DslNames.ignore)

    /** Whether [function] only forwards calls, because the compiler generated it for `by` or because it is inherited. */
    private fun isForwarding(function: IrFunction) =
        function.origin == IrDeclarationOrigin.DELEGATED_MEMBER || function is IrSimpleFunction && function.isFakeOverride

    private fun callName(call: IrFunctionAccessExpression): String {
        val callee = call.symbol.owner
        val property = (callee as? IrSimpleFunction)?.correspondingPropertySymbol
        val receiver = call.arguments.firstOrNull()
        return when {
            callee is IrConstructor -> callee.parentAsClass.name.asString()
            property != null -> property.owner.name.asString()
            receiver is IrGetValue && receiver.type.isFunctionTypeOrSubtype() -> receiver.symbol.owner.name.asString()
            else -> callee.name.asString()
        }.trim('<', '>')
    }

    private fun armName(branch: IrWhen, index: Int): String = when (branch.origin) {
        IrStatementOrigin.ANDAND -> "&&"
        IrStatementOrigin.OROR -> "||"
        IrStatementOrigin.IF -> if (index == 0) "if" else "else"
        IrStatementOrigin.WHEN -> "when ${index + 1}"
        else -> "?:"
    }

    private fun token(what: String, at: IrExpression): String = tokens.next(what, at.startOffset, currentScopeOwner(), entry)

    private fun currentScopeOwner() = checkNotNull(currentScope).scope.scopeOwnerSymbol.owner as IrDeclaration

    private fun builderAt(expression: IrExpression) =
        DeclarationIrBuilder(plugin, checkNotNull(currentScope).scope.scopeOwnerSymbol, expression.startOffset, expression.endOffset)
}
