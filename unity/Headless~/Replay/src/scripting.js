// The commands that pages offer to scripts.

export function commandsOf(player) {
  const { recording } = player;
  return {
    frames: recording.count,
    metadata: recording.metadata,
    /** `seek` and `show` return a promise if the frame must be read first. */
    seek: (frame) => player.seek(frame),
    show: (time) => player.show(time),
    play: () => player.play(),
    pause: () => player.pause(),
    setSpeed: (speed) => player.setSpeed(speed),
    setLinks: (visible) => player.setLinks(visible),
    setNodeSize: (factor) => player.setFactor(factor),
    setControls: (visible) => player.setControls(visible),
    select: (id) => player.selectId(id),
    view: (from) => player.view.frame(from),
    /** Returns the id of the node at a point of the page, or null. */
    at: (x, y) => player.here.ids[player.view.pick(x, y)] ?? null,
    /** The names of the fields by which nodes can be coloured, and a command that selects one. */
    fields: player.fields.map(({ name }) => name),
    colourBy: (name) => player.legend.choose(player.fields.findIndex((field) => field.name === name)),
    /** Shows a second run, given as its page's HTML; null ends the comparison. */
    compare: (page) => player.compare(page),
    /** Returns the current frame as it was recorded, in Unity's axes. */
    state: () => {
      const { here } = player;
      const { ids } = here;
      return {
        frame: here.index,
        time: player.time,
        playing: player.playing,
        nodes: Array.from(here.slots, (s) => ({
          id: ids[s], x: here.places[4 * s], y: here.places[4 * s + 1], z: here.places[4 * s + 2], scalar: here.values[0][s],
          values: here.values.map((column) => column[s]),
        })),
        links: Array.from(here.ways).flatMap((ways, i) => {
          const [a, b] = [ids[here.pairs[2 * i]], ids[here.pairs[2 * i + 1]]];
          return [[a, b], [b, a]].filter((_, direction) => (ways >> direction) & 1);
        }),
        other: player.other?.here ? { frame: player.other.here.index, nodes: player.other.here.slots.length } : null,
      };
    },
    /** Draws the current frame immediately, before a picture is taken. */
    draw: () => {
      for (const { view } of player.runs) view.draw();
      if (player.playing) player.view.request();
    },
  };
}
