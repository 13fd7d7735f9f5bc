package org.collektive.compiler

import it.unibo.collektive.aggregate.AlignmentClashException
import org.collektive.alignment.readable
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

class AlignmentTest {
    @Test
    fun `consecutive calls have different paths`() = assertPaths("row", "neighboring", "neighboring", "evolve")

    @Test
    fun `a path reads as the calls that lead to it`() = assertPaths("nested", "helper > share", "helper > share")

    @Test
    fun `arguments are evaluated before their call`() = assertPaths("argument", "neighboring", "share", "helper > share")

    @Test
    fun `arguments run in the order they are written`() {
        assertEquals("ab", trace(compiled.program("order")).first)
    }

    @Test
    fun `a function called twice does not clash`() {
        assertEquals(3 to List(3) { "counter > evolve" }, trace(compiled.program("twice")))
    }

    @Test
    fun `recursion nests`() = assertPaths("recursion", "recursive > neighboring", "recursive > else > recursive > neighboring")

    @Test
    fun `generic functions`() = assertPaths("generic", "same > neighboring", "same > neighboring")

    @Test
    fun `functions generic in the Aggregate`() =
        assertPaths("genericReceiver", "bounded > neighboring", "apply > counter > evolve", "also > evolve")

    @Test
    fun `inline functions with their lambdas`() = assertPaths(
        "inlined",
        "both > first > evolve",
        "both > second > evolve",
        "both > first > evolve",
        "both > second > pair > evolve",
        "both > second > pair > evolve",
    )

    @Test
    fun `members of a class, with the Aggregate as receiver or parameter`() =
        assertPaths("members", "with > asReceiver > neighboring", "asParameter > neighboring", "asParameter > neighboring")

    @Test
    fun `getters and operators`() = assertPaths("getters", "rounds > evolve", "rounds > evolve", "plus > evolve")

    @Test
    fun `local functions that use the Aggregate of the outer one`() =
        assertPaths("locals", "local > neighboring", "outer > local > neighboring")

    @Test
    fun `default arguments`() = assertPaths("defaults", "withDefault > neighboring", "withDefault > neighboring")

    @Test
    fun `delegates`() = assertPaths("delegates", "evolve", "delegated > getValue > evolve", "delegated > getValue > evolve")

    @Test
    fun `varargs and spreads`() = assertPaths("varargs", "neighboring", "neighboring", "sum > evolve")

    @Test
    fun `function references and function values align where they are called`() =
        assertPaths("functionValues", "call > body > evolve", "call > body > counter > evolve", "step > evolve", "step > evolve")

    @Test
    fun `nested lambdas`() = assertPaths("lambdas", "run > run > evolve", "with > evolve", "share", "share > evolve")

    @Test
    fun `safe calls and not-null assertions`() = assertPaths("safeCalls", "neighboring", "neighboring")

    @Test
    fun `try, catch and finally`() = assertPaths("attempt", "failing > neighboring", "evolve", "evolve")

    @Test
    fun `string templates, comparisons and assignments`() = assertPaths("mixed", "neighboring", "evolve", "evolve", "evolve")

    @Test
    fun `constructors and initialisers`() =
        assertPaths("constructed", "Holder > neighboring", "Holder > evolve", "counter > evolve", "Inner > evolve", "Inner > evolve")

    @Test
    fun `objects that capture the Aggregate`() = assertPaths("anonymous", "work > neighboring")

    @Test
    fun `function objects of an interface`() = assertPaths("functionObjects", "work > evolve", "work > evolve")

    @Test
    fun `objects that keep the Aggregate, their inner classes, superclasses and subclasses`() = assertPaths(
        "keeping",
        "near > neighboring",
        "both > near > neighboring",
        "both > near > neighboring",
        "go > near > neighboring",
        "inherited > neighboring",
        "viaMixin > neighboring",
        "all > near > neighboring",
    )

    @Test
    fun `context parameters`() = assertPaths("contextual", "inContext > evolve", "inContext > evolve")

    @Test
    fun `functions with only a field as argument`() =
        assertPaths("onlyField", "neighboring", "spread > neighboring", "spread > neighboring")

    @Test
    fun `functions of a field are aligned on each entry`() = assertPaths("insideMap", "neighboring", "map > 0 > evolve")

    @Test
    fun `alignedOn distinguishes iterations`() =
        assertPaths("loop", "alignedOn > 1 > evolve", "alignedOn > 2 > evolve", "forEach > alignedOn > 1 > evolve")

    @Test
    fun `explicit align works as a pivot`() = assertPaths("manual", "mine > evolve", "evolve")

    @Test
    fun `a loop without alignedOn clashes, and the error names the path`() {
        val error = assertFailsWith<AlignmentClashException> { trace(compiled.program("clash")) }
        assertEquals("helper > share", error.path.toMultilineString(" > "))
    }

    @Test
    fun `calls that cannot reach a primitive are not aligned`() {
        val network = referenceNetwork(0)
        network.round(compiled.program("plain"))
        assertEquals(listOf("neighboring"), network.firstAligned.pushed.map(::readable))
    }

    @Test
    fun `members of a class that delegates to an Aggregate`() =
        assertPaths("delegating", "twice > neighboring", "twice > neighboring", "twice > neighboring", "twice > neighboring")

    @Test
    fun `implementations of Aggregate are not programs`() = assertPaths("wrapped", "neighboring")

    @Test
    fun `a package whose name starts like Kotlin's is user code`() {
        val compiled = Compilation.of(
            """
            @file:Suppress("unused") package kotlinswarm;
            class Keeper(val device: Aggregate<Int>) { fun near(): Int = device.neighboring(1).local.value }
            class Team(val keeper: Keeper) { fun all(): Int = keeper.near() }
            fun Aggregate<Int>.keeping(): Int = Team(Keeper(this)).all() + Team(Keeper(this)).all()
            """,
        )
        assertEquals(listOf("all > near > neighboring", "all > near > neighboring"), trace(compiled.program("kotlinswarm.keeping")).second)
    }

    @Test
    fun `CollektiveIgnore excludes functions, classes and properties`() {
        for (name in listOf("ignored", "ignoredMember", "ignoredGetter")) {
            assertFailsWith<AlignmentClashException>(name) { trace(compiled.program(name)) }
        }
    }

    @Test
    fun `CollektiveIgnore on a file`() {
        val ignored = Compilation.of(
            """
            @file:CollektiveIgnore("aligned by hand")
            fun Aggregate<Int>.row(): Int { neighboring(localId); neighboring(localId); return 0 }
            """,
        )
        assertFailsWith<AlignmentClashException> { trace(ignored.program("row")) }
    }

    @Test
    fun `collektiveEnabled=false turns the plugin off`() {
        val plain = Compilation.of(
            "fun Aggregate<Int>.row(): Int { neighboring(localId); neighboring(localId); return 0 }",
            "collektiveEnabled=false",
        )
        assertFailsWith<AlignmentClashException> { trace(plain.program("row")) }
    }

    private fun assertPaths(program: String, vararg paths: String) = assertEquals(paths.toList(), trace(compiled.program(program)).second)

    private companion object {
        val compiled = Compilation.of(
            """
            import kotlin.properties.ReadOnlyProperty
            import kotlin.reflect.KProperty

            fun Aggregate<Int>.row(): Int { neighboring(localId); neighboring(localId); return evolve(0) { it + 1 } }

            fun Aggregate<Int>.helper(x: Int): Int = share(x) { it.local.value + x }
            fun Aggregate<Int>.nested(): Int = helper(1) + helper(2)
            fun Aggregate<Int>.argument(): Int = helper(neighboring(localId).local.value + share(1) { it.local.value })

            fun Aggregate<Int>.join(a: String, b: String): String = evolve("") { a + b }
            fun Aggregate<Int>.order(): String {
                var text = ""
                join(b = "b".also { text += "a" }, a = "a".also { text += "b" })
                return text
            }

            fun Aggregate<Int>.counter(): Int = evolve(0) { it + 1 }
            fun Aggregate<Int>.twice(): Int = counter() + counter() + counter()

            fun Aggregate<Int>.recursive(depth: Int): Int {
                val here = neighboring(depth).local.value
                return if (depth == 0) here else here + recursive(depth - 1)
            }
            fun Aggregate<Int>.recursion(): Int = recursive(1)

            fun <ID : Any, T> Aggregate<ID>.same(value: T): T = neighboring<ID, Any?>(value).local.let { value }
            fun Aggregate<Int>.generic() = same("a") to same(1)

            fun <A : Aggregate<Int>> A.bounded(): Int = neighboring(1).local.value
            fun Aggregate<Int>.genericReceiver(): Int { bounded(); apply { counter() }; return also { it.evolve(0) { it } }.localId }

            inline fun <T> Aggregate<Int>.both(first: () -> T, second: () -> T): Pair<T, T> = first() to second()
            inline fun <T> pair(first: () -> T, second: () -> T): Pair<T, T> = first() to second()
            fun Aggregate<Int>.inlined(): Int {
                both({ evolve(0) { it } }, { evolve(0) { it } })
                both({ evolve(0) { it } }, { return pair({ evolve(0) { it } }, { evolve(0) { it } }).first })
                return 0
            }

            class Group {
                fun Aggregate<Int>.asReceiver(): Int = neighboring(1).local.value
                fun asParameter(name: String, aggregate: Aggregate<Int>): Int = aggregate.neighboring(name).local.value.length
            }
            fun Aggregate<Int>.members(): Int = with(Group()) { asReceiver() } + Group().asParameter("a", this) + Group().asParameter("b", this)

            val Aggregate<Int>.rounds: Int get() = evolve(0) { it + 1 }
            class Counted(val value: Int)
            context(aggregate: Aggregate<Int>)
            operator fun Counted.plus(other: Counted): Counted = Counted(aggregate.evolve(0) { value + other.value })
            fun Aggregate<Int>.getters(): Int = (Counted(rounds) + Counted(rounds)).value

            fun Aggregate<Int>.locals(): Int {
                fun local(): Int = neighboring(1).local.value
                fun outer(): Int = local() + 1
                fun pure(x: Int): Int = x * 2
                return pure(local()) + outer()
            }

            fun Aggregate<Int>.withDefault(x: Int = neighboring(1).local.value): Int = x
            fun Aggregate<Int>.defaults(): Int = withDefault() + withDefault(3) + withDefault()

            object Delegate { operator fun getValue(aggregate: Aggregate<Int>, property: KProperty<*>): Int = aggregate.evolve(0) { it } }
            val Aggregate<Int>.delegated: Int by Delegate
            fun Aggregate<Int>.delegates(): Int {
                val lazily by lazy { evolve(0) { it } }
                return lazily + lazily + delegated + delegated
            }

            fun Aggregate<Int>.sum(vararg fields: Field<Int, Int>): Int = evolve(0) { old -> old + fields.sumOf { it.local.value } }
            fun Aggregate<Int>.varargs(): Int = sum(neighboring(1), *arrayOf(neighboring(2)))

            fun Aggregate<Int>.call(body: Aggregate<Int>.() -> Int): Int = body()
            fun Aggregate<Int>.functionValues(): Int {
                val step = { evolve(0) { it + 1 } }
                return call(Aggregate<Int>::counter) + call { counter() } + step() + step()
            }

            fun Aggregate<Int>.lambdas(): Int {
                val a = run { run { evolve(0) { it } } }
                val b = with("x") { evolve(length) { it } }
                return a + b + share(0) { field -> field.local.value + evolve(0) { it } }
            }

            fun Aggregate<Int>.safeCalls(): Int {
                val maybe: Aggregate<Int>? = this
                val none: Aggregate<Int>? = maybe.takeIf { localId > 100 }
                return (maybe?.neighboring(1)?.local?.value ?: 0) + (none?.neighboring(1)?.local?.value ?: 0) + maybe!!.neighboring(2).local.value
            }

            fun Aggregate<Int>.failing(): Int { neighboring(1); error("no") }
            fun Aggregate<Int>.attempt(): Int =
                try { failing() } catch (e: IllegalStateException) { evolve(0) { it } } finally { evolve(1) { it } }

            fun Aggregate<Int>.mixed(): String {
                var x = 0
                x += neighboring(1).local.value
                val greater = evolve(1) { it } > x
                return "${'$'}greater ${'$'}{evolve(0) { it }}" + listOf(1, evolve(2) { it }).size
            }

            class Holder(aggregate: Aggregate<Int>) {
                val field = aggregate.neighboring(1)
                val kept: Int
                init { kept = aggregate.evolve(0) { it } }
            }
            open class Above(val x: Int)
            fun Aggregate<Int>.constructed(): Int {
                class Inner { val x = evolve(0) { it } }
                return Holder(this).kept + object : Above(counter()) {}.x + Inner().x + Inner().x
            }

            fun interface Job { fun work(): Int }
            fun Aggregate<Int>.functionObjects(): Int {
                val job = Job { evolve(0) { it } }
                return job.work() + job.work()
            }

            open class Keeper(protected val device: Aggregate<Int>) {
                fun near(): Int = device.neighboring(1).local.value
                fun both(): Int = near() + near()
                inner class Part { fun go(): Int = near() }
            }
            class Below(device: Aggregate<Int>) : Keeper(device) { fun inherited(): Int = device.neighboring(1).local.value }
            interface Mixin { val device: Aggregate<Int>; fun viaMixin(): Int = device.neighboring(1).local.value }
            class Mixed(override val device: Aggregate<Int>) : Mixin
            class Team(val keeper: Keeper) { fun all(): Int = keeper.near() }
            fun Aggregate<Int>.keeping(): Int {
                val keeper = Keeper(this)
                return keeper.near() + keeper.both() + keeper.Part().go() + Below(this).inherited() + Mixed(this).viaMixin() + Team(keeper).all()
            }

            interface Task { fun work(): Int }
            fun Aggregate<Int>.anonymous(): Int = object : Task { override fun work(): Int = neighboring(1).local.value }.work()

            context(aggregate: Aggregate<Int>)
            fun inContext(): Int = aggregate.evolve(0) { it }
            fun Aggregate<Int>.contextual(): Int = inContext() + inContext()

            fun spread(field: Field<Int, Int>): Int = field.context.neighboring(1).local.value
            fun Aggregate<Int>.onlyField(): Int { val f = neighboring(1); return spread(f) + spread(f) }

            fun Aggregate<Int>.insideMap(): Int = neighboring(1).map { evolve(0) { it + 1 } }.local.value

            @Suppress("AGGREGATE_CALL_IN_LOOP")
            fun Aggregate<Int>.loop() {
                for (key in 1..2) alignedOn(key) { evolve(0) { it } }
                listOf(1).forEach { key -> alignedOn(key) { evolve(0) { it } } }
            }

            fun Aggregate<Int>.manual(): Int {
                align("mine")
                val kept = evolve(0) { it }
                dealign()
                return kept + evolve(0) { it }
            }

            fun Aggregate<Int>.clash() { for (i in 1..2) helper(i) }

            fun Aggregate<Int>.plain(): Double {
                val field = neighboring(2.0)
                val ids = field.neighbors.list.map { it.id } + localId
                check(field == field.mapValues { it }) { "${'$'}field of ${'$'}localId" }
                val pair = Pair(field, listOf(field, field))
                for (f in pair.second) check(f == pair.first)
                val square = { x: Double -> x * x }
                fun half(x: Double) = x / 2
                if (localId > half(square(3.0))) return 0.0
                return kotlin.math.sqrt(field.local.value + ids.size + field.all.size) + field[localId]
            }

            class Wrapper(val inner: Aggregate<Int>) : Aggregate<Int> by inner {
                private var calls = 0
                private fun count() { calls++ }
                override fun align(pivot: Any?) { count(); inner.align(pivot) }
            }
            fun Aggregate<Int>.wrapped(): Int = Wrapper(this).inner.neighboring(1).local.value

            class Context(aggregate: Aggregate<Int>) : Aggregate<Int> by aggregate {
                private val plain get() = localId
                fun twice(): Int = neighboring(plain).local.value + neighboring(2).local.value
            }
            fun Aggregate<Int>.delegating(): Int { val c = Context(this); return c.twice() + c.twice() }

            @CollektiveIgnore("test") fun Aggregate<Int>.ignored() { neighboring(1); neighboring(1) }
            @CollektiveIgnore("test") class Ignored { fun Aggregate<Int>.member() { neighboring(1); neighboring(1) } }
            fun Aggregate<Int>.ignoredMember() = with(Ignored()) { member() }
            @CollektiveIgnore("test") val Aggregate<Int>.ignoredValue: Int get() = neighboring(1).local.value + neighboring(1).local.value
            fun Aggregate<Int>.ignoredGetter() = ignoredValue
            """,
        )
    }
}
