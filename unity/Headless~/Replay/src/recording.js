// Reads a recording (FORMAT.md). The header is read immediately. A segment of frames is read when it is first shown.

import { lastAt } from './fields.js';

const VERSION = 6;
const KEPT_NODES = 1e6; // nodes in all cached frames, about 30 bytes each
const PAIR = 2 ** 26; // in a link's key: times the lesser slot
export const TEXELS = 1024; // nodes in a row of a frame's texture

/** An error for missing, damaged or incompatible data of the page. The page shows its message. */
export class ReplayError extends Error {}

export async function open(text) {
  if (text.startsWith('@@')) throw new ReplayError('This is the empty page template; it does not contain a run. Open the replay.html of a run.');
  if (typeof DecompressionStream === 'undefined') {
    throw new ReplayError('This browser is too old for the page (it has no DecompressionStream). Use a current version of Chrome, Edge, Firefox or Safari.');
  }
  const end = text.indexOf('\n');
  return orDamaged(async () => {
    const header = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(await unpack(end < 0 ? text : text.slice(0, end))));
    if (header.version !== VERSION) {
      throw new ReplayError(`The recording has version ${header.version}, this page reads version ${VERSION}: run the simulation again with the release `
        + 'of this page.');
    }
    if (text.length - end !== header.length) throw new Error('a wrong length');
    return new Recording(header, text.slice(end + 1).split('\n'));
  });
}

async function orDamaged(read) {
  try {
    return await read();
  } catch (error) {
    if (error instanceof ReplayError) throw error;
    throw new ReplayError(`The data of this page is damaged or truncated (${error.message}). Copy the file again, or run the simulation again.`);
  }
}

function unpack(base64) {
  return new Response(new Blob([fromBase64(base64)]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

function fromBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

class Recording {
  constructor(header, texts) {
    Object.assign(this, header); // times, slots, ids, metadata, ... as in FORMAT.md
    if (texts.length !== Math.ceil(this.times.length / this.framesPerSegment)) throw new Error('a wrong number of segments');
    this.texts = texts;
    this.kept = Math.max(4, Math.floor(KEPT_NODES / (this.framesPerSegment * Math.max(this.slots, TEXELS))));
    this.segments = new Map(); // number -> promise of a segment, most recently used last
    this.open = new Map(); // number -> segment, for loaded `segments`
  }

  get count() {
    return this.times.length;
  }

  /** Number of nodes in the whole run. */
  get nodes() {
    return this.ids.reduce((sum, id, i) => sum + (i % 2 === 0 ? -id : id + 1), 0);
  }

  /** Returns whether a node of the run has the given id. */
  has(id) {
    return this.ids.some((first, i) => i % 2 === 0 && first <= id && id <= this.ids[i + 1]);
  }

  /** Returns the index of the last frame that is not after a time, or 0 if all frames are after it. */
  frameAt(time) {
    return lastAt(this.times, time);
  }

  /** Returns the frame, or null if its segment is not loaded (see `load`). */
  frame(index) {
    const segment = this.open.get(Math.floor(index / this.framesPerSegment));
    return segment ? segment.frame(index % this.framesPerSegment) : null;
  }

  /** Loads a frame. A damaged segment throws a ReplayError. */
  load(index) {
    const number = Math.floor(index / this.framesPerSegment);
    let segment = this.segments.get(number);
    this.segments.delete(number);
    segment ??= this.read(number).then((loaded) => {
      if (this.segments.has(number)) this.open.set(number, loaded);
    });
    this.segments.set(number, segment);
    for (const oldest of this.segments.keys()) {
      if (this.segments.size <= this.kept) break;
      this.segments.delete(oldest);
      this.open.delete(oldest);
    }
    return segment;
  }

  /** Loads a segment for one use, without caching it. */
  read(number) {
    return orDamaged(async () => {
      const first = number * this.framesPerSegment;
      const segment = new Segment(await unpack(this.texts[number]), this, first, Math.min(this.framesPerSegment, this.count - first));
      // The speeds of a single frame depend on the frame before it.
      if (segment.count === 1 && number > 0) segment.previous = await this.read(number - 1);
      return segment;
    });
  }
}

/** A segment of frames. They are encoded as differences, so each must be decoded once and in order. */
export class Segment {
  constructor(buffer, recording, first, count) {
    this.bytes = new Uint8Array(buffer);
    const data = new DataView(buffer);
    this.at = 0;
    // For each field, a function that converts a code other than 0 to a value.
    this.decoders = recording.fields.map(({ kind }) => {
      if (kind !== 'number') return (code) => ((code - 1) >>> 1) ^ -((code - 1) & 1);
      const [min, max] = [data.getFloat64(this.at, true), data.getFloat64(this.at + 8, true)];
      const step = (max - min) / 65534;
      this.at += 16;
      return (code) => min + ((code >>> 0) - 1) * step;
    });
    const columns = 3 + recording.fields.length;
    this.recording = recording;
    this.first = first;
    this.count = count;
    this.frames = [];
    const { slots } = recording;
    this.ids = this.readIds(slots);
    this.seen = new Uint8Array(slots);
    this.last = Array.from({ length: columns }, () => new Int32Array(slots));
    this.motion = Array.from({ length: columns }, () => new Int32Array(slots));
    this.links = new Float64Array(0); // keys of pairs of slots, as in `readPairs`, sorted
  }

  frame(index) {
    while (this.frames.length <= index) this.frames.push(this.read());
    return this.frames[index];
  }

  read() {
    const frame = {
      index: this.first + this.frames.length,
      segment: this,
      ids: this.ids, // by slot
      ...this.readPresence(),
      places: new Float32Array(4 * TEXELS * Math.max(Math.ceil(this.recording.slots / TEXELS), 1)), // by slot x, y, z; -1 in w if it is missing
      // By field and slot; NaN: no value.
      values: this.recording.fields.map(() => new Float64Array(this.recording.slots).fill(NaN)),
    };
    const { slots, places, values } = frame;
    const { positionStep } = this.recording;
    const columns = this.last;
    for (let column = 0; column < columns.length; column++) this.readColumn(slots, columns[column], this.motion[column]);
    for (let i = 3; i < places.length; i += 4) places[i] = -1;
    for (const slot of slots) {
      this.seen[slot] = 1;
      places[4 * slot] = columns[0][slot] * positionStep;
      places[4 * slot + 1] = columns[1][slot] * positionStep;
      places[4 * slot + 2] = columns[2][slot] * positionStep;
      places[4 * slot + 3] = 0;
    }
    values.forEach((column, field) => {
      const decode = this.decoders[field];
      for (const slot of slots) {
        const code = columns[3 + field][slot];
        if (code !== 0) column[slot] = decode(code);
      }
    });
    frame.linksInAll = this.readNumber();
    this.links = changed(this.links, this.readPairs(), this.readPairs());
    frame.pairs = new Int32Array(2 * this.links.length); // slots, two for each linked pair
    frame.ways = new Uint8Array(this.links.length); // by pair: 1 for a link to its second slot, 2 for one to its first, 3 for both
    frame.links = 0; // number of links in `pairs`, each direction counted
    this.links.forEach((key, i) => {
      const rest = key % PAIR;
      frame.pairs[2 * i] = key / PAIR;
      frame.pairs[2 * i + 1] = rest >> 2;
      frame.ways[i] = rest & 3;
      frame.links += (rest & 3) === 3 ? 2 : 1;
    });
    if (this.frames.length === this.count - 1 && this.at !== this.bytes.length) throw new Error('bytes after the end');
    return frame;
  }

  readIds(slots) {
    const ids = new Int32Array(this.readNumber());
    if (ids.length > slots) throw new Error('too many slots');
    ids.forEach((_, slot) => { ids[slot] = (slot === 0 ? 0 : ids[slot - 1]) + this.readSigned(); });
    return ids;
  }

  readPresence() {
    const present = new Uint8Array(this.recording.slots);
    const slots = new Int32Array(present.length);
    let count = 0;
    const first = this.at;
    const known = this.readNumber();
    if (known > present.length) throw new Error(`frame at ${first} has too many nodes`);
    for (let slot = 0; slot < known; slot++) {
      present[slot] = (this.bytes[this.at + (slot >> 3)] >> (slot & 7)) & 1;
      if (present[slot]) slots[count++] = slot;
    }
    this.at += (known + 7) >> 3;
    return { present, slots: slots.subarray(0, count) };
  }

  readColumn(slots, last, motion) {
    const { seen } = this;
    for (const slot of slots) {
      const step = (motion[slot] + this.readSigned()) | 0;
      last[slot] += step;
      if (seen[slot]) motion[slot] = step;
    }
  }

  readPairs() {
    const keys = new Float64Array(this.readNumber());
    let a = -1;
    let b = 0;
    for (let i = 0; i < keys.length; i++) {
      const step = this.readNumber();
      a += step;
      const rest = this.readNumber();
      b = (step === 0 ? b : a) + (rest >>> 2);
      keys[i] = a * PAIR + 4 * b + (rest & 3);
    }
    return keys;
  }

  readSigned() {
    const coded = this.readNumber();
    return (coded >>> 1) ^ -(coded & 1);
  }

  readNumber() {
    const { bytes } = this;
    let part = bytes[this.at++];
    let value = part & 127;
    for (let shift = 7; part > 127; shift += 7) {
      part = bytes[this.at++];
      value |= (part & 127) << shift;
    }
    return value >>> 0;
  }
}

/** Returns a sorted set of links after removing and adding links. */
function changed(links, removed, added) {
  const result = new Float64Array(links.length - removed.length + added.length);
  let count = 0;
  let gone = 0;
  let next = 0;
  for (const link of links) {
    if (link === removed[gone]) gone++;
    else {
      while (next < added.length && added[next] < link) result[count++] = added[next++];
      result[count++] = link;
    }
  }
  while (next < added.length) result[count++] = added[next++];
  return result;
}
