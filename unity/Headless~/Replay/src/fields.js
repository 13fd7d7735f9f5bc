// The fields by which nodes can be coloured. Some are recorded, and others are derived from positions and links.

const MAX_DRAWN = 1e300;
const SAME_TIME = 1e-6; // seconds: 0.3 is the time of the frame at 0.30000000000000004

/** Each field has `name`, `kind`, `unit`, `words`, a range `least` to `greatest` (undefined: unknown), and `valuesOf(frame)`, which returns values by slot. */
export function fieldsOf(recording) {
  const recorded = recording.fields.map((field, index) => ({ words: [], ...field, valuesOf: (frame) => frame.values[index] }));
  const { least, greatest } = extent(recording.ids);
  const sizeOf = (i) => (i % 2 ? 0 : Math.min(recording.ids[i + 1] - recording.ids[i] + 1, 256));
  const order = recording.ids.flatMap((first, i) => Array.from({ length: sizeOf(i) }, (_, n) => first + n));
  const derived = [
    { name: 'node', kind: 'category', order, least, greatest, valuesOf: (frame) => frame.ids },
    { name: 'neighbours', kind: 'number', valuesOf: once((frame) => degrees(frame)) },
    { name: 'speed', kind: 'number', unit: 'm/s', valuesOf: once((frame) => speeds(recording, frame)) },
    { name: 'height', kind: 'number', unit: 'm', valuesOf: once((frame) => frame.values[0].map((_, slot) => frame.places[4 * slot + 1])) },
  ];
  return [...recorded, ...derived.filter(({ name }) => !recorded.some((field) => field.name === name)).map((field) => ({ words: [], ...field }))];
}

/** Returns a node's values of a field in all frames, with null where it has no value. Stops and returns null when `needed` returns false. */
export async function historyOf({ recording, fields }, { name }, id, needed) {
  const field = fields.find((each) => each.name === name);
  if (!field) return recording.times.map(() => null);
  const values = [];
  for (let number = 0; number < recording.texts.length; number++) {
    const segment = await recording.read(number);
    if (!needed()) return null;
    for (let i = 0; i < segment.count; i++) {
      const frame = segment.frame(i);
      const value = field.valuesOf(frame)[slotOf(frame, id)];
      values.push(value === undefined || Number.isNaN(value) ? null : value);
    }
  }
  return values;
}

/** Returns the first field whose values mean something else in the field of `others` with the same name: another kind, or other constants of an enum. */
export function conflicting(fields, others) {
  return fields.find(({ name, kind, words }) => others.some((other) => other.name === name
    && (other.kind !== kind || words.some((word, value) => (other.words[value] ?? word) !== word))));
}

/** Returns the slot of a node in a frame; -1 if it is missing. */
export function slotOf({ slots, ids }, id) {
  return slots.find((slot) => ids[slot] === id) ?? -1;
}

/** Returns the least and the greatest of the values; both are 0 if `values` is empty. */
export function extent(values) {
  let [least, greatest] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < least) least = value;
    if (value > greatest) greatest = value;
  }
  return least <= greatest ? { least, greatest } : { least: 0, greatest: 0 };
}

/** Returns the index of the last of `times` that is not after a time, or 0 if all are after it. */
export function lastAt(times, time) {
  let low = 0;
  let high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time + SAME_TIME) low = middle;
    else high = middle - 1;
  }
  return low;
}

export function nameOf({ name, unit }) {
  return name + (unit ? ` (${unit})` : '');
}

/** Formats a value with the category names and the unit of its field. `step` is as for `short`. */
export function textOf({ kind, unit, words }, value, step) {
  if (Number.isNaN(value)) return 'no value';
  if (kind === 'colour') return `#${value.toString(16).padStart(6, '0')}`;
  if (kind === 'category') return words[value] ?? String(value);
  return short(value, step) + (unit ? ` ${unit}` : '');
}

/** Formats a time in seconds with the decimal places of `deltaTime`, from one to three. */
export function clock(time, deltaTime) {
  const places = String(Number(deltaTime.toPrecision(6))).split('.')[1]?.length ?? 1;
  return time.toFixed(Math.min(places, 3));
}

/** Returns a value that an axis can show, or null. The margins of an axis to Double.MAX_VALUE would be infinite. */
export function drawable(value) {
  return Math.abs(value) > MAX_DRAWN ? null : value;
}

/** Returns the indices of values that have no line to a neighbour, because null is on both sides. Times of another run are undefined and ignored. */
export function isolated(values) {
  const found = [];
  let [last, before] = [null, null]; // index of the last value, and the entry before it
  let entry = null;
  for (let i = 0; i <= values.length; i++) {
    if (values[i] === undefined && i < values.length) continue;
    const next = values[i] ?? null;
    if (next === null && entry !== null && before === null) found.push(last);
    [last, before, entry] = [i, entry, next];
  }
  return found;
}

/** Formats a number with four digits or more. Integers and integer parts below 1e9 have all digits. Values that differ by `step` have different texts. */
export function short(value, step) {
  const size = Math.abs(value);
  if (size >= 1e12 || (size > 0 && size < 1e-6)) return value.toExponential(digitsOf(value, step) - 1).replace(/\.?0*e\+?/, 'e');
  if (Number.isInteger(value) && size < 1e9) return value.toLocaleString('en');
  const digits = size < 1e9 ? Math.max(digitsOf(value, step), Math.floor(Math.log10(size)) + 1) : digitsOf(value, step);
  return Number(value.toPrecision(digits)).toLocaleString('en', { maximumSignificantDigits: digits });
}

/** Returns the number of digits, from 4 to 15, that a text of a value needs to show a difference of `step`. */
export function digitsOf(value, step) {
  return step > 0 && value !== 0 ? Math.min(Math.max(Math.floor(Math.log10(Math.abs(value))) - Math.floor(Math.log10(step)) + 2, 4), 15) : 4;
}

function once(compute) {
  const known = new WeakMap();
  return (frame) => {
    if (!known.has(frame)) known.set(frame, compute(frame));
    return known.get(frame);
  };
}

/** Returns the nodes' numbers of neighbours, which are unknown if the frame has only a part of the links. */
function degrees(frame) {
  const counts = new Float32Array(frame.present.length);
  if (frame.linksInAll > frame.links) return counts.fill(NaN);
  for (const slot of frame.pairs) counts[slot]++;
  return counts;
}

/** Returns the nodes' speeds between this frame and the next one, or the previous one at the end of a segment. The only frame of a run has none. */
function speeds(recording, frame) {
  const result = new Float32Array(frame.present.length).fill(NaN);
  const { first, count, previous } = frame.segment;
  const at = frame.index - first;
  const other = count === 1 ? previous?.frame(previous.count - 1) : frame.segment.frame(at + 1 < count ? at + 1 : at - 1);
  if (!other) return result;
  const seconds = Math.abs(recording.times[other.index] - recording.times[frame.index]);
  for (const slot of frame.slots) {
    if (!other.present[slot] || other.ids[slot] !== frame.ids[slot]) continue;
    const moved = [0, 1, 2].map((axis) => other.places[4 * slot + axis] - frame.places[4 * slot + axis]);
    result[slot] = Math.hypot(...moved) / seconds;
  }
  return result;
}
