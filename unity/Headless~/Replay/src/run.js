// A recording with the view that shows it.
import { fieldsOf, slotOf, textOf } from './fields.js';
import { View } from './view.js';

export class Run {
  /** Draws in `holder`, an element of the class `side`. */
  constructor(recording, holder) {
    this.recording = recording;
    this.fields = fieldsOf(recording);
    this.view = new View(holder, recording);
    this.here = null; // the current frame
    this.trails = null; // the nodes and frames of the current trails
  }

  get lastTime() {
    return this.recording.times.at(-1);
  }

  /** Loads the frames that are needed to show a time. */
  load(time) {
    const { recording } = this;
    const frame = recording.frameAt(time);
    return Promise.all([recording.load(frame), recording.load(Math.min(frame + 1, recording.count - 1))]);
  }

  /** Shows a time if its frames are loaded, and returns whether they are. `id` is the selected node. For the other parameters, see `View.show`. */
  show(time, id, { trails, ...how }) {
    const { recording, view } = this;
    const { times } = recording;
    const frame = recording.frameAt(time);
    const last = recording.count - 1;
    const here = recording.frame(frame);
    const next = recording.frame(Math.min(frame + 1, last));
    if (!here || !next) return false;
    // Preloads the next frames for playback.
    if (this.here !== here) for (const near of [frame, frame + 1, frame + recording.framesPerSegment]) recording.load(Math.min(near, last)).catch(() => {});
    this.here = here;
    const share = here === next ? 0 : Math.max((time - times[frame]) / (times[frame + 1] - times[frame]), 0);
    const selected = slotOf(here, id);
    view.show({ here, next, share, selected, ...how });
    this.showTrails(trails, selected);
    return true;
  }

  showTrails(visible, selected) {
    const slots = visible ? (selected >= 0 ? [selected] : this.here.slots) : [];
    const wanted = `${visible} ${this.here.index} ${selected}`;
    if (wanted === this.trails) return;
    this.trails = wanted;
    this.view.swarm.trails.show(this.recording, this.here, slots, () => {
      if (this.trails !== wanted) return;
      this.trails = null;
      this.showTrails(visible, selected);
      this.view.request();
    });
  }

  /** Returns the current value of a field at a node, as text. */
  textAt({ name }, id) {
    const field = this.fields.find((each) => each.name === name);
    return field ? textOf(field, field.valuesOf(this.here)[slotOf(this.here, id)] ?? NaN) : 'no value';
  }

  /** Colours the nodes by a field, if the run has it. */
  colour({ name }, colourOf) {
    const field = this.fields.find((each) => each.name === name);
    this.view.swarm.setColours((frame) => {
      const values = field?.valuesOf(frame);
      return (slot) => colourOf(values ? values[slot] : NaN);
    });
  }
}
