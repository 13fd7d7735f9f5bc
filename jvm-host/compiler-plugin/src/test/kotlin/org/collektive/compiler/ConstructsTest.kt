package org.collektive.compiler

import org.collektive.testkit.Network
import org.collektive.testkit.ReferenceDevices
import kotlin.test.Test
import kotlin.test.assertEquals

/** Tests that unusual Kotlin constructs compile to valid code, which computes the same results with and without the plugin. */
class ConstructsTest {
    @Test
    fun `all constructs give the same results with and without the plugin`() {
        val names = Regex("fun Aggregate<Int>\\.(p\\d+)\\(").findAll(SOURCE).map { it.groupValues[1] }.toList()
        val plugin = Compilation.of(SOURCE)
        val plain = Compilation.of(SOURCE, "collektiveEnabled=false")
        for (name in names) {
            val aligned = referenceNetwork(0).round(plugin.program(name))
            val manual = Network(ReferenceDevices(ignoresClashes = true), 0).round(plain.program(name))
            assertEquals(manual, aligned, name)
        }
        assertEquals(NUMBER, names.size)
    }

    private companion object {
        const val NUMBER = 34

        val SOURCE = """
            import kotlin.contracts.*
            import kotlin.reflect.KProperty

            fun Aggregate<Int>.one(): Int = neighboring(localId + 1).local.value
            fun Aggregate<Int>.add(a: Int, b: Int): Int = neighboring(a + b).local.value

            inline fun <reified T> Aggregate<Int>.named(x: T): String = neighboring(x).local.value.toString() + T::class.simpleName
            fun Aggregate<Int>.p1(): Any? = named(1) + named("a")

            inline fun <T> Aggregate<Int>.crossing(crossinline a: () -> T, noinline b: () -> T): List<T> = listOf({ a() }(), b())
            fun Aggregate<Int>.p2(): Any? = crossing({ one() }, { one() })

            fun Aggregate<Int>.p3(): Any? = sequence { yield(one()); yieldAll(listOf(one(), 3)) }.toList()

            sealed interface Shape { class Circle(val r: Int) : Shape; data object Dot : Shape }
            fun Aggregate<Int>.p4(): Any? = listOf(Shape.Circle(2), Shape.Circle(9), Shape.Dot).map { shape: Shape ->
                alignedOn(shape) {
                    when (shape) {
                        is Shape.Circle if shape.r > 5 -> add(shape.r, one())
                        is Shape.Circle -> add(shape.r, 1)
                        Shape.Dot -> one()
                    }
                }
            }

            fun Aggregate<Int>.never(): Nothing { one(); error("never") }
            fun Aggregate<Int>.p5(): Any? { val x: Int? = localId; val y = x ?: never(); return y + (x ?: return one()) }

            fun Aggregate<Int>.p6(): Any? {
                val x: Int
                run { x = one() }
                val y: Int
                if (x > 0) { y = one() } else { y = 7 }
                return x + y
            }

            tailrec fun Aggregate<Int>.down(n: Int, sum: Int): Int = if (n == 0) sum else down(n - 1, sum + one())
            fun Aggregate<Int>.p7(): Any? = down(5, 0)

            abstract class Base { open fun Aggregate<Int>.work(x: Int = one()): Int = x; abstract fun Aggregate<Int>.todo(): Int }
            class Derived : Base() {
                override fun Aggregate<Int>.work(x: Int): Int = x + one()
                override fun Aggregate<Int>.todo(): Int = work() + one()
                fun viaSuper(aggregate: Aggregate<Int>): Int = with(aggregate) { todo() }
            }
            fun Aggregate<Int>.p8(): Any? = Derived().viaSuper(this)

            interface Rule { fun apply(aggregate: Aggregate<Int>): Int = aggregate.one() }
            class Twice(private val rule: Rule) : Rule by rule { override fun apply(aggregate: Aggregate<Int>) = rule.apply(aggregate) + rule.apply(aggregate) }
            fun Aggregate<Int>.p9(): Any? = Twice(object : Rule {}).apply(this)

            @JvmInline value class Meters(val value: Int)
            operator fun Meters.plus(o: Meters) = Meters(value + o.value)
            fun Aggregate<Int>.meters(m: Meters): Meters = Meters(neighboring(m.value).local.value)
            fun Aggregate<Int>.p10(): Any? = (meters(Meters(1)) + meters(Meters(one()))).value

            class Callable(val x: Int) { operator fun invoke(aggregate: Aggregate<Int>, y: Int): Int = aggregate.add(x, y) }
            infix fun Aggregate<Int>.plusOne(x: Int): Int = add(x, 1)
            fun Aggregate<Int>.p11(): Any? { val call = Callable(1); return call(this, 2) + (this plusOne 3) }

            val Aggregate<Int>.rounds: Int get() = one()
            fun Aggregate<Int>.p12(): Any? { val r = Aggregate<Int>::rounds; return r.get(this) + r(this) + this::rounds.get() }

            enum class Kind { A { override fun run(a: Aggregate<Int>) = a.one() }, B { override fun run(a: Aggregate<Int>) = 2 }; abstract fun run(a: Aggregate<Int>): Int }
            fun Aggregate<Int>.p13(): Any? = Kind.entries.map { alignedOn(it) { it.run(this) } }

            fun Aggregate<Int>.p14(): Any? {
                class Local(val x: Int) { fun go() = add(x, one()) }
                val l = Local(one())
                return l.go() + l.go()
            }

            class Sec(val v: Int) { constructor(a: Aggregate<Int>) : this(a.one() + a.localId) }
            fun Aggregate<Int>.p15(): Any? = Sec(this).v

            open class Up(val v: Int)
            class Down(a: Aggregate<Int>, b: Int = a.localId) : Up(a.one() + b) { val w = a.one() + v }
            fun Aggregate<Int>.p16(): Any? = Down(this).w

            fun Aggregate<Int>.p31(): Any? = object : Up(one() + listOf(one(), 2).size) { val w = one() + v }.w
            class Chained(a: Aggregate<Int>, val x: Int = if (a.localId == 0) a.one() else 3) : Up(if (x > 0) a.one() + x else a.add(1, 2)) {
                constructor(a: Aggregate<Int>, y: String) : this(a, try { a.one() + y.toInt() } catch (_: NumberFormatException) { a.one() })
            }
            fun Aggregate<Int>.p32(): Any? = Chained(this, "a").v + Chained(this).x + Chained(this, "7").v

            operator fun Field<Int, Int>.iterator(): Iterator<Int> = all.list.map { it.value }.iterator()
            operator fun Aggregate<Int>.rangeTo(end: Int): IntRange = one()..end
            fun Aggregate<Int>.p33(): Any? {
                var sum = 0
                val fields = listOf(neighboring(localId + 1), neighboring(localId + 2))
                for (field in fields) sum += field.local.value
                for ((i, field) in fields.withIndex()) sum += i * field.local.value
                for (field in arrayOf(fields[0], fields[1])) for (value in field) sum += value
                for (i in this..5) sum += i
                for (i in one() until add(3, 4) step one()) sum += i
                for (i in fields.indices.reversed()) sum += i
                return sum + if (this in listOf(this) && one() in 0..9) 1 else 0
            }
            fun Aggregate<Int>.p34(): Any? {
                val jobs = listOf({ one() }, { add(1, 2) })
                val pair = Pair(this, { x: Int -> x + one() })
                return jobs.mapIndexed { i, job -> alignedOn(i) { job() } } + pair.second(1) + pair.first.one() + maxOf(one(), add(2, 2))
            }

            fun Aggregate<Int>.p17(): Any? = "${'$'}{one()} ${'$'}{if (localId == 0) "${'$'}{one()}" else ""} ${'$'}{try { one() } finally { one() }}"

            fun Aggregate<Int>.p18(): Any? {
                var sum = 0
                outer@ for (i in 0 until 4) {
                    for (j in 0..i) {
                        if (j == 2) { alignedOn(i to j) { sum += one() }; continue@outer }
                        sum += if (i == 3) { alignedOn(i to j) { one() }; break@outer } else alignedOn(i to j) { add(i, j) }
                    }
                }
                return sum
            }

            fun Aggregate<Int>.p19(): Any? { var x = 1; x += one(); x++; val a = intArrayOf(1, 2); a[one() - 1] += one(); return a.toList() + x }

            fun Aggregate<Int>.p20(): Any? { val (a, b) = one() to add(1, 2); return a * b }

            fun Aggregate<Int>.p21(): Any? = try { one(); if (localId == 0) throw IllegalStateException("x") else one() }
                catch (e: IllegalStateException) { one() } finally { one() }

            fun Aggregate<Int>.early(x: Int): Int { try { if (x > 0) return one() } finally { one() }; return 5 }
            fun Aggregate<Int>.p22(): Any? = early(1) + early(0)

            fun <T : Comparable<T>> Aggregate<Int>.best(vararg xs: T, by: (T, T) -> T = { a, b -> if (a > b) a else b }): T {
                val best = xs.reduce(by)
                return best.also { neighboring(best.hashCode()) }
            }
            fun Aggregate<Int>.p23(): Any? = best(1, one(), 3) + best(*arrayOf(4, 5), by = ::minOf)

            fun Aggregate<Int>.p24(): Any? = buildList { add(one()); for (x in 1..2) this@p24.alignedOn(x) { add(one() + x) } }

            fun Aggregate<Int>.p25(): Any? = when (val f = neighboring(localId)) { else -> f.all.list.size + one() }

            fun Aggregate<Int>.p26(): Any? { val f: Field<Int, Int>? = neighboring(localId).takeIf { localId == 0 }; return f?.mapValues { it + 1 }?.local?.value ?: one() }

            @OptIn(ExperimentalContracts::class)
            inline fun <R> Aggregate<Int>.once(block: Aggregate<Int>.() -> R): R {
                contract { callsInPlace(block, InvocationKind.EXACTLY_ONCE) }
                return block()
            }
            fun Aggregate<Int>.p27(): Any? { val x: Int; once { x = one() }; return x + once { one() } }

            typealias Program<R> = Aggregate<Int>.() -> R
            val stored: Program<Int> = { one() + one() }
            fun Aggregate<Int>.p28(): Any? = stored() + stored(this) + run(stored)

            fun Aggregate<Int>.p29(): Any? = sharing(1) { f -> (f.local.value + 1).yielding { "kept ${'$'}this" } } + exchange(2) { it.mapValues { v -> v * 2 } }.local.value

            fun Aggregate<Int>.p30(): Any? = listOf(3, 1, 2).sortedWith(compareBy { it }).fold(one()) { acc, x -> acc * 2 + x }
        """
    }
}
