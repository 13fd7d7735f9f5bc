// The last frames of a running simulation, with the interface of a recording. They need not be consecutive.
import { extent, lastAt } from './fields.js';
import { Segment } from './recording.js';

const KEPT_FRAMES = 300;
const KEPT_ROWS = 600; // of metrics
const COLOURED_CATEGORIES = 256; // as in a replay

export class LiveRecording {
  /** `header` is the header of FORMAT.md without frames. Its metrics are only names. */
  constructor(header) {
    Object.assign(this, header);
    this.times = [];
    this.frames = [];
    this.poses = []; // by frame and moving shape
    this.metrics = { times: [], series: header.metrics.map((name) => ({ name, values: [] })) };
    this.movers = header.movers.map(({ shape }, i) => ({ shape, poses: { slice: (from) => this.poses[from / 7]?.[i] ?? [0, 0, 0, 0, 0, 0, 1] } }));
    for (const field of this.fields) [field.least, field.greatest] = [0, 0];
  }

  /** Returns whether the view of this recording can show frames with the given header. */
  fits(header) {
    const shape = ({ metadata, slots, fields, metrics, movers }) => JSON.stringify(
      [{ ...metadata, arena: null }, slots, fields.map(({ name, kind, words }) => [name, kind, words]), metrics.series?.map(({ name }) => name) ?? metrics,
        movers.map((mover) => mover.shape)]);
    return shape(this) === shape(header);
  }

  get count() {
    return this.times.length;
  }

  get oldest() {
    return Math.max(this.count - KEPT_FRAMES, 0);
  }

  get nodes() {
    return this.frames.at(-1)?.slots.length ?? 0;
  }

  has(id) {
    const frame = this.frames.at(-1);
    return frame.slots.some((slot) => frame.ids[slot] === id);
  }

  /** Adds a frame. Returns whether a field has got a wider range or more categories. */
  add(event, bytes) {
    const { time, metrics, poses } = event;
    this.latest = event;
    const index = this.count;
    const frame = new Segment(bytes, this, index, 1).frame(0);
    this.times.push(time);
    const first = this.oldest;
    frame.segment = { first, count: index + 1 - first, frame: (i) => this.frames[first + i] };
    this.frames.push(frame);
    this.poses.push(poses.some((pose) => pose.length > 0) ? poses : this.poses.at(-1) ?? []);
    for (const old of [this.frames, this.poses]) delete old[index - KEPT_FRAMES];
    if (metrics) this.addMetrics(metrics);
    return this.widen(frame);
  }

  /** Replaces the last frame, for a paused simulation whose data has changed. */
  replaceLast(event, bytes) {
    this.latest = event;
    const index = this.count - 1;
    const frame = new Segment(bytes, this, index, 1).frame(0);
    frame.segment = this.frames[index].segment;
    this.frames[index] = frame;
  }

  addMetrics([time, ...values]) {
    const { times, series } = this.metrics;
    times.push(time);
    series.forEach((each, i) => each.values.push(values[i]));
    if (times.length > KEPT_ROWS) for (const list of [times, ...series.map((each) => each.values)]) list.shift();
  }

  widen(frame) {
    let widened = false;
    this.fields.forEach((field, i) => {
      const present = Array.from(frame.slots, (slot) => frame.values[i][slot]).filter((value) => !Number.isNaN(value));
      if (field.kind === 'category') {
        const more = [...new Set(present)].filter((value) => !field.order.includes(value)).slice(0, COLOURED_CATEGORIES - field.order.length);
        field.order.push(...more);
        widened ||= more.length > 0;
      }
      if (field.kind !== 'number') return;
      if (present.length === 0) return;
      const { least, greatest } = extent(present);
      const isFirst = !field.known;
      const margin = 0.1 * (field.greatest - field.least);
      if (!isFirst && least >= field.least && greatest <= field.greatest) return;
      // The range grows in large steps, so that it does not change at each frame.
      field.least = isFirst ? least : Math.min(field.least, least - (least < field.least ? margin : 0));
      field.greatest = isFirst ? greatest : Math.max(field.greatest, greatest + (greatest > field.greatest ? margin : 0));
      field.known = true;
      widened = true;
    });
    return widened;
  }

  frameAt(time) {
    return Math.max(lastAt(this.times, time), this.oldest);
  }

  frame(index) {
    return this.frames[index] ?? null;
  }

  load() {
    return Promise.resolve();
  }
}
