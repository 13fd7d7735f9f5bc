package it.unibo.collektive.state

import it.unibo.collektive.path.Path

/** What a device stores from round to round: the value at each path that it visited. */
public typealias State = Map<Path, Any?>
