package org.collektive.compiler

import kotlin.test.Test
import kotlin.test.assertEquals

class ProjectionTest {
    @Test
    fun `in an arm, a field from outside lacks the devices of other arms`() = assertSeen("inArm", 0 to setOf(2), 1 to setOf(3))

    @Test
    fun `in alignedOn, a field from outside lacks the devices below other pivots`() =
        assertSeen("inAlignedOn", 0 to setOf(2), 1 to setOf(3))

    @Test
    fun `after align, a field from outside lacks the devices below other pivots`() = assertSeen("afterAlign", 0 to setOf(2), 1 to setOf(3))

    @Test
    fun `after dealign, the field has all devices again`() = assertSeen("afterDealign", 0 to setOf(1, 2, 3), 1 to setOf(0, 2, 3))

    @Test
    fun `outside branches, a field has all devices`() = assertSeen("outside", 0 to setOf(1, 2, 3))

    @Test
    fun `a field created in the arm is not projected`() {
        val network = referenceNetwork(0, 1)
        network.round(compiled.program("madeInside"))
        assertEquals(listOf("if > neighboring"), network.first.visited)
    }

    @Test
    fun `nested arms restrict further`() = assertSeen("nested", 0 to setOf(), 2 to setOf(), 1 to setOf(3))

    @Test
    fun `parameters and receivers are projected too`() {
        assertSeen("parameter", 0 to setOf(2), 1 to setOf(3))
        assertSeen("receiver", 0 to setOf(2), 1 to setOf(3))
    }

    @Test
    fun `a lambda in an arm reads the restricted field`() = assertSeen("lambda", 0 to setOf(2), 1 to setOf(3))

    @Test
    fun `elvis and when arms`() = assertSeen("elvis", 0 to setOf(2), 1 to setOf())

    @Test
    fun `a field is projected wherever it comes from`() {
        val programs = "property reference pair element chosenElement destructured ofDataClass hashMap delegated lazyProperty " +
            "smartCast smartCastProperty cast castProperty fromFunction fromGeneric fromLambda"
        for (program in programs.split(" ")) assertSeen(program, 0 to setOf(2), 1 to setOf(3))
        val calledInArm = "each iterated jdkLambda ownFunction callableReference functionValue lambdaFromOutside listParameter " +
            "member lazily inExtension inFunctionOfPair inFunctionOfNullable"
        for (program in calledInArm.split(" ")) assertSeen(program, 0 to setOf(2), 1 to setOf(3), plainToo = false)
    }

    @Test
    fun `functions inside a lambda read the restricted field where they are called`() {
        for (program in "functionInLambda valueInLambda classInLambda objectInLambda pairInLambda twiceInLambda".split(" ")) {
            assertSeen(program, 0 to setOf(2), 1 to setOf(3), plainToo = false)
        }
    }

    @Test
    fun `a field may be read in a loop inside an arm`() = assertSeen("loop", 0 to setOf(2), 1 to setOf(3), plainToo = false)

    @Test
    fun `the local entry is the same in every projection`() {
        val network = referenceNetwork(0, 1)
        assertEquals(mapOf<Int, Any?>(0 to 0, 1 to -1), network.round(compiled.program("localEntry")))
    }

    private fun assertSeen(program: String, vararg expected: Pair<Int, Set<Int>>, plainToo: Boolean = true) =
        assertSeen(compiled, program, expected, plainToo)

    private companion object {
        val compiled = Compilation.of(
            """
            val Aggregate<Int>.even: Boolean get() = localId % 2 == 0
            fun <T> ids(field: Field<Int, T>): Set<Int> = field.neighbors.list.map { it.id }.toSet()

            fun Aggregate<Int>.inArm(): Set<Int> { val f = neighboring(localId); return if (even) ids(f) else ids(f) }
            fun Aggregate<Int>.inAlignedOn(): Set<Int> { val f = neighboring(localId); return alignedOn(even) { ids(f) } }
            fun Aggregate<Int>.afterAlign(): Set<Int> {
                val f = neighboring(localId)
                align(even)
                val seen = ids(f)
                dealign()
                return seen
            }
            fun Aggregate<Int>.afterDealign(): Set<Int> {
                val f = neighboring(localId)
                align(even)
                dealign()
                return ids(f)
            }
            fun Aggregate<Int>.outside(): Set<Int> { val f = neighboring(localId); return run { ids(f) } }
            fun Aggregate<Int>.madeInside(): Int = if (localId >= 0) { val f = neighboring(localId); f.neighbors.size } else 0
            fun Aggregate<Int>.nested(): Set<Int> {
                val f = neighboring(localId)
                return if (even) { if (localId == 0) ids(f) else ids(f) } else ids(f)
            }
            fun Aggregate<Int>.parameter(): Set<Int> = chosen(neighboring(localId), even)
            fun chosen(f: Field<Int, Int>, even: Boolean): Set<Int> = if (even) ids(f) else ids(f)
            fun Aggregate<Int>.receiver(): Set<Int> = neighboring(localId).chosenSelf(even)
            fun Field<Int, Int>.chosenSelf(even: Boolean): Set<Int> = if (even) neighbors.list.map { it.id }.toSet() else ids(this)
            fun Aggregate<Int>.lambda(): Set<Int> {
                val f = neighboring(localId)
                return if (even) run { ids(f) } else listOf(1).flatMap { ids(f) }.toSet()
            }
            class Frame(val field: Field<Int, Int>)
            fun Aggregate<Int>.property(): Set<Int> { val f = Frame(neighboring(localId)); return if (even) ids(f.field) else ids(f.field) }
            fun Aggregate<Int>.reference(): Set<Int> {
                val f = Frame(neighboring(localId))::field
                return if (even) ids(f.get()) else ids(f())
            }
            fun Aggregate<Int>.pair(): Set<Int> { val f = neighboring(localId) to 1; return if (even) ids(f.first) else ids(f.first) }
            fun Aggregate<Int>.element(): Set<Int> { val f = listOf(neighboring(localId)); return if (even) ids(f[0]) else ids(f.first()) }
            fun Aggregate<Int>.chosenElement(): Set<Int> {
                val f = listOf(neighboring(localId))
                return if (even) ids(f.maxBy { ids(it).size }) else ids(f.first { ids(it).size < 9 })
            }
            fun Aggregate<Int>.destructured(): Set<Int> {
                val f = neighboring(localId) to 1
                return if (even) { val (g, _) = f; ids(g) } else { val (g, _) = f; ids(g) }
            }
            data class Hop(val field: Field<Int, Int>, val device: Int)
            fun Aggregate<Int>.ofDataClass(): Set<Int> {
                val hop = Hop(neighboring(localId), localId)
                return if (even) { val (f) = hop; ids(f) } else hop.let { (f, _) -> ids(f) }
            }
            fun Aggregate<Int>.hashMap(): Set<Int> {
                val fields = HashMap<Int, Field<Int, Int>>()
                val all = ArrayList<Field<Int, Int>>()
                fields[1] = neighboring(localId)
                all += fields.getValue(1)
                return if (even) ids(fields[1]!!) else ids(all[0])
            }
            fun Aggregate<Int>.delegated(): Set<Int> { val f by lazy { neighboring(localId) }; f.local; return if (even) ids(f) else ids(f) }
            class Lazily(private val device: Aggregate<Int>) { val field by lazy { device.neighboring(device.localId) } }
            fun Aggregate<Int>.lazyProperty(): Set<Int> {
                val lazily = Lazily(this)
                lazily.field.local
                return if (even) ids(lazily.field) else ids(lazily.field)
            }
            fun Aggregate<Int>.smartCast(): Set<Any> {
                val f: Any = neighboring(localId)
                if (f !is Field<*, *>) return setOf()
                return if (even) f.neighbors.list.map { it.id }.toSet() else f.neighbors.list.map { it.id }.toSet()
            }
            @Suppress("UNCHECKED_CAST")
            fun Aggregate<Int>.cast(): Set<Int> {
                val f: Any = neighboring(localId)
                return if (even) ids(f as Field<Int, Int>) else ids(f as Field<Int, Int>)
            }
            class Value(val value: Any)
            @Suppress("UNCHECKED_CAST")
            fun Aggregate<Int>.castProperty(): Set<Int> {
                val f = Value(neighboring(localId))
                return if (even) (f.value as Field<Int, Int>).neighbors.ids.set else (f.value as? Field<Int, Int>)?.neighbors?.ids?.set.orEmpty()
            }
            fun Aggregate<Int>.smartCastProperty(): Set<Any> {
                val f = Value(neighboring(localId))
                if (f.value !is Field<*, *>) return setOf()
                return if (even) f.value.neighbors.ids.set else f.value.neighbors.ids.set
            }
            fun Aggregate<Int>.each(): Set<Int> {
                val f = listOf(neighboring(localId))
                return if (even) f.flatMap { ids(it) }.toSet() else f.flatMap { g -> g.let { ids(it) } }.toSet()
            }
            fun Aggregate<Int>.iterated(): Set<Int> {
                val f = listOf(neighboring(localId))
                if (even) { for (g in f) return ids(g) } else { for (g in f) return ids(g) }
                return setOf()
            }
            fun Aggregate<Int>.jdkLambda(): Set<Int> {
                val f = hashMapOf(1 to neighboring(localId))
                val seen = HashSet<Int>()
                if (even) f.forEach { _, g -> seen += ids(g) } else f.forEach { _, g -> seen += g.neighbors.list.map { it.id } }
                return seen
            }
            fun <T> on(value: T, look: (T) -> Set<Int>): Set<Int> = look(value)
            fun Aggregate<Int>.ownFunction(): Set<Int> {
                val f = listOf(neighboring(localId))
                return if (even) on(f) { ids(it.first()) } else on(f[0]) { g -> g.neighbors.list.map { it.id }.toSet() }
            }
            fun Aggregate<Int>.callableReference(): Set<Int> {
                val f = listOf(neighboring(localId))
                return if (even) f.map(::ids).first() else on(f[0], ::ids)
            }
            fun Aggregate<Int>.functionValue(): Set<Int> {
                val f = listOf(neighboring(localId))
                val look = { g: Field<Int, Int> -> g.neighbors.list.map { it.id }.toSet() }
                return if (even) f.map(look).first() else on(f[0], look)
            }
            fun union(fields: List<Field<Int, Int>>): Set<Int> = fields.flatMap { f -> f.neighbors.list.map { it.id } }.toSet()
            fun Aggregate<Int>.listParameter(): Set<Int> {
                val f = listOf(neighboring(localId))
                return if (even) union(f) else union(f)
            }
            class Holding(fields: List<Field<Int, Int>>) {
                private val field by lazy { fields.first() }
                fun seen(): Set<Int> = field.neighbors.list.map { it.id }.toSet()
            }
            fun Frame.seen(): Set<Int> = field.neighbors.list.map { it.id }.toSet()
            fun Aggregate<Int>.member(): Set<Int> { val f = Frame(neighboring(localId)); return if (even) f.seen() else f.seen() }
            fun Aggregate<Int>.lazily(): Set<Int> {
                val f = Holding(listOf(neighboring(localId)))
                return if (even) f.seen() else f.seen()
            }
            fun Aggregate<Int>.lambdaFromOutside(): Set<Int> {
                val f = neighboring(localId)
                val look = { ids(f) }
                return if (even) look() else look()
            }
            fun Frame.seen(even: Boolean): Set<Int> = if (even) ids(field) else field.neighbors.ids.set
            fun Aggregate<Int>.inExtension(): Set<Int> = Frame(neighboring(localId)).seen(even)
            fun seen(frame: Pair<Field<Int, Int>, Boolean>): Set<Int> = if (frame.second) ids(frame.first) else frame.first.neighbors.ids.set
            fun Aggregate<Int>.inFunctionOfPair(): Set<Int> = seen(neighboring(localId) to even)
            fun seen(field: Field<Int, Int>?, even: Boolean): Set<Int> = if (even) ids(field!!) else field?.neighbors?.ids?.set.orEmpty()
            fun Aggregate<Int>.inFunctionOfNullable(): Set<Int> = seen(neighboring(localId), even)
            fun first(of: List<Field<Int, Int>>): Field<Int, Int> = of.first()
            fun Aggregate<Int>.fromFunction(): Set<Int> {
                val f = listOf(neighboring(localId))
                return if (even) ids(first(f)) else ids(first(f))
            }
            fun Aggregate<Int>.fromLambda(): Set<Int> {
                val f = neighboring(localId)
                val look = { f }
                return if (even) ids(look()) else ids(look())
            }
            class Holder<T>(private val value: T) { fun get() = value }
            fun Aggregate<Int>.fromGeneric(): Set<Int> {
                val f = Holder(neighboring(localId))
                return if (even) ids(f.get()) else ids(f.get())
            }

            fun Aggregate<Int>.functionInLambda(): Set<Int> {
                val (f, isEven) = neighboring(localId) to even
                return run {
                    fun look() = f.neighbors.ids.set
                    if (isEven) look() else look()
                }
            }
            fun Aggregate<Int>.valueInLambda(): Set<Int> {
                val (f, isEven) = neighboring(localId) to even
                return buildSet { val look = { addAll(f.neighbors.ids.set) }; if (isEven) look() else look() }
            }
            fun Aggregate<Int>.classInLambda(): Set<Int> {
                val (f, isEven) = neighboring(localId) to even
                return run {
                    class Look { fun look() = f.neighbors.ids.set }
                    val own = Look()
                    if (isEven) own.look() else own.look()
                }
            }
            fun Aggregate<Int>.objectInLambda(): Set<Int> {
                val (f, isEven) = neighboring(localId) to even
                return object {
                    fun look() = f.neighbors.ids.set
                    fun go() = if (isEven) look() else look()
                }.go()
            }
            fun Aggregate<Int>.pairInLambda(): Set<Int> {
                val (f, isEven) = (neighboring(localId) to 1) to even
                return run {
                    fun look() = f.first.neighbors.ids.set
                    if (isEven) look() else look()
                }
            }
            fun Aggregate<Int>.twiceInLambda(): Set<Int> {
                val (f, isEven) = neighboring(localId) to even
                return run {
                    fun look(now: Boolean): Set<Int> = if (now) f.neighbors.ids.set else setOf()
                    look(!isEven) + look(isEven)
                }
            }

            fun Aggregate<Int>.elvis(): Set<Int> {
                val f = neighboring(localId)
                return setOf<Int>().takeIf { !even } ?: ids(f)
            }
            fun Aggregate<Int>.loop(): Set<Int> {
                val f = neighboring(localId)
                var all = setOf<Int>()
                if (even) for (i in 1..3) all = all + ids(f) else for (i in 1..3) all += f.neighbors.list.map { it.id }
                return all
            }
            fun Aggregate<Int>.localEntry(): Int {
                val f = neighboring(localId)
                return if (even) f.local.value else -f.local.value
            }
            """,
        )
    }
}
