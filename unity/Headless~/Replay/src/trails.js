// Draws trails of nodes. A trail is a line through earlier positions, which fades with age.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, LineSegments, Sphere } from 'three';

const SECONDS = 3;
const MAX_PIECES = 60000;

export class Trails {
  constructor(material) {
    this.object = new LineSegments(new BufferGeometry(), material);
    this.object.geometry.boundingSphere = new Sphere(); // never culled
    this.object.geometry.setDrawRange(0, 0);
    this.object.renderOrder = 1;
  }

  /** Draws the trails of some slots up to a frame. If frames are missing, loads them and then calls `again`. */
  show(recording, frame, slots, again) {
    const pieces = slots.length === 0 ? 0 : Math.floor(MAX_PIECES / slots.length);
    const first = Math.max(recording.frameAt(recording.times[frame.index] - SECONDS), frame.index - pieces, 0);
    const frames = [];
    for (let i = first; i <= frame.index; i++) frames.push(recording.frame(i));
    if (slots.length > 0 && frames.includes(null)) {
      // The trails span at most two segments.
      Promise.all([recording.load(first), recording.load((first + frame.index) >> 1)]).then(again, () => {}); // reported on the page
    }
    this.draw(frames, slots);
  }

  draw(frames, slots) {
    const { geometry } = this.object;
    const needed = 2 * slots.length * Math.max(frames.length - 1, 0);
    if (needed > (geometry.getAttribute('position')?.count ?? 0)) {
      geometry.dispose();
      for (const [name, size] of [['position', 3], ['color', 4]]) {
        geometry.setAttribute(name, new BufferAttribute(new Float32Array(size * needed), size).setUsage(DynamicDrawUsage));
      }
    }
    geometry.setDrawRange(0, needed && this.fill(frames, slots));
  }

  fill(frames, slots) {
    const [places, colours] = ['position', 'color'].map((name) => this.object.geometry.getAttribute(name));
    const { ids } = frames.at(-1);
    let count = 0;
    for (let i = 1; i < frames.length; i++) {
      const [from, to] = [frames[i - 1], frames[i]];
      if (!from || !to) continue;
      for (const slot of slots) {
        if (!from.present[slot] || !to.present[slot] || from.ids[slot] !== ids[slot] || to.ids[slot] !== ids[slot]) continue;
        [from, to].forEach((end, which) => {
          places.setXYZ(count, end.places[4 * slot], end.places[4 * slot + 1], -end.places[4 * slot + 2]);
          colours.setXYZW(count++, 1, 1, 1, (i - 1 + which) / (frames.length - 1));
        });
      }
    }
    places.needsUpdate = true;
    colours.needsUpdate = true;
    return count;
  }
}
