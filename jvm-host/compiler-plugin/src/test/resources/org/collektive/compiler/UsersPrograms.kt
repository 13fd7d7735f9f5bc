// Programs in the styles of different users. The comment before each shows the answers in round 12 of four devices in a line.
import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.*
import it.unibo.collektive.stdlib.spreading.*
import it.unibo.collektive.stdlib.accumulation.*
import it.unibo.collektive.stdlib.consensus.*
import it.unibo.collektive.stdlib.collapse.*
import it.unibo.collektive.stdlib.util.*
import it.unibo.collektive.stdlib.ints.FieldedInts.plus
import kotlinx.serialization.Serializable
import kotlin.properties.ReadOnlyProperty
import kotlin.reflect.KProperty

fun <ID : Any> Aggregate<ID>.hopsTo(source: Boolean, limit: Int = 99): Int =
    share(limit) { seen ->
        // Inside an arm, `seen` lacks the sources, which take the other arm.
        val next = 1 + (seen.neighbors.values.list.minOrNull() ?: limit)
        if (source) 0 else minOf(limit, next)
    }
// = [(0, 2), (1, 2), (2, 1), (3, 0)]
fun Aggregate<Int>.genericFunctions() = hopsTo(localId == 0) to hopsTo(localId == 3, limit = 2)

fun <ID : Any, T : Comparable<T>> Field<ID, T>.best(): T = all.values.list.max()
// = [(10, 1), (20, 2), (30, 3), (30, 3)]
fun Aggregate<Int>.extensionsOfFields() = neighboring(localId * 10).best() to mapNeighborhood { it }.best()

inline fun <T> Aggregate<Int>.after(n: Int, crossinline action: () -> T): T? {
    val round = evolve(0) { it + 1 }
    return if (round >= n) object : () -> T { override fun invoke() = action() }() else null
}
// = [([1], [1]), ([0, 2], [0, 2]), ([1, 3], [1, 3]), ([2], [2])]
fun Aggregate<Int>.crossinlineLambdas() = after(2) { neighboring(localId).neighbors.ids.list } to after(7) { neighboring(localId).neighbors.ids.list }

fun Aggregate<Int>.weighed(metric: Field<Int, Int> = hops(), rounds: Int = evolve(0) { it + 1 }, by: (Int) -> Int = { it * rounds }): Int =
    metric.all.values.sum() + by(rounds)
// = [[145, 2, 13], [146, 3, 14], [146, 3, 14], [145, 2, 13]]
fun Aggregate<Int>.defaultArguments() = listOf(weighed(), weighed(rounds = 1), weighed { it })

class Kept<T>(private val aggregate: Aggregate<Int>, private val first: T, private val step: (T) -> T) : ReadOnlyProperty<Any?, T> {
    override fun getValue(thisRef: Any?, property: KProperty<*>): T = aggregate.evolve(first, step)
}
// = [[12, xxxxxxxxxxxx, [1]], [12, xxxxxxxxxxxx, [0, 2]], [12, xxxxxxxxxxxx, [1, 3]], [12, xxxxxxxxxxxx, [2]]]
fun Aggregate<Int>.delegates(): Any? {
    val a by Kept(this, 0) { it + 1 }
    val b by Kept(this, "") { it + "x" }
    val c by lazy { neighboring(localId).neighbors.ids.list }
    return listOf(a, b, c)
}

@Serializable sealed interface Role {
    @Serializable data class Leader(val strength: Int) : Role
    @Serializable data class Follower(val of: Int, val hops: Int) : Role
    @Serializable data object Idle : Role
}
fun Aggregate<Int>.role(): Role = share<Int, Role>(Role.Idle) { seen ->
    val near = seen.neighbors.list.firstNotNullOfOrNull { (id, role) -> (role as? Role.Leader)?.let { Role.Follower(id, 1) } }
    when {
        localId == 1 -> Role.Leader(5)
        else -> near ?: Role.Idle
    }
}
// = [follower with 0, leader of 0, follower with 0, idle]
fun Aggregate<Int>.sealedClassesAndGuards(): Any? = when (val role = role()) {
    is Role.Leader if role.strength > 9 -> "never"
    is Role.Leader -> "leader of " + neighboring(localId).neighbors.size
    is Role.Follower -> "follower with " + neighborhood().neighbors.size
    Role.Idle -> "idle"
}

class Sensors(val temperature: Int)
context(aggregate: Aggregate<Int>, sensors: Sensors)
fun hottest(): Int = aggregate.gossipMax(sensors.temperature)
// = [9, 9, 9, 9]
fun Aggregate<Int>.contextParameters(): Any? = context(Sensors(localId * 3)) { hottest() }

@Serializable @JvmInline value class Metres(val value: Double) : Comparable<Metres> {
    operator fun plus(other: Metres) = Metres(value + other.value)
    override fun compareTo(other: Metres) = value.compareTo(other.value)
}
// = [0.0, 1.5, 3.0, 4.5]
fun Aggregate<Int>.valueClasses(): Any? =
    distanceTo(localId == 0, Metres(0.0), Metres(Double.MAX_VALUE), hops().mapValues { Metres(it * 1.5) }, accumulateDistance = Metres::plus).value

fun Aggregate<Int>.count(x: Int): Int = neighboring(x).neighbors.values.list.sum()
// = [[1, 1, 1, 1, 1, 2], [2, 2, 2, 2, 2, 4], [4, 4, 4, 4, 2, 4], [2, 2, 2, 2, 1, 2]]
fun Aggregate<Int>.functionReferences(): Any? {
    val f: (Int) -> Int = ::count
    val g: (Int) -> Int = this::count
    val h: Aggregate<Int>.(Int) -> Int = Aggregate<Int>::count
    val n: (Int) -> Field<Int, Int> = ::neighboring
    return listOf(f(localId), g(localId), h(localId), n(localId).neighbors.values.list.sum()) + listOf(1, 2).map { alignedOn(it) { f(it) } }
}

operator fun Aggregate<Int>.get(key: String): Int = alignedOn(key) { neighboring(key.length).neighbors.values.list.sum() }
operator fun Aggregate<Int>.invoke(x: Int): List<Int> = neighboring(x).neighbors.values.list
infix fun Aggregate<Int>.sees(x: Int): Boolean = x in neighboring(localId).neighbors.values.list
operator fun Aggregate<Int>.contains(x: Int): Boolean = this sees x
operator fun Field<Int, Int>.unaryMinus(): Field<Int, Int> = mapValues { -it }
// = [[1, 2, [1], true, false, true, [-1], [2]], [2, 4, [0, 2], false, true, false, [0, -2], [0, 4]], [2, 4, [1, 3], true, false, true, [-1, -3], [2, 6]], [1, 2, [2], false, true, false, [-2], [4]]]
fun Aggregate<Int>.operators(): Any? = listOf(this["a"], this["bb"], this(localId), this sees 1, 2 in this, 2 !in this, (-neighboring(localId)).neighbors.values.list, (neighboring(localId) + neighboring(localId)).neighbors.values.list)

data class Estimate(val distance: Int, val count: Int)
fun Aggregate<Int>.estimate(): Estimate { val d = hopsTo(localId == 0); return Estimate(d, convergeSum(1, d)) }
operator fun Aggregate<Int>.component1(): Int = localId
operator fun Aggregate<Int>.component2(): Int = neighborhood().neighbors.size
// = [[0, 4, 0, 1, 1, 0], [1, 3, 1, 2, 2, 0, 0], [2, 2, 2, 2, 2, 0, 0], [3, 1, 3, 1, 1, 0]]
fun Aggregate<Int>.destructuring(): Any? {
    val (distance, count) = estimate()
    val (id, near) = this
    val (_, again) = this
    return listOf(distance, count, id, near, again) + neighboring(localId).neighbors.list.map { (id, value) -> id - value }
}

fun Aggregate<Int>.ping(n: Int): Int = if (n == 0) 0 else 1 + pong(n - 1) + neighboring(n).neighbors.values.list.sum()
fun Aggregate<Int>.pong(n: Int): Int = if (n == 0) 0 else 1 + ping(n - 1)
// = [3, 6, 11, 8]
fun Aggregate<Int>.mutualRecursion(): Any? = ping(localId + 1)

class Log : AutoCloseable { val lines = mutableListOf<String>(); override fun close() { lines += "closed" } }
// = [[near 1, rounds 12, again 1, also 1, closed, 5], [near 2, rounds 12, again 2, also 2, closed, 6], [near 2, rounds 12, again 2, also 2, closed, 6], [near 1, rounds 12, again 1, also 1, closed, 5]]
fun Aggregate<Int>.scopeFunctions(): Any? {
    val log = Log()
    val r = log.use { l ->
        l.apply { lines += "near " + neighboring(localId).neighbors.size }
        with(l) { lines += "rounds " + evolve(0) { it + 1 } }
        l.run { lines += "again " + neighboring(localId).neighbors.size }
        l.also { it.lines += "also " + neighborhood().neighbors.size }
        l.let { it.lines.size + neighboring(1).neighbors.size }
    }
    return log.lines + r
}

fun Aggregate<Int>.find(limit: Int): Int {
    listOf(3, 1, 2).forEach { x ->
        try {
            if (alignedOn(x) { neighboring(x).neighbors.size } * x > limit) return x
        } finally {
            alignedOn(x) { evolve(0) { it + 1 } }
        }
    }
    return -1
}
// = [(3, 1), (3, 2), (3, 2), (3, 1)]
fun Aggregate<Int>.earlyReturns(): Any? = find(2) to neighborhood().neighbors.size

// = [[12, 24, [3], 2], [12, 24, [3, 3], 4], [12, 24, [3, 3], 8], [12, 24, [3], 4]]
fun Aggregate<Int>.localClasses(): Any? {
    class Counter(val step: Int) { fun rounds() = evolve(0) { it + step }; val near = neighboring(step).neighbors.values.list }
    val shared = object { fun sum() = neighboring(localId).neighbors.values.list.sum() }
    fun twice() = shared.sum() + shared.sum()
    return listOf(Counter(1).rounds(), Counter(2).rounds(), Counter(3).near, twice())
}
object Tools { fun Aggregate<Int>.near() = neighboring(localId).neighbors.ids.list; fun near(aggregate: Aggregate<Int>) = aggregate.neighboring(1).neighbors.size }
// = [[1, 1], [0, 2, 2], [1, 3, 2], [2, 1]]
fun Aggregate<Int>.singletons(): Any? = with(Tools) { near() + near(this@singletons) }

interface Behaviour { fun Aggregate<Int>.step(): Int = neighboring(localId).neighbors.values.list.sum(); fun name() = "b" }
open class Base : Behaviour { override fun Aggregate<Int>.step(): Int = evolve(0) { it + 1 } }
class Derived : Base() { override fun Aggregate<Int>.step(): Int = 10 * neighborhood().neighbors.size }
class Wrapped(private val inner: Behaviour) : Behaviour by inner { override fun Aggregate<Int>.step() = with(inner) { step() } * 2 }
// = [[1, 12, 10, 24], [2, 12, 20, 24], [4, 12, 20, 24], [2, 12, 10, 24]]
fun Aggregate<Int>.interfacesWithDefaults(): Any? = listOf(object : Behaviour {}, Base(), Derived(), Wrapped(Base())).mapIndexed { i, b -> alignedOn(i) { with(b) { step() } } }

// = [[1, 12, 24, 48], [2, 0, 12, 24, 48], [3, 1, 12, 24, 48], [2, 12, 24, 48]]
fun Aggregate<Int>.sequences(): Any? = neighboring(localId).neighbors.list.asSequence().map { it.value }.filter { it != localId }.sortedDescending().take(2).toList() +
    generateSequence(1) { it * 2 }.takeWhile { it < 5 }.map { alignedOn(it) { evolve(0) { n -> n + it } } }.toList()

class Agent(private val device: Aggregate<Int>) {
    fun near(): List<Int> = device.neighboring(device.localId).neighbors.values.list
    fun rounds(): Int = device.evolve(0) { it + 1 }
    fun both(): List<Int> = near() + rounds()
}
// = [[1, 12, 1, 12], [0, 2, 12, 0, 2, 12], [1, 3, 12, 1, 3, 12], [2, 12, 2, 12]]
fun Aggregate<Int>.objectsThatKeepTheAggregate(): Any? { val agent = Agent(this); return agent.near() + agent.rounds() + agent.both() }
// = [[1], [0], [3], [2]]
fun Aggregate<Int>.keptAggregateInArms(): Any? { val agent = Agent(this); return if (localId < 2) agent.near() else agent.near() }

fun Aggregate<Int>.adder(x: Int): (Int) -> Int = { y -> neighboring(x + y).neighbors.values.list.sum() }
// = [[2, 3, 7], [4, 6, 14], [4, 6, 14], [2, 3, 7]]
fun Aggregate<Int>.returnedLambdas(): Any? { val add = adder(1); return listOf(add(1), add(2), adder(3)(4)) }

// = [true, true, true, false]
fun Aggregate<Int>.channel(): Any? {
    val source = distanceTo(localId == 0)
    val target = distanceTo(localId == 2)
    val width = gradientCast(localId == 0, target, hops().mapValues { it.toDouble() })
    return source + target <= width
}
// = [(1, 1.0, 3), (1, 0.0, 3), (3, 1.0, 3), (3, 0.0, 1)]
fun Aggregate<Int>.leadersAndTheirMembers(): Any? {
    val leader = boundedElection(bound = 1)
    val potential = distanceTo(leader == localId)
    val members = countDevices(potential)
    return Triple(leader, potential, hopGradientCast(leader == localId, members))
}

enum class Mode { SUM { override fun of(f: Field<Int, Int>) = f.neighbors.values.list.sum() }, MAX { override fun of(f: Field<Int, Int>) = f.neighbors.values.list.maxOrNull() ?: 0 }; abstract fun of(f: Field<Int, Int>): Int }
// = [{SUM=1, MAX=1}, {SUM=2, MAX=2}, {SUM=4, MAX=3}, {SUM=2, MAX=2}]
fun Aggregate<Int>.enumsWithBodies(): Any? { val f = neighboring(localId); return Mode.entries.associateWith { it.of(f) }.mapKeys { it.key.name } }
class Plan private constructor(val near: List<Int>) { companion object { operator fun invoke(a: Aggregate<Int>) = Plan(a.neighboring(a.localId).neighbors.values.list); val Aggregate<Int>.plan get() = Plan(this) } }
// = [[1, 1], [0, 2, 0, 2], [1, 3, 1, 3], [2, 2]]
fun Aggregate<Int>.companions(): Any? = with(Plan.Companion) { plan.near + Plan(this@companions).near }
// = [[[1], 0, true, 1], [[0], 0, true, 1], [[-3], 9, false, 7], [[-2], 9, false, 7]]
fun Aggregate<Int>.branches(): Any? {
    val f = neighboring(localId)
    val left = localId < 2
    val s = if (left) f.neighbors.values.list else f.neighbors.values.list.map { -it }
    val m = when { localId == 0 -> neighboring(0).neighbors.size; localId == 1 -> neighboring(0).neighbors.size; else -> 9 }
    val ok = left && neighboring(1).neighbors.size == 1
    val e = (if (left) null else 7) ?: neighboring(1).neighbors.size
    return listOf(s, m, ok, e)
}
// = [[null, [1], 2], [null, [0, 2], 3], [null, null, 0], [null, [2], 1]]
fun Aggregate<Int>.nullables(): Any? {
    val f: Field<Int, Int>? = if (localId == 3) null else null
    val g = neighboring(localId).takeIf { localId != 2 }
    return listOf(f?.neighbors?.size, g?.neighbors?.values?.list, g?.let { it.neighbors.size + neighborhood().neighbors.size } ?: neighborhood().neighbors.size)
}
fun <T> Aggregate<Int>.each(vararg steps: Aggregate<Int>.() -> T): List<T> = steps.mapIndexed { i, s -> alignedOn(i) { s() } }
// = [[1, 12, 0], [2, 12, 1], [4, 12, 2], [2, 12, 3]]
fun Aggregate<Int>.varargsOfPrograms(): Any? = each({ neighboring(localId).neighbors.values.list.sum() }, { evolve(0) { it + 1 } }, *arrayOf({ localId }))
@JvmOverloads @JvmName("over") fun Aggregate<Int>.overloads(a: Int = evolve(0) { it + 1 }, b: Int = neighboring(a).neighbors.values.list.sum()): Int = a * 100 + b
fun Aggregate<Int>.`has spaces and signs`(): Int = neighborhood().neighbors.size
// = [[1211, 101, 1], [1222, 102, 2], [1222, 102, 2], [1211, 101, 1]]
fun Aggregate<Int>.generatedOverloads(): Any? = listOf(overloads(), overloads(1), `has spaces and signs`())
// = [[1], [0], no, no]
fun Aggregate<Int>.smartCasts(): Any? {
    val any: Any = neighboring(localId)
    val list: Any = if (any is Field<*, *> && localId < 2) any.neighbors.list.map { it.id } else "no"
    return list
}
class Frame(a: Aggregate<Int>) { val near = a.neighboring(a.localId); lateinit var later: Field<Int, Int>; val size by lazy { near.neighbors.size } }
// = [[1, 2], [0, 1], [1], [1]]
fun Aggregate<Int>.propertiesOfFields(): Any? {
    val frame = Frame(this)
    frame.later = frame.near.mapValues { it + 1 }
    return if (localId < 2) frame.near.neighbors.values.list + frame.later.neighbors.values.list else listOf(frame.size)
}
// = [[-1, 99, 101, 101], [99, -1, 101, 102], [99, 99, 0, 101], [99, 99, 100, 0]]
fun Aggregate<Int>.anonymousFunctionsAndLabels(): Any? {
    val f = fun(x: Int): Int { if (x > 1) return neighboring(x).neighbors.size; return -1 }
    val r = listOf(0, 1, 2, 3).map { x -> alignedOn(x) here@{ if (x == localId) return@here f(x); f(x) + 100 } }
    return r
}
// = [[only 0, 1], [both, 2], [both, 2], [only 0, 1]]
fun Aggregate<Int>.caughtFailures(): Any? = listOf(
    runCatching { require(neighboring(localId).neighbors.size == 2) { "only " + neighborhood().neighbors.size }; "both" }.getOrElse { it.message },
    neighborhood().neighbors.size,
)
class Net<T : Any>(val a: Aggregate<T>) { inner class View { fun ids(): List<T> = a.neighborhood().neighbors.ids.list } }
// = [[1], [0, 2], [1, 3], [2]]
fun Aggregate<Int>.innerClasses(): Any? = Net(this).View().ids()
fun interface Step<R> { fun Aggregate<Int>.run(): R }
fun <R> Aggregate<Int>.perform(step: Step<R>): R = with(step) { run() }
// = [[1, 12], [2, 12], [2, 12], [1, 12]]
fun Aggregate<Int>.functionalInterfaces(): Any? = listOf(perform { neighboring(localId).neighbors.size }, perform { evolve(0) { it + 1 } })
// = [[1], [10, 12], [21, 23], [32]]
fun Aggregate<Int>.exchanges(): Any? = exchanging(0) { f -> f.map { (id, v) -> if (id == localId) v + 1 else id * 10 + localId }.yielding { f.neighbors.values.list } }
abstract class Part(protected val device: Aggregate<Int>) { abstract fun value(): Int; fun total(): Int = value() + device.neighboring(value()).neighbors.values.list.sum() }
class IdPart(device: Aggregate<Int>) : Part(device) { override fun value(): Int = device.neighboring(device.localId).neighbors.size }
interface Mixin { val device: Aggregate<Int>; fun near(): Int = device.neighborhood().neighbors.size }
class Mixed(override val device: Aggregate<Int>) : Mixin { fun twice() = near() * 10 + near() }
class Team(private val agents: List<Agent>, val first: Agent) { fun all(): List<Int> = first.near(); fun sum() = first.near().sum() }
// = [[3, 11, [1], 1], [5, 22, [0], 2], [5, 22, [3], 4], [3, 11, [2], 2]]
fun Aggregate<Int>.hierarchies(): Any? {
    val team = Team(listOf(Agent(this)), Agent(this))
    return listOf(IdPart(this).total(), Mixed(this).twice(), if (localId < 2) team.all() else team.all(), team.sum())
}
class Lazily(val a: Aggregate<Int>) { val near by lazy { a.neighboring(a.localId).neighbors.values.list }; var rounds: Int = 0; set(value) { field = value + a.evolve(0) { it + 1 } }
    inner class Deep { inner class Deeper { fun go() = a.neighboring(1).neighbors.size + a.neighboring(2).neighbors.size } }
    companion object { fun of(a: Aggregate<Int>) = Lazily(a) } }
// = [[[1], [1], 13, 2], [[0, 2], [0, 2], 13, 4], [[1, 3], [1, 3], 13, 4], [[2], [2], 13, 2]]
fun Aggregate<Int>.lazyPropertiesAndSetters(): Any? { val l = Lazily.of(this); l.rounds = 1; return listOf(l.near, l.near, l.rounds, l.Deep().Deeper().go()) }
// = [[1, 1, 1, 1, 1, 1, 1, 1, 2], [1, 1, 1, 1, 1, 1, 1, 1, 2], [0], [0]]
fun Aggregate<Int>.containersOfFields(): Any? {
    val list = listOf(neighboring(localId), neighboring(-localId))
    val pair = list[0] to list[1]
    val map = mapOf("a" to list[0])
    val (x, y) = pair
    val f by lazy { neighboring(localId) }
    f.neighbors
    return if (localId < 2) listOf(list[0].neighbors.size, pair.first.neighbors.size, pair.second.neighbors.size, map["a"]?.neighbors?.size, map.getValue("a").neighbors.size, x.neighbors.size, list.first().neighbors.size, f.neighbors.size, list.map { it.neighbors.size }.sum())
    else listOf(0)
}
fun <F : Field<Int, Int>> Aggregate<Int>.sizeIn(f: F, left: Boolean): Int = if (left) f.neighbors.size else -f.neighbors.size
// = [[1, 0], [1, 0], [-1, 0], [-1, 0]]
fun Aggregate<Int>.boundsOfFields(): Any? = listOf(sizeIn(neighboring(localId), localId < 2), sizeIn(neighboring(localId), localId % 2 == 0))
// = [[1, -1, 1], [2, -1, 2], [2, 1, 2], [1, 1, 1]]
fun Aggregate<Int>.loopsAndTry(): Any? {
    var n = 0
    val out = mutableListOf<Int>()
    do {
        out += alignedOn(n) { if (n % 2 == 0) neighboring(n).neighbors.size else try { check(localId > 1); neighboring(n).neighbors.size } catch (e: IllegalStateException) { -neighboring(n).neighbors.size } }
        n++
    } while (n < 3)
    return out
}
class Cell(val a: Aggregate<Int>) { var v = 0; operator fun plusAssign(x: Int) { v += x + a.neighboring(x).neighbors.size } ; operator fun get(i: Int) = a.neighboring(i).neighbors.size + i; operator fun set(i: Int, x: Int) { v = i + x + a.evolve(0) { it + 1 } } ; operator fun inc() = also { v += a.neighborhood().neighbors.size } }
// = [20, 21, 21, 20]
fun Aggregate<Int>.compoundAssignments(): Any? { var c = Cell(this); c += 2; c[1] = c[2]; c++; ++c; c[3] += 1; return c.v }
class Build(private val a: Aggregate<Int>) { val parts = mutableListOf<Int>(); fun part(make: Aggregate<Int>.() -> Int) { parts += a.make() } }
fun Aggregate<Int>.build(block: Build.() -> Unit): List<Int> = Build(this).apply(block).parts
// = [[1, 12, 1], [2, 12, 2], [2, 12, 2], [1, 12, 1]]
fun Aggregate<Int>.builders(): Any? = build { part { neighboring(localId).neighbors.size }; part { evolve(0) { it + 1 } }; if (parts.size == 2) part { neighborhood().neighbors.size } }
// = [0, 10, 0, 10]
fun Aggregate<Int>.tablesOfPrograms(): Any? {
    val table: Map<String, Aggregate<Int>.() -> Int> = mapOf("even" to { neighboring(1).neighbors.size }, "odd" to { neighboring(1).neighbors.size + 10 })
    return table.getValue(if (localId % 2 == 0) "even" else "odd")(this)
}
// = [(3, 3), (6, 6), (6, 6), (3, 3)]
fun Aggregate<Int>.recursiveLambdas(): Any? {
    fun down(n: Int): Int = if (n == 0) 0 else neighboring(n).neighbors.size + down(n - 1)
    lateinit var up: (Int) -> Int
    up = { n -> if (n >= 3) 0 else neighboring(n).neighbors.size + up(n + 1) }
    return down(3) to up(0)
}
data class Reading(val near: Field<Int, Int>, val local: Int)
// = [[true, 2, 1, 1], [true, 2, 2, 1], [true, 2, 2, 1], [true, 2, 1, 1]]
fun Aggregate<Int>.dataClassesOfFields(): Any? { val r = Reading(neighboring(localId), 1); val s = r.copy(local = 2); val (near, l) = s; return listOf(near == r.near, l, near.neighbors.size, if (localId < 2) s.near.neighbors.size else s.near.neighbors.size) }
inline fun <reified T : Any> Aggregate<Int>.typed(value: T, noinline show: (T) -> String = { it.toString() + neighborhood().neighbors.size }): String = T::class.simpleName + show(neighboring(value).local.value)
// = [[Int11, Stringx1, Int2], [Int12, Stringx2, Int2], [Int12, Stringx2, Int2], [Int11, Stringx1, Int2]]
fun Aggregate<Int>.reifiedTypes(): Any? = listOf(typed(1), typed("x"), typed(2) { it.toString() })
fun Aggregate<Int>.firstOr(x: Int? = null): Any? { val v = x ?: run { val n = neighboring(localId).neighbors.size; if (n == 2) return "two"; n }; return listOf(v, neighborhood().neighbors.size) }
// = [[[1, 0], [5, 1]], [two, [5, 2]], [two, [5, 2]], [[1, 0], [5, 1]]]
fun Aggregate<Int>.returnsFromRun(): Any? = listOf(firstOr(), firstOr(5))
// = [[1, [1, 3], 12], [2, [1, 3], 12], [2, [1, 3], 12], [1, [1, 3], 12]]
fun Aggregate<Int>.javaInterfaces(): Any? { var r = 0; Runnable { r = neighboring(localId).neighbors.size }.run(); val c = Comparator<Int> { a, b -> a - b }; return listOf(r, listOf(3, 1).sortedWith(c)) + java.util.function.Supplier { evolve(0) { it + 1 } }.get() }
// = [[1, [1], 1, 1], [2, [0, 2], 1, 1], [2, [1, 3], 0, 7], [1, [2], 0, 7]]
fun Aggregate<Int>.objectExpressions(): Any? { val f = neighboring(localId); val o = object { val size = f.neighbors.size; fun ids() = f.neighbors.ids.list; fun here() = if (localId < 2) f.neighbors.size else 0 }; return listOf(o.size, o.ids(), o.here(), if (localId < 2) o.here() else 7) }
var Aggregate<Int>.mem: Int get() = evolve(0) { it + 1 }; set(v) { neighboring(v) }
// = [12, 12, 12, 12]
fun Aggregate<Int>.settersOfTheAggregate(): Any? { mem = 3; mem += 1; return mem }
context(a: Aggregate<Int>) val nearCount: Int get() = a.neighborhood().neighbors.size
context(a: Aggregate<Int>) fun <T> List<T>.sharedSize(): Int = a.neighboring(size).neighbors.values.list.sum()
// = [[1, 1, 2, 1], [2, 2, 4, 1], [2, 2, 4, 1], [1, 1, 2, 1]]
fun Aggregate<Int>.contextProperties(): Any? = listOf(nearCount, nearCount, listOf(1, 2).sharedSize(), if (localId < 2) nearCount else nearCount)
// = [[], 0, [3], [2]]
fun Aggregate<Int>.results(): Any? = runCatching { if (localId == 1) error("one") else neighboring(localId).neighbors.ids.list }.fold({ it }, { neighborhood().neighbors.size })
// = [one 0, two [2], two [1], one 0]
fun Aggregate<Int>.rangesAndSubjects(): Any? = when (val n = neighboring(localId).neighbors.size) { in 0..0 -> "none"; 1 -> "one " + neighboring(n).neighbors.size; 2, 3 -> alignedOn(n) { alignedOn(n) { "two " + neighboring(n).neighbors.ids.list } }; else -> throw IllegalStateException() }
typealias Sense = Field<Int, Int>
// = [-1, -1, 1, 1]
fun Aggregate<Int>.typeAliases(): Any? { val s: Sense = neighboring(localId); val g: (Sense) -> Int = { it.neighbors.size }; return if (localId > 1) g(s) else -g(s) }
// = [[1, 1, 1], [2, 2, 2], [2, 2, 2], [1, 1, 1]]
fun Aggregate<Int>.sequenceBuilders(): Any? = sequence { for (x in 1..3) yield(this@sequenceBuilders.alignedOn(x) { neighboring(x).neighbors.size }) }.toList()
