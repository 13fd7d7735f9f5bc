package org.collektive.mailbox

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.spi.DeviceRuntimes
import org.collektive.spi.Export
import org.collektive.spi.Inbox
import org.collektive.spi.RuntimeProvider
import org.collektive.spi.SharingRule

/** Provides Collektive's own runtime to the host. */
public class CollektiveRuntime : RuntimeProvider {
    override val name: String get() = "collektive"

    /** Runs a trial round first, so that jars of another version fail here and not in the first tick. */
    override fun runtimes(rule: SharingRule): DeviceRuntimes = MailboxRuntimes(rule).also { runtimes ->
        val device = runtimes.device(0)
        @Suppress("UNCHECKED_CAST")
        device.round(NoLinks, { aggregate, _ -> (aggregate as Aggregate<Int>).evolve(0) { it + 1 } }, null)
        device.commit()
    }

    private object NoLinks : Inbox {
        override val size: Int get() = 0
        override val ids: Array<Any> = emptyArray()

        override fun export(index: Int): Export? = null

        override fun wasKnown(index: Int): Boolean = false
    }
}
