package it.unibo.collektive.state

import it.unibo.collektive.path.Path

/** The values that a device stores between rounds, by path. */
public typealias State = Map<Path, Any?>
