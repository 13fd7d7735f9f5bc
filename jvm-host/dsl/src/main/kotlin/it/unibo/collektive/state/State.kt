package it.unibo.collektive.state

import it.unibo.collektive.path.Path

/** What a device keeps from round to round: for each path visited, the value kept there. */
public typealias State = Map<Path, Any?>
