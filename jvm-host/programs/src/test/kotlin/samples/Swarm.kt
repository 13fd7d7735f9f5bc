package samples

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.util.Point2D
import org.collektive.api.Device
import org.collektive.testing.TestNetwork

/**
 * Devices on the ground.
 *
 * In each tick, all devices run [round] on the data that [sense] returns for their id and position. Two devices are linked while they are
 * less than [range] metres apart.
 */
internal class Swarm<S : Any, A : Any>(
    private val range: Double,
    private val parameters: Map<String, String>,
    private val sense: (id: Int, at: Point2D) -> S,
    private val round: Aggregate<Int>.(S, Device) -> A,
    runtime: String = "builtIn",
) : AutoCloseable {
    /** The position of each device by id. Change it between ticks to add, move and remove devices. */
    val places = sortedMapOf<Int, Point2D>()

    private val network = TestNetwork(deltaTime = DELTA, runtime = runtime)
    private val links = HashSet<Pair<Int, Int>>()

    /**
     * Runs one tick and returns the answers by id.
     *
     * @throws IllegalStateException when a round failed.
     */
    fun tick(): Map<Int, A> {
        val gone = network.nodes - places.keys
        gone.forEach(network::remove)
        links.removeIf { it.first in gone || it.second in gone }
        for (id in places.keys - network.nodes) network.add(id, parameters)
        link()
        val seen = places.mapValues { (id, place) -> sense(id, place) }
        return network.round { device -> round(seen.getValue(device.id), device) }
    }

    /** Runs [count] ticks and returns the answers of the last one. */
    fun ticks(count: Int): Map<Int, A> {
        repeat(count - 1) { tick() }
        return tick()
    }

    override fun close() = network.close()

    private fun link() {
        val near = places.keys.flatMap { a ->
            places.keys.filter { b -> a < b && places.getValue(a).distanceTo(places.getValue(b)) < range }.map { b -> a to b }
        }.toSet()
        for ((a, b) in links - near) network.unlink(a, b)
        for ((a, b) in near - links) network.link(a, b)
        links.clear()
        links += near
    }

    private companion object {
        const val DELTA = 0.05
    }
}
