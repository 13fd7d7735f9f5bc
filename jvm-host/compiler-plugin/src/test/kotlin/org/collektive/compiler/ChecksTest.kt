package org.collektive.compiler

import org.jetbrains.kotlin.cli.common.messages.CompilerMessageSeverity
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Tests the checks. Sources mark lines where checks must report with `// NAME` or `// NAME NAME`. On other lines, no check may report. */
class ChecksTest {
    @Test
    fun `a branch that returns a field is an error`() = assertReports(
        """
        fun Aggregate<Int>.ifElse(): Field<Int, Int> = if (localId == 0) {
            evolve(0) { it }
            neighboring(localId) // FIELD_FROM_BRANCH
        } else neighboring(-localId) // FIELD_FROM_BRANCH
        fun Aggregate<Int>.assigned(): Int {
            val chosen = when (localId) {
                0 -> neighboring(localId) // FIELD_FROM_BRANCH
                1 -> if (localId > 5) neighboring(localId + 1) else neighboring(localId + 2) // FIELD_FROM_BRANCH FIELD_FROM_BRANCH
                else -> null
            }
            return chosen?.local?.value ?: 0
        }
        fun Aggregate<Int>.elvis(maybe: Field<Int, Int>?): Field<Int, Int> =
            maybe ?: neighboring(localId) // FIELD_LEAVES_BRANCH
        fun <T : Field<Int, Int>> Aggregate<Int>.generic(a: T, b: T): T = if (localId == 0) a else b // FIELD_FROM_BRANCH FIELD_FROM_BRANCH
        fun Aggregate<Int>.hidden(): Any = if (localId == 0) neighboring(localId) else 1 // FIELD_FROM_BRANCH
        fun given(a: Field<Int, Int>, b: Field<Int, Int>): Int = (if (a == b) 
            a // FIELD_FROM_BRANCH
            else
            b // FIELD_FROM_BRANCH
        ).local.value
        fun Aggregate<Int>.inLambda(): Int = run {
            val f = if (localId == 0) neighboring(localId) else neighboring(-localId) // FIELD_FROM_BRANCH FIELD_FROM_BRANCH
            f.local.value
        }
        """,
    )

    @Test
    fun `an arm that ends the function with a field is a warning`() = assertReports(
        """
        fun Aggregate<Int>.early(): Field<Int, Int> {
            if (localId == 0) return neighboring(localId) // FIELD_LEAVES_BRANCH
            when (localId) {
                1 -> { evolve(0) { it }; return neighboring(localId + 1) } // FIELD_LEAVES_BRANCH
                2 -> return neighboring(localId).also { println(it) } // FIELD_LEAVES_BRANCH
            }
            listOf(1).forEach { if (it > localId) return neighboring(localId) } // AGGREGATE_CALL_IN_LOOP FIELD_LEAVES_BRANCH
            try { if (localId > 5) return if (localId > 6) neighboring(localId) else neighboring(-localId) } finally { } // FIELD_FROM_BRANCH FIELD_FROM_BRANCH
            return neighboring(localId)
        }
        fun Aggregate<Int>.byElvis(maybe: Int?): Field<Int, Int> { maybe ?: return neighboring(localId); return neighboring(maybe) } // FIELD_LEAVES_BRANCH
        fun Aggregate<Int>.labelled(): Int = run { if (localId == 0) return@run neighboring(localId); neighborhood().mapValues { 1 } }.local.value // FIELD_LEAVES_BRANCH
        fun Aggregate<Int>.fine(): Int {
            if (localId == 0) return neighboring(localId).local.value
            if (localId == 1) { val f = run { return@run neighboring(localId) }; println(f.local) }
            if (localId == 2) { fun local(): Field<Int, Int> { return neighboring(localId) }; println(local().local) }
            return 0
        }
        fun Aggregate<Int>.inCondition(): Field<Int, Int> { if (run { return neighboring(localId) }) println(); return neighboring(localId) }
        fun notAggregate(make: () -> Field<Int, Int>, flag: Boolean): Any { if (flag) return make(); return 1 }
        """,
    )

    @Test
    fun `a branch whose field becomes the value of a lambda is an error too`() = assertReports(
        """
        fun Aggregate<Int>.ended(): Any = run { println(); if (localId == 0) neighboring(localId) else neighboring(-localId) } // FIELD_FROM_BRANCH FIELD_FROM_BRANCH
        fun Aggregate<Int>.delegated(): Int {
            val late by lazy {
                when (localId) {
                    0 -> neighboring(localId) // FIELD_FROM_BRANCH
                    else -> neighborhood().mapValues { 1 } // FIELD_FROM_BRANCH
                }
            }
            return late.local.value
        }
        fun Aggregate<Int>.kinds(maybe: Field<Int, Int>?): Any {
            val byElvis = run { maybe ?: neighboring(localId) } // FIELD_LEAVES_BRANCH
            val byTry = run { try { if (localId == 0) neighboring(localId) else null } catch (e: IllegalStateException) { when { localId > 1 -> neighboring(-localId); else -> 1 } } finally { } } // FIELD_FROM_BRANCH FIELD_FROM_BRANCH
            val inBlocks = run { if (localId == 0) { if (localId > 1) { neighboring(localId) } else { 1 } } else { null ?: run { neighboring(localId) } } } // FIELD_FROM_BRANCH USELESS_ELVIS_LEFT_IS_NULL FIELD_LEAVES_BRANCH
            val function = fun(): Any { return if (localId == 0) neighboring(localId) else 1 } // FIELD_FROM_BRANCH
            val lambda = { if (localId == 0) neighboring(localId) else 1 } // FIELD_FROM_BRANCH
            val typed: (Int) -> Any? = { if (it == 0) neighboring(localId) else null } // FIELD_FROM_BRANCH
            val named = run(block = { if (localId == 0) neighboring(localId) else 1 }) // FIELD_FROM_BRANCH
            val labelled = run here@{ return@here if (localId == 0) neighboring(localId) else 1 } // FIELD_FROM_BRANCH
            val safe = maybe?.let { if (localId == 0) it else null } // FIELD_FROM_BRANCH
            val each = listOf(1).map { alignedOn(it) { if (it == localId) neighboring(localId) else 1 } } // FIELD_FROM_BRANCH
            val deep = with("a") { let { run { if (localId == 0) neighboring(localId) else 1 } } } // FIELD_FROM_BRANCH
            run { if (localId == 0) neighboring(localId) else neighboring(-localId) }.local // FIELD_FROM_BRANCH FIELD_FROM_BRANCH
            exchange(0) { sent -> if (localId == 0) sent.mapValues { it + 1 } else sent } // FIELD_FROM_BRANCH FIELD_FROM_BRANCH
            keep { if (localId == 0) neighboring(localId) else 1 } // FIELD_FROM_BRANCH
            return listOf(byElvis, byTry, inBlocks, function, lambda, typed, named, labelled, safe, each, deep)
        }
        fun keep(make: () -> Any) { println(make()) }
        val program: Aggregate<Int>.() -> Any = { if (localId == 0) neighboring(localId) else 1 } // FIELD_FROM_BRANCH
        """,
    )

    @Test
    fun `branches that are statements of a lambda, or whose lambda's value is dropped, are fine`() = assertReports(
        """
        fun Aggregate<Int>.statements(maybe: Field<Int, Int>?): Any {
            val unit: () -> Unit = { if (localId == 0) neighboring(localId) else neighboring(-localId) }
            run<Unit> { when { localId == 0 -> neighboring(localId); else -> neighboring(-localId) } }
            run<Unit> { maybe ?: neighboring(localId) }
            run<Unit> { try { if (localId == 0) neighboring(localId) else neighboring(-localId) } finally { } }
            apply { if (localId == 0) neighboring(localId) else neighboring(-localId) }
            also { maybe ?: neighboring(localId) }
            listOf(1).forEach { if (it == localId) alignedOn(it) { neighboring(localId) } else alignedOn(-it) { neighboring(localId) } }
            val noElse = run<Any> { if (localId == 0) neighboring(localId) }
            val noElseInTry = run<Any> { try { if (localId == 0) neighboring(localId) } finally { } }
            val first = run { if (localId == 0) neighboring(localId) else neighboring(-localId); 1 }
            val inLoop = run { do { if (localId == 0) println() else null } while (localId < 0) }
            val atLast = run { try { 1 } finally { if (localId == 0) neighboring(localId) else neighboring(-localId) } }
            val values = run { if (localId == 0) neighboring(localId).local.value else 1 }
            val straight = run { neighboring(localId) }
            run { if (localId == 0) neighboring(localId) else neighboring(-localId) }
            maybe?.let { with(it) { if (localId == 0) neighboring(localId) else it } }
            if (localId == 0) run { maybe ?: neighboring(localId) } else println()
            alignedOn(1) { when (localId) { 0 -> neighboring(localId); else -> neighboring(-localId) } }
            run here@{ if (localId == 0) return@here neighboring(localId); neighboring(-localId) }
            if (localId == 0) { if (localId > 1) { neighboring(localId) } else { neighboring(-localId) } } else { maybe ?: neighboring(localId) }
            return listOf(unit, noElse, first, inLoop, atLast, values, straight)
        }
        fun Aggregate<Int>.unitBody(): Unit = run { if (localId == 0) neighboring(localId) else neighboring(-localId) }
        class Early(device: Aggregate<Int>) { init { device.run { if (localId == 0) neighboring(localId) else neighboring(-localId) } } }
        fun notAggregate(make: () -> Field<Int, Int>, flag: Boolean): Any = run { if (flag) make() else 1 }
        @CollektiveIgnore("test") fun Aggregate<Int>.ignored(): Any = run { if (localId == 0) neighboring(localId) else 1 }
        """,
    )

    @Test
    fun `a field that an arm assigns to a variable from outside is a warning`() = assertReports(
        """
        fun Aggregate<Int>.assigning(given: Field<Int, Int>): Any? {
            var f = neighboring(localId)
            if (localId == 0) { println(); f = neighboring(localId + 1) } // FIELD_LEAVES_BRANCH
            if (localId == 1) f = given else println() // FIELD_LEAVES_BRANCH
            when (localId) { 2 -> f = f.mapValues { it + 1 } } // FIELD_LEAVES_BRANCH
            val late: Field<Int, Int>
            if (localId == 3) {
                late = neighboring(localId) // FIELD_LEAVES_BRANCH
            } else {
                late = neighboring(-localId) // FIELD_LEAVES_BRANCH
            }
            var any: Any? = null
            any ?: run { any = neighboring(localId) } // FIELD_LEAVES_BRANCH
            val all = localId == 4 && given.also { any = it }.local.value > 0 // FIELD_LEAVES_BRANCH
            if (localId == 5) { fun later() { any = neighboring(localId) }; later() } // FIELD_LEAVES_BRANCH
            if (localId == 6) { var inner = given; if (localId > 7) { inner = neighboring(localId) }; println(inner.local) } // FIELD_LEAVES_BRANCH
            run { var inner = given; for (i in 1..2) if (i == localId) { inner = given.mapValues { i } }; inner.local } // FIELD_LEAVES_BRANCH
            if (localId == 8) try { any = neighboring(localId) } finally { } // FIELD_LEAVES_BRANCH
            if (localId == 9) f = if (localId > 10) neighboring(localId) else given // FIELD_FROM_BRANCH FIELD_FROM_BRANCH
            if (localId == 11) f += given // FIELD_LEAVES_BRANCH
            return listOf(f, late, any, all)
        }
        operator fun Field<Int, Int>.plus(other: Field<Int, Int>): Field<Int, Int> = alignedMapValues(other) { a, b -> a + b }
        """,
    )

    @Test
    fun `fields assigned inside their arm, or in no arm, and values assigned anywhere are allowed`() = assertReports(
        """
        fun Aggregate<Int>.assigning(given: Field<Int, Int>): Any? {
            var f = neighboring(localId)
            f = f.mapValues { it + 1 }
            run { f = neighboring(localId) }
            try { f = given } finally { }
            if (run { f = given; localId == 0 }) println()
            var n: Any? = 0
            var none: Field<Int, Int>? = f
            if (localId == 0) { n = neighboring(localId).local.value; none = null }
            if (localId == 1) {
                var inner = given
                inner = inner.mapValues { it + 1 }
                run { inner = neighboring(localId) }
                var (a, b) = given to given
                a = b
                val step: (Field<Int, Int>) -> Int = { var own = it; own = given; own.local.value }
                n = inner.local.value + a.local.value + step(b)
            }
            val set = { f = given }
            if (localId == 2) set()
            return listOf(f, n, none)
        }
        fun notAggregate(make: () -> Field<Int, Int>, flag: Boolean): Any { var f = make(); if (flag) { f = make() }; return f }
        @CollektiveIgnore("test") fun Aggregate<Int>.ignored(): Any { var f = neighboring(localId); if (localId == 0) { f = neighboring(1) }; return f }
        """,
    )

    @Test
    fun `a field that an arm assigns to a property of an outer object is a warning`() = assertReports(
        """
        class Frame { var field: Any? = null; val next: Frame get() = this }
        object Shared { var field: Any? = null }
        var global: Any? = null
        var Frame.alias: Any? get() = field; set(value) { field = value }
        fun Aggregate<Int>.assigning(given: Frame): Any? {
            val frame = Frame()
            if (localId == 0) frame.field = neighboring(localId) // FIELD_LEAVES_BRANCH
            if (localId == 1) { run { given.field = neighboring(localId) } } // FIELD_LEAVES_BRANCH
            when (localId) { 2 -> global = neighboring(localId); 3 -> Shared.field = neighboring(localId) } // FIELD_LEAVES_BRANCH FIELD_LEAVES_BRANCH
            if (localId == 4) frame.next.next.field = neighboring(localId) // FIELD_LEAVES_BRANCH
            if (localId == 5) frame.alias = neighboring(localId) // FIELD_LEAVES_BRANCH
            with(frame) { if (localId == 6) field = neighboring(localId) } // FIELD_LEAVES_BRANCH
            return frame
        }
        class Keeper(private val device: Aggregate<Int>) {
            var field: Any? = null
            fun step() { if (device.localId == 0) this.field = device.neighboring(device.localId) } // FIELD_LEAVES_BRANCH
        }
        class Made(device: Aggregate<Int>, outer: Frame) {
            val field: Any
            init { if (device.localId == 0) { field = device.neighboring(device.localId) } else { field = 1; outer.field = device.neighborhood() } }
        }
        """,
    )

    @Test
    fun `fields assigned to properties of objects of the same arm, or in no arm, are allowed`() = assertReports(
        """
        class Frame { var field: Any? = null; val next: Frame get() = this }
        var global: Any? = null
        fun frame(): Frame = Frame()
        fun Aggregate<Int>.assigning(given: Frame): Any? {
            given.field = neighboring(localId)
            global = neighboring(localId)
            if (localId == 0) {
                val inner = Frame()
                inner.field = neighboring(localId)
                inner.next.field = neighboring(localId)
                Frame().apply { field = neighboring(localId) }
                frame().field = neighboring(localId)
                given.field = 1
            }
            return given
        }
        fun notAggregate(frame: Frame, make: () -> Field<Int, Int>, flag: Boolean) { if (flag) frame.field = make() }
        """,
    )

    @Test
    fun `loops are found in all kinds of functions and expressions`() = assertReports(
        """
        import kotlin.reflect.KProperty
        fun Aggregate<Int>.helper(x: Int): Int = share(x) { it.local.value + x }
        fun <ID : Any, T> Aggregate<ID>.generic(items: List<T>): List<T> = items.onEach { neighboring<ID, Any?>(it) } // AGGREGATE_CALL_IN_LOOP
        inline fun <T> Aggregate<Int>.inlined(items: List<T>, step: Aggregate<Int>.(T) -> T): List<T> = items.map { step(it) } // AGGREGATE_CALL_IN_LOOP
        fun Aggregate<Int>.recursive(n: Int): Int { var s = 0; for (i in 0 until n) s += recursive(i); return s } // AGGREGATE_CALL_IN_LOOP
        class Group {
            fun Aggregate<Int>.member(items: List<Int>): Int = items.sumOf { helper(it) } // AGGREGATE_CALL_IN_LOOP
            companion object { fun Aggregate<Int>.inCompanion() { while (localId > 0) helper(1) } } // AGGREGATE_CALL_IN_LOOP
        }
        fun Aggregate<Int>.locals(items: List<Int>): Int {
            fun deeper(): Int {
                fun deepest(): List<Int> = items.map { helper(it) } // AGGREGATE_CALL_IN_LOOP
                return deepest().sum()
            }
            return deeper()
        }
        fun Aggregate<Int>.default(y: List<Int> = listOf(1).map { helper(it) }): Int = y.size // AGGREGATE_CALL_IN_LOOP
        object Delegate { operator fun getValue(aggregate: Aggregate<Int>, property: KProperty<*>): List<Int> = listOf(1).map { aggregate.helper(it) } } // AGGREGATE_CALL_IN_LOOP
        val Aggregate<Int>.delegated: List<Int> by Delegate
        fun Aggregate<Int>.byLazy(): Int { val all by lazy { listOf(1).map { helper(it) } }; return all.size } // AGGREGATE_CALL_IN_LOOP
        fun Aggregate<Int>.subject(): Any = when (val id = localId) {
            in 2..3 -> listOf(id).map { helper(it) } // AGGREGATE_CALL_IN_LOOP
            else -> helper(id)
        }
        fun Aggregate<Int>.elvis(items: List<Int>?): Any = items?.map { helper(it) } ?: helper(1) // AGGREGATE_CALL_IN_LOOP
        fun Aggregate<Int>.safe(items: List<Int>?, device: Aggregate<Int>?) { items?.forEach { device?.helper(it) } } // AGGREGATE_CALL_IN_LOOP
        fun Aggregate<Int>.attempt(items: List<Int>): Int =
            try { items.sumOf { helper(it) } } catch (_: IllegalStateException) { items.maxOf { helper(it) } } finally { for (i in items) helper(i) } // AGGREGATE_CALL_IN_LOOP AGGREGATE_CALL_IN_LOOP AGGREGATE_CALL_IN_LOOP
        fun Aggregate<Int>.nested(items: List<Int>): Int = run { with(items) { let { all -> all.map { also { _ -> helper(it) }.size }.sum() } } } // AGGREGATE_CALL_IN_LOOP
        context(aggregate: Aggregate<Int>) fun contextual(items: List<Int>) { for (i in items) aggregate.helper(i) } // AGGREGATE_CALL_IN_LOOP
        class Keeper(private val device: Aggregate<Int>) {
            fun all(items: List<Int>): List<Int> = items.map { device.helper(it) } // AGGREGATE_CALL_IN_LOOP
            inner class Part { fun all(items: List<Int>) { for (i in items) device.helper(i) } } // AGGREGATE_CALL_IN_LOOP
        }
        abstract class Above(protected val device: Aggregate<Int>)
        class Below(device: Aggregate<Int>) : Above(device) { fun all() { repeat(2) { device.helper(it) } } } // AGGREGATE_CALL_IN_LOOP
        interface Mixin { val device: Aggregate<Int>; fun all() { repeat(2) { device.helper(it) } } } // AGGREGATE_CALL_IN_LOOP
        val function = fun Aggregate<Int>.(items: List<Int>) { for (i in items) helper(i) } // AGGREGATE_CALL_IN_LOOP
        """,
    )

    @Test
    fun `fields from branches are found in all kinds of functions and expressions`() = assertReports(
        """
        import kotlin.reflect.KProperty
        fun <ID : Any> Aggregate<ID>.generic(flag: Boolean): Any = if (flag) neighboring<ID, Any?>(localId) else 1 // FIELD_FROM_BRANCH
        inline fun <T> Aggregate<Int>.inlined(make: () -> Field<Int, T>): Any = if (localId == 0) make() else 1 // FIELD_FROM_BRANCH
        fun Aggregate<Int>.recursive(n: Int): Field<Int, Int> = if (n > 0) recursive(n - 1) else neighboring(n) // FIELD_FROM_BRANCH FIELD_FROM_BRANCH
        class Group {
            fun given(device: Aggregate<Int>): Any = if (device.localId == 0) device.neighboring(device.localId) else 1 // FIELD_FROM_BRANCH
            companion object { fun Aggregate<Int>.inCompanion(): Any = if (localId == 0) neighboring(localId) else 1 } // FIELD_FROM_BRANCH
        }
        fun Aggregate<Int>.locals(): Int {
            fun local(): Any = if (localId == 0) neighboring(localId) else 1 // FIELD_FROM_BRANCH
            return local().hashCode()
        }
        fun Aggregate<Int>.default(x: Any = if (localId == 0) neighboring(localId) else 1): Int = x.hashCode() // FIELD_FROM_BRANCH
        object Delegate { operator fun getValue(aggregate: Aggregate<Int>, property: KProperty<*>): Any = if (aggregate.localId == 0) aggregate.neighboring(property.name) else 1 } // FIELD_FROM_BRANCH
        fun Aggregate<Int>.byLazy(): Int { val all by lazy { val f = if (localId == 0) neighboring(localId) else null; f }; return all.hashCode() } // FIELD_FROM_BRANCH
        fun Aggregate<Int>.subject(): Any = when (val id = localId) {
            0, 1 -> neighboring(id) // FIELD_FROM_BRANCH
            else -> id
        }
        fun Aggregate<Int>.elvis(items: List<Int>?): Any = items?.size ?: neighboring(localId) // FIELD_LEAVES_BRANCH
        fun Aggregate<Int>.safe(device: Aggregate<Int>?): Any? = if (localId == 0) device?.neighboring(localId) else null // FIELD_FROM_BRANCH
        fun Aggregate<Int>.attempt(): Any = if (localId == 0) try { neighboring(localId) } finally { println() } else 1 // FIELD_FROM_BRANCH
        fun Aggregate<Int>.nested(): Any = run { with("a") { let { val f: Any = if (localId == 0) neighboring(localId) else 1; f } } } // FIELD_FROM_BRANCH
        context(aggregate: Aggregate<Int>) fun contextual(): Any = if (aggregate.localId == 0) aggregate.neighboring(aggregate.localId) else 1 // FIELD_FROM_BRANCH
        val function = fun Aggregate<Int>.(): Any = if (localId == 0) neighboring(localId) else 1 // FIELD_FROM_BRANCH
        """,
    )

    @Test
    fun `branches of values and unused branches are allowed`() = assertReports(
        """
        fun Aggregate<Int>.values(): Int = if (localId == 0) neighboring(localId).local.value else 1
        fun Aggregate<Int>.unused(): Int {
            if (localId == 0) neighboring(localId) else neighboring(-localId)
            when { localId == 0 -> neighboring(localId + 1) }
            run<Unit> { if (localId > 0) neighboring(localId) else neighboring(-localId) }
            listOf(1).forEach { if (localId > 0) alignedOn(it) { neighboring(localId) } }
            try { if (localId > 0) neighboring(localId) else neighboring(-localId) } finally { }
            return 0
        }
        fun Aggregate<Int>.unusedElvis(maybe: Int?, field: Field<Int, Int>?) {
            maybe ?: neighboring(localId)
            field ?: neighboring(localId)
        }
        fun Aggregate<Int>.before(): Field<Int, Int> { val f = neighboring(localId); return f.mapValues { if (it > 0) it else 0 } }
        fun Aggregate<Int>.fallback(maybe: Int?): Int = maybe ?: neighboring(localId).local.value
        fun notAggregate(): Any? { val f: () -> Field<Int, Int>? = { null }; return f() ?: f() }
        @CollektiveIgnore("test") fun Aggregate<Int>.ignored(): Field<Int, Int> = if (localId == 0) neighboring(localId) else neighboring(-localId)
        @Suppress("FIELD_FROM_BRANCH") fun Aggregate<Int>.suppressed(): Int = 0
        """,
    )

    @Test
    fun `an aggregate call in a loop without alignedOn is a warning`() = assertReports(
        """
        fun Aggregate<Int>.helper(x: Int): Int = share(x) { it.local.value + x }
        fun Aggregate<Int>.loops(items: List<Int>) {
            for (item in items) helper(item) // AGGREGATE_CALL_IN_LOOP
            var i = 0
            while (i < 3) {
                i++
                if (i == 2) neighboring(i) // AGGREGATE_CALL_IN_LOOP
            }
            do { i += helper(i) } while (evolve(0) { it + 1 } < 3) // AGGREGATE_CALL_IN_LOOP AGGREGATE_CALL_IN_LOOP
            items.forEach { helper(it) } // AGGREGATE_CALL_IN_LOOP
            items.map { it + run { helper(it) } } // AGGREGATE_CALL_IN_LOOP
            items.asSequence().filter { helper(it) > 0 }.toList() // AGGREGATE_CALL_IN_LOOP
            mapOf(1 to 2).forEach { (_, v) -> helper(v) } // AGGREGATE_CALL_IN_LOOP
            repeat(3) { helper(it) } // AGGREGATE_CALL_IN_LOOP
            "abc".forEach { helper(it.code) } // AGGREGATE_CALL_IN_LOOP
            for (item in items) share(item) { it.local.value + neighboring(item).local.value } // AGGREGATE_CALL_IN_LOOP
            for (item in items) alignedOn("same") { items.map { helper(it) } } // AGGREGATE_CALL_IN_LOOP
        }
        val Aggregate<Int>.rounds: Int get() = evolve(0) { it + 1 }
        fun Aggregate<Int>.getters(): Int {
            var sum = 0
            while (sum + localId < 10) sum += rounds + localId // AGGREGATE_CALL_IN_LOOP
            return sum
        }
        val lambda: Aggregate<Int>.() -> Unit = { for (i in 1..2) helper(i) } // AGGREGATE_CALL_IN_LOOP
        fun Aggregate<Int>.programInLoop(items: List<Int>) {
            items.forEach { apply { helper(it) } } // AGGREGATE_CALL_IN_LOOP
        }
        fun inFunctionOfField(field: Field<Int, Int>): List<Int> = field.neighbors.list.map { field.context.helper(it.value) } // AGGREGATE_CALL_IN_LOOP
        """,
    )

    @Test
    fun `aligned iterations, loop headers and functions of a field are allowed`() = assertReports(
        """
        fun Aggregate<Int>.helper(x: Int): Int = share(x) { it.local.value + x }
        fun Aggregate<Int>.fine(items: List<Int>): Int {
            for (item in items) alignedOn(item) { helper(item) }
            items.forEach { alignedOn(it) { helper(it) + neighboring(it).local.value } }
            for (entry in neighboring(localId).neighbors.list) println(entry.value + localId)
            neighboring(localId).map { helper(it.value) }
            items.let { helper(it.size) }
            val cache = mutableMapOf<Int, Int>()
            cache.getOrPut(1) { helper(1) }
            for (item in items) { val later = object { fun go() = helper(item) }; println(later) }
            for (item in items) println(neighborhoodSize(item))
            return items.sumOf { it * 2 }
        }
        fun neighborhoodSize(x: Int): Int = x
        fun driver(devices: List<Aggregate<Int>>) = devices.map { device -> device.run { helper(1) } } + devices.map { runOn(it) { helper(2) } }
        fun runOn(device: Aggregate<Int>, program: Aggregate<Int>.() -> Int): Int = device.program()
        fun notAggregate(items: List<Int>, make: () -> Aggregate<Int>) = items.forEach { make().helper(it) }
        @CollektiveIgnore("test") fun Aggregate<Int>.ignored(items: List<Int>) { for (item in items) helper(item) }
        """,
    )

    @Test
    fun `explicit align and dealign are warnings`() = assertReports(
        """
        fun Aggregate<Int>.manual() {
            align(1) // MANUAL_ALIGNMENT
            dealign() // MANUAL_ALIGNMENT
            alignedOn(1) { localId }
        }
        class Forwarding(private val inner: Aggregate<Int>) : Aggregate<Int> by inner {
            override fun align(pivot: Any?) = inner.align(pivot)
        }
        @CollektiveIgnore("test") fun Aggregate<Int>.ignored() { align(1); dealign() }
        fun String.align(x: Int): Int = x + length
        fun Aggregate<Int>.other(): Int = "a".align(localId)
        """,
    )

    @Test
    fun `evolve that sends its old value is a warning`() = assertReports(
        """
        fun Aggregate<Int>.slow(): Int = evolve(0) { old -> neighboring(old).all.list.maxOf { it.value } } // EVOLVE_THAT_SHARES
        fun Aggregate<Int>.slowToo(): Int = evolving(0) { val f = run { neighboring(it) }; f.local.value.yielding { this + 1 } } // EVOLVE_THAT_SHARES
        fun Aggregate<Int>.throughVal(): Int = evolve(0) { old -> val mine = old; neighboring(mine).neighbors.size } // EVOLVE_THAT_SHARES
        fun Aggregate<Int>.throughTwo(): Int = evolve(0) { old -> val a = old; val b = a; val f = neighboring(b); f.neighbors.size } // EVOLVE_THAT_SHARES
        fun Aggregate<Int>.yieldingVal(): Int = evolving(0) { old -> val a = old; val f = neighboring(a); f.local.value.yielding { this + 1 } } // EVOLVE_THAT_SHARES
        fun Aggregate<Int>.fine(): Int = evolve(0) { old -> old + neighboring(localId).neighbors.size }
        fun Aggregate<Int>.other(): Int = evolve(0) { old -> neighboring(old + 1).neighbors.size }
        """,
    )

    @Test
    fun `a primitive that ignores its parameter is a warning`() = assertReports(
        """
        fun Aggregate<Int>.ignoring(): Int {
            val a = evolve(0) { localId } // IGNORED_PARAMETER
            val b = evolving(0) { _ -> localId.yielding { this + 1 } } // IGNORED_PARAMETER
            val c = share(0) { localId } // IGNORED_PARAMETER
            val d = sharing(0) { field -> localId.yielding { this + 1 } } // IGNORED_PARAMETER
            val e = exchange(0) { neighboring(localId) } // IGNORED_PARAMETER
            val f = exchanging(0) { neighboring(localId).yielding { 1 } } // IGNORED_PARAMETER
            return a + b + c + d + e.local.value + f
        }
        fun Aggregate<Int>.looking(step: (Int) -> Int): Int {
            val a = evolve(0) { run { it } } + evolve(1, step)
            val b = share(0) { field -> field.local.value }
            val c = exchange(0 to 1) { it.mapValues { (x, y) -> y to x } }.local.value.first
            val d = evolve(0 to 1) { (x, y) -> y to x }.first
            return a + b + c + d
        }
        fun evolve(x: Int, f: (Int) -> Int): Int = f(x)
        fun elsewhere(): Int = evolve(1) { 2 }
        """,
    )

    @Test
    fun `yielding the stored value is a warning`() = assertReports(
        """
        fun Aggregate<Int>.needless(): Int {
            val a = evolving(0) { old -> (old + 1).yielding { this } } // NEEDLESS_YIELDING
            val b = sharing(0) { f -> val next = f.local.value; next.yielding { next } } // NEEDLESS_YIELDING
            val c = exchanging(0) { f -> f.mapValues { it + 1 }.yielding { this } } // NEEDLESS_YIELDING
            val d = evolving(0) { old -> (old + 1).yielding { old + 1 } } // NEEDLESS_YIELDING
            val e = sharing(0) { f -> maxOf(f.local.value, 1).yielding { maxOf(f.local.value, 1) } } // NEEDLESS_YIELDING
            val g = exchanging(0) { f -> f.mapValues { it + 1 }.yielding { f.mapValues { it + 1 } } } // NEEDLESS_YIELDING
            return a + b + c.local.value + d + e + g.local.value
        }
        fun Aggregate<Int>.needed(): Int {
            val a = evolving(0) { old -> (old + 1).yielding { old } }
            val b: Int = exchanging(0) { f -> f.yielding { local.value } }
            val c: Int = sharing(0) { f -> val next = f.local.value; next.yielding { f.local.value } }
            return a + b + c
        }
        """,
    )

    @Test
    fun `sending a constant to all neighbours is a warning`() = assertReports(
        """
        fun Aggregate<Int>.constant(): Int = neighboring(1).neighbors.size + neighboring("a").neighbors.size // CONSTANT_NEIGHBORING CONSTANT_NEIGHBORING
        fun Aggregate<Int>.fine(x: Int): Int = neighboring(x).neighbors.size + neighboring(x + 1).neighbors.size + neighborhood().neighbors.size
        """,
    )

    @Test
    fun `messages are plain text`() {
        val reports = Compilation.of(
            """
            fun Aggregate<Int>.f(c: Boolean): Int {
                align(1)
                val a = evolve(0) { neighboring(it).local.value } + evolve(0) { 1 }
                for (i in 1..2) neighboring("a")
                val b: Int = evolving(0) { (it + 1).yielding { this } }
                return a + b
            }
            """,
        ).reports
        assertEquals(6, reports.map { it.name }.toSet().size, reports.toString())
        for (report in reports) assertTrue("''" !in report.text && "'{'" !in report.text && "{0}" !in report.text, report.text)
    }

    @Test
    fun `messages state the fix`() {
        val reports = Compilation.of("fun Aggregate<Int>.f() { for (i in 1..2) neighboring(i) }").reports
        assertEquals(CompilerMessageSeverity.WARNING, reports.single().severity)
        assertTrue("alignedOn(key) { ... }" in reports.single().text, reports.single().text)
        assertTrue("'neighboring'" in reports.single().text, reports.single().text)
        val branch = Compilation.of("fun Aggregate<Int>.f() = if (localId > 0) neighboring(localId) else null").reports
        assertEquals(CompilerMessageSeverity.ERROR, branch.single().severity)
    }

    @Test
    fun `checks are silent when the plugin is off`() {
        val reports = Compilation.of("fun Aggregate<Int>.f() { for (i in 1..2) neighboring(i) }", "collektiveEnabled=false").reports
        assertEquals(emptyList(), reports)
    }

    @Test
    fun `an option that is neither true nor false is refused`() {
        val reports = Compilation.of("fun f() = 1", "collektiveEnabled=maybe").reports
        assertTrue("'maybe'; it must be true or false" in reports.single().text, reports.toString())
    }

    private fun assertReports(source: String) {
        val expected = source.trimIndent().lines().flatMapIndexed { index, line ->
            line.substringAfter("// ", "").split(' ').filter { it.isNotBlank() }.map { (index + 1) to it }
        }
        val reports = Compilation.of(source).reports.filter { it.name !in COMPILERS_OWN }
        assertEquals(expected, reports.map { it.line to it.name })
    }

    private companion object {
        /** The compiler's own warnings about the style of the sources, which the tests ignore. */
        val COMPILERS_OWN = setOf("UNUSED_EXPRESSION", "UNUSED_VARIABLE", "NOTHING_TO_INLINE")
    }
}
