// Reads a recording (FORMAT.md). Any frame is reached directly: nodes are absolute in each frame, and each link is kept as
// one interval of frames, so that the links of a frame are those whose interval holds it.

const MAGIC = 0x524b4c43; // "CLKR"
const VERSION = 1;
const BLOCK = 1024; // intervals that are passed over together when all have ended

/** The page's data is missing, damaged or of another version; the message is for the reader of the page. */
export class ReplayError extends Error {}

export async function decode(base64) {
  if (base64.startsWith('@@')) throw new ReplayError('This is the empty page template: it holds no run yet.');
  if (typeof DecompressionStream === 'undefined') {
    throw new ReplayError('This browser is too old for the page (it has no DecompressionStream). Any current Chrome, Edge, Firefox or Safari opens it.');
  }
  try {
    return new Recording(await gunzip(fromBase64(base64.trim())));
  } catch (error) {
    if (error instanceof ReplayError) throw error;
    throw new ReplayError(`The data of this page is damaged or cut short (${error.message}). Copy the file again, or run the simulation again.`);
  }
}

function fromBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

function gunzip(bytes) {
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

/** Nodes of one frame, by slot. */
export class NodeState {
  constructor(slots) {
    this.frame = -1;
    this.count = 0;
    this.slots = new Int32Array(slots); // the first `count` are the slots that are present
    this.present = new Uint8Array(slots);
    this.x = new Float32Array(slots);
    this.y = new Float32Array(slots);
    this.z = new Float32Array(slots);
    this.scalar = new Float32Array(slots); // NaN: no value
  }
}

class Recording {
  constructor(buffer) {
    this.data = new DataView(buffer);
    const { data } = this;
    if (data.getUint32(0, true) !== MAGIC) throw new ReplayError('The data of this page is not a recording.');
    const version = data.getUint32(4, true);
    if (version !== VERSION) {
      throw new ReplayError(`The recording has version ${version}, this page reads version ${VERSION}: build page and recording from one release.`);
    }
    const metadataLength = data.getUint32(8, true);
    this.metadata = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(new Uint8Array(buffer, 12, metadataLength)));
    this.times = [];
    this.ids = [];
    this.frames = []; // { nodes, slots }: where the present bits begin, and how many slots there are
    this.maxLinks = 0;
    this.scalarMin = Infinity;
    this.scalarMax = -Infinity;
    this.someWithoutScalar = false;
    this.readFrames(12 + metadataLength);
    if (!(this.scalarMin <= this.scalarMax)) this.scalarMin = this.scalarMax = 0;
    this.slotOfId = new Map(this.ids.map((id, slot) => [id, slot]));
  }

  get count() {
    return this.frames.length;
  }

  /** The last frame at or before a time; the first one for earlier times. */
  frameAt(time) {
    let low = 0;
    let high = this.count - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** Fills `state` with the nodes of a frame. */
  readNodes(frame, state) {
    const { data } = this;
    const { nodes, slots } = this.frames[frame];
    state.frame = frame;
    state.count = 0;
    state.present.fill(0);
    for (let slot = 0; slot < slots; slot++) {
      if ((data.getUint8(nodes + (slot >> 3)) >> (slot & 7)) & 1) {
        state.present[slot] = 1;
        state.slots[state.count++] = slot;
      }
    }
    const ranges = nodes + ((slots + 7) >> 3);
    let at = ranges + 32;
    for (const [axis, values] of [state.x, state.y, state.z, state.scalar].entries()) {
      const min = data.getFloat32(ranges + 4 * axis, true);
      const steps = axis === 3 ? 65534 : 65535;
      const scale = (data.getFloat32(ranges + 16 + 4 * axis, true) - min) / steps;
      for (let i = 0; i < state.count; i++, at += 2) {
        const q = data.getUint16(at, true);
        values[state.slots[i]] = q > steps ? NaN : min + q * scale;
      }
    }
  }

  /** Fills `pairs` with the slots of the links of a frame, two for each; returns the number of links. */
  readLinks(frame, pairs) {
    const { linkA, linkB, linkStart, linkEnd, blockEnd } = this;
    let count = 0;
    for (let i = 0; i < linkA.length && linkStart[i] <= frame; i++) {
      if (i % BLOCK === 0 && blockEnd[i / BLOCK] <= frame) {
        i += BLOCK - 1;
      } else if (linkEnd[i] > frame) {
        pairs[2 * count] = linkA[i];
        pairs[2 * count + 1] = linkB[i];
        count++;
      }
    }
    return count;
  }

  readFrames(start) {
    const { data } = this;
    const intervals = { a: [], b: [], start: [], end: [] };
    const open = new Map(); // link -> its interval that has no end yet
    let at = start;
    for (let length; (length = data.getUint32(at, true)) !== 0; at += 4 + length) {
      this.readFrame(at + 4, at + 4 + length, intervals, open);
    }
    if (at + 4 !== data.byteLength) throw new Error('bytes after the end');
    if (this.count === 0) throw new ReplayError('The recording holds no frame.');
    for (const interval of open.values()) intervals.end[interval] = this.count;
    this.linkA = Int32Array.from(intervals.a);
    this.linkB = Int32Array.from(intervals.b);
    this.linkStart = Int32Array.from(intervals.start);
    this.linkEnd = Int32Array.from(intervals.end);
    this.blockEnd = new Int32Array(Math.ceil(this.linkA.length / BLOCK));
    this.linkEnd.forEach((end, i) => {
      const block = Math.floor(i / BLOCK);
      this.blockEnd[block] = Math.max(this.blockEnd[block], end);
    });
  }

  readFrame(start, end, intervals, open) {
    const { data, ids } = this;
    const frame = this.count;
    const time = data.getFloat64(start, true);
    if (!(time > (this.times[frame - 1] ?? -Infinity))) throw new Error(`frame ${frame} is out of order`);
    const newIds = data.getUint32(start + 8, true);
    let at = start + 12;
    for (let i = 0; i < newIds; i++, at += 4) ids.push(data.getInt32(at, true));
    this.times.push(time);
    this.frames.push({ nodes: at, slots: ids.length });

    let present = 0;
    for (let i = 0; i < (ids.length + 7) >> 3; i++, at++) {
      for (let bits = data.getUint8(at); bits !== 0; bits &= bits - 1) present++;
    }
    const scalars = at + 32 + 6 * present;
    let valued = 0;
    for (let i = 0; i < present; i++) if (data.getUint16(scalars + 2 * i, true) !== 65535) valued++;
    if (valued < present) this.someWithoutScalar = true;
    if (valued > 0) {
      this.scalarMin = Math.min(this.scalarMin, data.getFloat32(at + 12, true));
      this.scalarMax = Math.max(this.scalarMax, data.getFloat32(at + 28, true));
    }
    at += 32 + 8 * present;

    at = this.readPairs(at, (key) => {
      intervals.end[open.get(key)] = frame;
      if (!open.delete(key)) throw new Error(`frame ${frame} removes a link that is not there`);
    });
    at = this.readPairs(at, (key, a, b) => {
      if (b >= ids.length) throw new Error(`frame ${frame} links a node that is not there`);
      open.set(key, intervals.a.length);
      intervals.a.push(a);
      intervals.b.push(b);
      intervals.start.push(frame);
      intervals.end.push(0);
    });
    this.maxLinks = Math.max(this.maxLinks, open.size);
    if (at !== end) throw new Error(`frame ${frame} has a wrong length`);
  }

  readPairs(start, each) {
    const { data } = this;
    let at = start + 4;
    const varint = () => {
      for (let value = 0, unit = 1; ; unit *= 128) {
        const part = data.getUint8(at++);
        value += (part & 127) * unit;
        if (part < 128) return value;
      }
    };
    let a = -1;
    let b = 0;
    for (let left = data.getUint32(start, true); left > 0; left--) {
      const step = varint();
      a += step;
      b = (step === 0 ? b : a) + varint();
      each(a * 0x4000000 + b, a, b);
    }
    return at;
  }
}
