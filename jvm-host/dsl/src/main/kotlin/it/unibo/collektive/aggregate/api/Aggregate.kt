package it.unibo.collektive.aggregate.api

import it.unibo.collektive.aggregate.Field
import kotlinx.serialization.KSerializer
import kotlinx.serialization.SerializationException
import kotlinx.serialization.serializer
import org.collektive.alignment.withPlace
import kotlin.reflect.KType
import kotlin.reflect.typeOf

/**
 * One device during one round: the receiver of every aggregate program.
 *
 * Valid only while the round runs, and only on the thread that runs it.
 *
 * Every primitive runs at a *path*: the stack of pivots that [alignedOn] (or [align]) pushed. Two devices exchange values only
 * where their paths are equal. Two primitives at the same path in one round throw an
 * [it.unibo.collektive.aggregate.AlignmentClashException]; wrap each in [alignedOn] with a distinct pivot.
 *
 * ```
 * fun Aggregate<Int>.hottest(temperature: Double): Double {
 *     val rounds = alignedOn("rounds") { evolve(0) { it + 1 } }
 *     return alignedOn("share") { share(temperature) { seen -> maxOf(temperature, seen.neighbors.values.list.max()) } }
 * }
 * ```
 */
public interface Aggregate<ID : Any> {
    /** `true` when values stay inside the process, so that any object can be shared without a serializer. */
    public val inMemoryOnly: Boolean

    /** This device's id. */
    public val localId: ID

    /**
     * Applies [transform] to the value stored at this path, stores the result and returns it.
     *
     * [transform] gets [initial] in the first round, and whenever the previous round did not reach this path.
     */
    public fun <Stored> evolve(initial: Stored, transform: (Stored) -> Stored): Stored

    /**
     * [evolve] that stores one value and returns another: `evolving(0) { n -> (n + 1).yielding { "round $this" } }`.
     *
     * @throws IllegalStateException when the returned value is a [Field].
     */
    public fun <Stored, Return> evolving(initial: Stored, transform: YieldingScope<Stored, Return>): Return

    /**
     * Runs [body] below [pivot]: its primitives exchange values only with devices that run them below an equal pivot.
     *
     * Pivots are compared by `equals` and `hashCode` and must be immutable. The stack is restored afterwards, even when [body]
     * throws.
     *
     * @throws IllegalStateException when the result is a [Field]: its devices may not be aligned outside [body].
     */
    public fun <R> alignedOn(pivot: Any?, body: () -> R): R

    /** Pushes [pivot] until [dealign] pops it. Prefer [alignedOn], which always pops. */
    @DelicateCollektiveApi
    public fun align(pivot: Any?)

    /** Pops the last pivot that [align] pushed. */
    @DelicateCollektiveApi
    public fun dealign()

    /** Implements the extension `exchanging`. Programs call the extension, which derives [dataSharingMethod] from the type. */
    @DelicateCollektiveApi
    public fun <Shared, Return> exchanging(
        initial: Shared,
        dataSharingMethod: DataSharingMethod<Shared>,
        body: YieldingScope<Field<ID, Shared>, Return>,
    ): Return

    /** Implements the extension `neighboring`. Programs call the extension, which derives [dataSharingMethod] from the type. */
    @DelicateCollektiveApi
    public fun <Shared> neighboring(local: Shared, dataSharingMethod: DataSharingMethod<Shared>): Field<ID, Shared>

    public companion object {
        /**
         * Returns how values of type [Shared] are sent: by reference inside one process, otherwise serialised. Primitives call it.
         *
         * @throws SerializationException when values leave the process and [Shared] has no serializer.
         */
        public inline fun <reified Shared> Aggregate<*>.dataSharingMethod(): DataSharingMethod<Shared> =
            if (inMemoryOnly) InMemory else serialized(typeOf<Shared>())

        @PublishedApi
        @Suppress("UNCHECKED_CAST")
        internal fun <Shared> Aggregate<*>.serialized(type: KType): DataSharingMethod<Shared> = try {
            Serialize(serializer(type) as KSerializer<Shared>)
        } catch (cause: SerializationException) {
            val name = type.toString().removeSuffix(" (Kotlin reflection is not available)")
            val message = "values of type $name cannot be sent: they have no serializer; mark the class with @Serializable"
            throw SerializationException(withPlace(message), cause)
        }
    }
}
