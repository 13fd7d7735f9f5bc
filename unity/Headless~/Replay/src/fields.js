// What can colour the nodes: the recorded fields, and those that follow from places and links.

/** Fields have `name`, `kind`, `unit`, `words`, their range `least` to `greatest` (undefined: unknown), and `valuesOf(frame)`, by slot. */
export function fieldsOf(recording) {
  const recorded = recording.fields.map((field, index) => ({ words: [], ...field, valuesOf: (frame) => frame.values[index] }));
  const { least, greatest } = extent(recording.ids);
  const derived = [
    { name: 'node', kind: 'category', least, greatest, valuesOf: (frame) => frame.ids },
    { name: 'neighbours', kind: 'number', valuesOf: once((frame) => degrees(frame)) },
    { name: 'speed', kind: 'number', unit: 'm/s', valuesOf: once((frame) => speeds(recording, frame)) },
    { name: 'height', kind: 'number', unit: 'm', valuesOf: once((frame) => frame.values[0].map((_, slot) => frame.places[4 * slot + 1])) },
  ];
  return [...recorded, ...derived.filter(({ name }) => !recorded.some((field) => field.name === name)).map((field) => ({ words: [], ...field }))];
}

/** The least and the greatest of some values; 0 without values. */
export function extent(values) {
  let [least, greatest] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < least) least = value;
    if (value > greatest) greatest = value;
  }
  return least <= greatest ? { least, greatest } : { least: 0, greatest: 0 };
}

/** A value in the field's own words. */
export function textOf({ kind, unit, words }, value) {
  if (Number.isNaN(value)) return 'no value';
  if (kind === 'colour') return `#${value.toString(16).padStart(6, '0')}`;
  if (kind === 'category') return words[value] ?? String(value);
  return short(value) + (unit ? ` ${unit}` : '');
}

export function short(value) {
  return Number(value.toPrecision(4)).toLocaleString('en', { maximumSignificantDigits: 4 });
}

function once(compute) {
  const known = new WeakMap();
  return (frame) => {
    if (!known.has(frame)) known.set(frame, compute(frame));
    return known.get(frame);
  };
}

function degrees(frame) {
  const counts = new Float32Array(frame.present.length);
  for (const slot of frame.pairs) counts[slot]++;
  return counts;
}

/** From this frame to the next, or from the one before at the end of a segment. */
function speeds(recording, frame) {
  const result = new Float32Array(frame.present.length).fill(NaN);
  const step = (frame.index + 1) % recording.framesPerSegment === 0 || frame.index === recording.count - 1 ? -1 : 1;
  const other = frame.index + step < 0 ? null : recording.frame(frame.index + step);
  if (!other) return result;
  const seconds = Math.abs(recording.times[other.index] - recording.times[frame.index]);
  for (const slot of frame.slots) {
    if (!other.present[slot]) continue;
    const moved = [0, 1, 2].map((axis) => other.places[4 * slot + axis] - frame.places[4 * slot + axis]);
    result[slot] = Math.hypot(...moved) / seconds;
  }
  return result;
}
