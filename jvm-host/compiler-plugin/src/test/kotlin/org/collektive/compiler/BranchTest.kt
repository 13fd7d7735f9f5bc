package org.collektive.compiler

import kotlin.test.Test
import kotlin.test.assertEquals

class BranchTest {
    @Test
    fun `devices in different arms of an if do not see each other`() = assertSeen("ifElse", 0 to setOf(2), 1 to setOf(3))

    @Test
    fun `arms of a when with a subject`() = assertSeen("whenSubject", 0 to setOf(), 1 to setOf(), 2 to setOf(3), 3 to setOf(2))

    @Test
    fun `arms of a when without a subject`() = assertSeen("whenPlain", 0 to setOf(), 1 to setOf(2, 3))

    @Test
    fun `the right sides of elvis, and, or`() {
        assertSeen("elvis", 0 to setOf(2), 1 to setOf())
        assertSeen("and", 0 to setOf(2), 1 to setOf())
        assertSeen("or", 0 to setOf(2), 1 to setOf())
    }

    @Test
    fun `conditions are not part of an arm`() = assertSeen("condition", 0 to setOf(1, 2, 3), 1 to setOf(0, 2, 3))

    @Test
    fun `a lambda called in both arms does not align across them`() = assertSeen("lambdaInArms", 0 to setOf(2), 1 to setOf(3))

    @Test
    fun `a function parameter called in both arms does not align across them`() =
        assertSeen("parameterInArms", 0 to setOf(2), 1 to setOf(3))

    @Test
    fun `different lambdas from outside aggregate functions do not align where they are called`() {
        val stored = listOf("storedLambda", "storedObject", "storedFieldLambda", "storedProperty", "storedEffect")
        for (program in stored + listOf("earlyReturnOfLambda", "table", "enum", "factory")) {
            assertSeen(program, 0 to setOf(2), 1 to setOf(3))
        }
    }

    @Test
    fun `the same lambda from outside aggregate functions aligns where it is called`() {
        assertSeen("sameLambda", 0 to setOf(1, 2, 3))
        assertSeen("nonLocalReturn", 0 to setOf(1, 2, 3))
    }

    @Test
    fun `a lambda from outside aggregate functions is in the path`() = assertEquals(
        listOf("invoke > lambda > neighboring", "seen > neighboring"),
        trace(compiled.program("lambdaThenCall")).second,
    )

    @Test
    fun `a local function called in both arms does not align across them`() = assertSeen("functionInArms", 0 to setOf(2), 1 to setOf(3))

    @Test
    fun `a function of an object that keeps the Aggregate does not align across the arms`() {
        assertSeen("keeperInArms", 0 to setOf(2), 1 to setOf(3))
        assertSeen("keeperOfKeeperInArms", 0 to setOf(2), 1 to setOf(3))
    }

    @Test
    fun `functions and objects that refer to each other do not align across the arms`() {
        assertSeen("cycleInArms", 0 to setOf(2), 1 to setOf(3))
        assertSeen("keeperOfCycleInArms", 0 to setOf(2), 1 to setOf(3))
    }

    @Test
    fun `functions that receive the Aggregate inside another object do not align across their arms`() {
        for (program in "ofContext ofContextInArms ofLateinit ofComputed ofDeepContext ofCast ofList ofInitializer".split(" ")) {
            assertSeen(program, 0 to setOf(2), 1 to setOf(3))
        }
    }

    @Test
    fun `objects whose type hides an Aggregate, a field or a function do not align across the arms`() {
        for (program in "ofInterface ofInterfaceWithField ofSealedClass inArmsOfOwner ofFunction ofFunctionList".split(" ")) {
            assertSeen(compiled, program, arrayOf(0 to setOf(2), 1 to setOf(3)), plainToo = false)
        }
    }

    @Test
    fun `branches of pure code may suspend for ever`() = assertSeen("pureSequence", 0 to setOf(1, 2, 3), 1 to setOf(0, 2, 3))

    @Test
    fun `an arm that only returns does not affect devices that continue`() = assertSeen("earlyReturn", 1 to setOf(3), 3 to setOf(1))

    @Test
    fun `nested arms`() = assertSeen("nested", 0 to setOf(), 2 to setOf(), 1 to setOf(3))

    @Test
    fun `arms have names in the path`() {
        assertEquals(listOf("if > neighboring"), trace(compiled.program("ifElse")).second)
        assertEquals(listOf("when 1 > neighboring"), trace(compiled.program("whenSubject")).second)
        assertEquals(listOf("?: > neighboring"), trace(compiled.program("elvis")).second)
        assertEquals(listOf("&& > neighboring"), trace(compiled.program("and")).second)
        assertEquals(listOf("|| > neighboring"), trace(compiled.program("or")).second)
    }

    private fun assertSeen(program: String, vararg expected: Pair<Int, Set<Int>>) = assertSeen(compiled, program, expected)

    private companion object {
        val compiled = Compilation.of(
            """
            val Aggregate<Int>.even: Boolean get() = localId % 2 == 0
            fun Aggregate<Int>.seen(): Set<Int> = ids(neighboring(localId))
            fun ids(field: Field<Int, Int>): Set<Int> = field.neighbors.list.map { it.id }.toSet()

            fun Aggregate<Int>.ifElse(): Set<Int> = if (even) ids(neighboring(0)) else ids(neighboring(0))

            fun Aggregate<Int>.whenSubject(): Set<Int> = when (localId) {
                0 -> ids(neighboring(0))
                1 -> seen()
                else -> seen()
            }

            fun Aggregate<Int>.whenPlain(): Set<Int> = when {
                localId > 0 -> seen()
                else -> seen()
            }

            interface Looking { fun look(): Set<Int> }
            fun Aggregate<Int>.ofInterface(): Set<Int> {
                val looking: Looking = object : Looking { override fun look() = seen() }
                return if (even) looking.look() else looking.look()
            }
            fun Aggregate<Int>.ofInterfaceWithField(): Set<Int> {
                val f = neighboring(localId)
                val looking: Looking = object : Looking { override fun look() = ids(f) }
                return if (even) looking.look() else looking.look()
            }
            sealed class Behaviour { abstract fun act(): Set<Int> }
            object Waiting : Behaviour() { override fun act() = setOf<Int>() }
            class Acting(val device: Aggregate<Int>) : Behaviour() { override fun act() = device.seen() }
            fun Aggregate<Int>.ofSealedClass(): Set<Int> {
                val behaviour = listOf(Acting(this), Waiting).first()
                return if (even) behaviour.act() else behaviour.act()
            }
            class Owner(private val looking: Looking) { fun look(even: Boolean) = if (even) looking.look() else looking.look() }
            fun Aggregate<Int>.inArmsOfOwner(): Set<Int> = Owner(object : Looking { override fun look() = seen() }).look(even)
            class Job(private val work: () -> Set<Int>) { fun go() = work() }
            fun Aggregate<Int>.ofFunction(): Set<Int> { val job = Job { seen() }; return if (even) job.go() else job.go() }
            fun firstOf(works: List<() -> Set<Int>>) = works.first()()
            fun Aggregate<Int>.ofFunctionList(): Set<Int> {
                val works = listOf({ seen() })
                return if (even) firstOf(works) else firstOf(works)
            }

            fun Aggregate<Int>.elvis(): Set<Int> = nothingFor(!even) ?: ids(neighboring(0))
            fun nothingFor(odd: Boolean): Set<Int>? = if (odd) setOf() else null

            fun Aggregate<Int>.and(): Set<Int> {
                var result = setOf<Int>()
                val unused = even && ids(neighboring(0)).also { result = it }.isEmpty()
                return result
            }

            fun Aggregate<Int>.or(): Set<Int> {
                var result = setOf<Int>()
                val unused = !even || ids(neighboring(0)).also { result = it }.isEmpty()
                return result
            }

            fun Aggregate<Int>.condition(): Set<Int> {
                val seen: Set<Int>
                if (seen().also { seen = it }.size > 1 && even) evolve(0) { it } else evolve(1) { it }
                return seen
            }

            fun Aggregate<Int>.lambdaInArms(): Set<Int> {
                val look = { seen() }
                return if (even) look() else look()
            }

            fun Aggregate<Int>.parameterInArms(): Set<Int> = chosen { seen() }
            fun Aggregate<Int>.chosen(look: () -> Set<Int>): Set<Int> = if (even) look() else look()

            fun Aggregate<Int>.functionInArms(): Set<Int> {
                fun look() = seen()
                return if (even) look() else look()
            }

            val looks = listOf<Aggregate<Int>.() -> Set<Int>>({ ids(neighboring(0)) }, { ids(neighboring(1)) })
            fun Aggregate<Int>.storedLambda(): Set<Int> = looks[localId % 2](this)

            fun interface Look { fun of(device: Aggregate<Int>): Set<Int> }
            val lookers = listOf(Look { ids(it.neighboring(0)) }, Look { ids(it.neighboring(1)) })
            fun Aggregate<Int>.storedObject(): Set<Int> = lookers[localId % 2].of(this)

            val ofField = listOf<(Field<Int, Int>) -> Set<Int>>({ ids(it.context.neighboring(0)) }, { ids(it.context.neighboring(1)) })
            fun Aggregate<Int>.storedFieldLambda(): Set<Int> = neighboring(0).let { ofField[localId % 2](it) }

            class Strategy(val look: Aggregate<Int>.() -> Set<Int>)
            val strategy = Strategy { seen() }
            val otherStrategy = Strategy { seen() }
            fun Aggregate<Int>.storedProperty(): Set<Int> = listOf(strategy, otherStrategy)[localId % 2].look(this)

            val returning = listOf<Aggregate<Int>.() -> Set<Int>>(
                { if (localId < 0) return@listOf setOf<Int>(); ids(neighboring(0)) },
                { if (localId > 0) return@listOf ids(neighboring(0)); seen() },
            )
            fun Aggregate<Int>.earlyReturnOfLambda(): Set<Int> = returning[localId % 2](this)

            val effects = listOf<Aggregate<Int>.(MutableSet<Int>) -> Unit>(
                { it += seen() },
                { if (localId > 0) it += seen() },
                { seen(); error("") },
            )
            fun Aggregate<Int>.storedEffect(): Set<Int> = mutableSetOf<Int>().also { effects[localId % 2](this, it) }

            fun nonLocal(device: Any): Set<Int> { with(device as Aggregate<Int>) { return seen() } }
            fun Aggregate<Int>.nonLocalReturn(): Set<Int> = nonLocal(this)

            fun Aggregate<Int>.sameLambda(): Set<Int> = listOf(looks[0], looks[0])[localId % 2](this)
            fun Aggregate<Int>.lambdaThenCall(): Set<Int> = looks[0](this) + seen()

            class Keeper(private val device: Aggregate<Int>) { fun look(): Set<Int> = device.seen() }
            fun Aggregate<Int>.keeperInArms(): Set<Int> { val keeper = Keeper(this); return if (even) keeper.look() else keeper.look() }
            class Team(private val keeper: Keeper) { fun look(): Set<Int> = keeper.look() }
            fun Aggregate<Int>.keeperOfKeeperInArms(): Set<Int> { val team = Team(Keeper(this)); return if (even) team.look() else team.look() }

            fun Aggregate<Int>.cycleInArms(): Set<Int> {
                class Walk {
                    fun start() = there(1)
                    fun there(n: Int): Set<Int> = if (n > 0) back(n - 1) else seen()
                    fun back(n: Int): Set<Int> = there(n)
                }
                val walk = Walk()
                return if (even) walk.back(0) else walk.back(0)
            }

            class Node(val parent: Node2, val keeper: Keeper)
            class Node2 { lateinit var child: Node }
            fun size(node: Node): Int = node.keeper.look().size
            fun look(node: Node2): Set<Int> = node.child.keeper.look()
            fun Aggregate<Int>.keeperOfCycleInArms(): Set<Int> {
                val child = node(this)
                size(child)
                return if (even) look(child.parent) else look(child.parent)
            }
            fun node(device: Aggregate<Int>) = Node2().let { parent -> Node(parent, Keeper(device)).also { parent.child = it } }

            class Context(val device: Aggregate<Int>, val even: Boolean)
            fun Context.near(): Set<Int> = device.seen()
            fun Context.look(): Set<Int> = if (even) device.seen() else device.seen()
            fun lookAgain(context: Context): Set<Int> = if (context.even) context.near() else context.near()
            fun Aggregate<Int>.ofContext(): Set<Int> = Context(this, even).look()
            fun Aggregate<Int>.ofContextInArms(): Set<Int> = lookAgain(Context(this, even))
            class Late { lateinit var device: Aggregate<Int>; fun look(even: Boolean) = if (even) device.seen() else device.seen() }
            fun Aggregate<Int>.ofLateinit(): Set<Int> = Late().also { it.device = this }.look(even)
            class Computed(private val of: () -> Aggregate<Int>) { val device get() = of(); fun look(even: Boolean) = if (even) device.seen() else device.seen() }
            fun Aggregate<Int>.ofComputed(): Set<Int> = Computed { this }.look(even)
            class Deep(val context: Context) { fun look() = if (context.even) context.device.seen() else context.device.seen() }
            fun Aggregate<Int>.ofDeepContext(): Set<Int> = Deep(Context(this, even)).look()
            fun look(device: Any, even: Boolean) = if (even) (device as Aggregate<Int>).seen() else (device as Aggregate<Int>).seen()
            fun Aggregate<Int>.ofCast(): Set<Int> = look(this, even)
            fun look(devices: List<Aggregate<Int>>, even: Boolean) = if (even) devices[0].seen() else devices[0].seen()
            fun Aggregate<Int>.ofList(): Set<Int> = look(listOf(this), even)
            class Initialized(context: Context) { val seen = if (context.even) context.device.seen() else context.device.seen() }
            fun Aggregate<Int>.ofInitializer(): Set<Int> = Initialized(Context(this, even)).seen

            sealed interface Tree { val value: Int }
            class Leaf(override val value: Int) : Tree
            class Twig(val leaf: Tree) : Tree { override val value get() = leaf.value }
            fun Tree.values(): Sequence<Int> = sequence { if (this@values is Twig) yieldAll(leaf.values()) else yield(value) }
            fun Aggregate<Int>.pureSequence(): Set<Int> { (if (even) Leaf(1) else Twig(Leaf(1))).values().first(); return seen() }

            val table: Map<Boolean, Aggregate<Int>.() -> Set<Int>> = mapOf(true to { seen() }, false to { seen() })
            fun Aggregate<Int>.table(): Set<Int> = table.getValue(even)(this)

            enum class Mode(val run: (Aggregate<Int>) -> Set<Int>) { EVEN({ it.seen() }), ODD({ it.seen() }) }
            fun Aggregate<Int>.enum(): Set<Int> = (if (even) Mode.EVEN else Mode.ODD).run(this)

            fun first(): Aggregate<Int>.() -> Set<Int> = { seen() }
            fun second(): Aggregate<Int>.() -> Set<Int> = { seen() }
            fun Aggregate<Int>.factory(): Set<Int> = (if (even) first() else second())(this)

            fun Aggregate<Int>.earlyReturn(): Set<Int> {
                if (even) return setOf()
                return seen()
            }

            fun Aggregate<Int>.nested(): Set<Int> = if (even) { if (localId == 0) seen() else seen() } else seen()
            """,
        )
    }
}
