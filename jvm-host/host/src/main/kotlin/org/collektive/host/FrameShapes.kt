package org.collektive.host

import org.collektive.host.FrameVerifier.Companion.inline
import org.collektive.host.FrameVerifier.Companion.opaque
import org.collektive.host.FrameVerifier.Companion.string
import org.collektive.host.FrameVerifier.Companion.strings
import org.collektive.host.FrameVerifier.Companion.table
import org.collektive.host.FrameVerifier.Companion.tables
import org.collektive.host.FrameVerifier.Companion.vector
import org.collektive.host.FrameVerifier.Shape

/** The frames of `frame.fbs` that are read here, field by field. */
internal object FrameShapes {
    const val DUE = 7
    const val SENSORS = 8
    const val GLOBALS = 9
    const val ACTUATORS = 3

    private val typeFingerprint = Shape("types", string("name", isRequired = true), inline("hash", 8))

    private val network = Shape(
        "network",
        inline("loss", 8),
        inline("loss_per_metre", 8),
        inline("loss_per_attenuation", 8),
        inline("delay", 8),
        inline("jitter", 8),
        inline("retention", 8),
    )

    val openRequest = Shape(
        "OpenRequest",
        inline("protocol", 4),
        inline("seed", 8),
        inline("threads", 4),
        inline("schedule", 1),
        strings("jars"),
        string("schema", isRequired = true),
        tables("types", typeFingerprint, isRequired = true),
        string("program"),
        table("network", network),
        string("record"),
    )

    val controlRequest = Shape(
        "ControlRequest",
        strings("flags"),
        inline("collect", 1),
        inline("recording", 1),
        string("settings"),
        string("path"),
    )

    private val parameter = Shape("parameters", string("name", isRequired = true), string("value", isRequired = true))

    private val nodeAdded = Shape("nodes_added", inline("id", 4), string("program"), tables("parameters", parameter))

    val stepRequest = Shape(
        "StepRequest",
        inline("tick", 8),
        inline("time", 8),
        inline("delta_time", 8),
        vector("nodes_removed", 4),
        tables("nodes_added", nodeAdded),
        vector("links_removed", 8),
        vector("links", 16),
        vector("due", 4),
        opaque("sensors"),
        opaque("globals"),
    )

    private val roundError = Shape("errors", inline("node", 4), string("program", isRequired = true), string("message", isRequired = true))

    val stepResponse = Shape(
        "StepResponse",
        inline("tick", 8),
        inline("digest", 8),
        vector("nodes", 4),
        opaque("actuators"),
        tables("errors", roundError),
        inline("node_count", 4),
        inline("link_count", 4),
        inline("host_micros", 4),
        inline("round_micros", 4),
        inline("sent", 4),
        inline("dropped", 4),
        inline("delayed", 4),
        inline("expired", 4),
    )
}
