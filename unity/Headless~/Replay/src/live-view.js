// The view of the live page, which shows a running simulation. The page that contains it passes the events on to it.
import { palettesOf } from './colours.js';
import { element, part } from './dom.js';
import { LiveRecording } from './live-recording.js';
import { Player, plural, requireGraphics, showMessage } from './player.js';
import { Run } from './run.js';
import { commandsOf } from './scripting.js';

const SLOW_MS = 60; // from the request for a picture to its drawing
const CHART_MS = 1000; // between two drawings of the charts

class LivePlayer extends Player {
  constructor(recording, send) {
    super(recording);
    this.send = send;
    this.arrived = performance.now();
    this.interval = 100; // milliseconds between frames
    this.charted = 0;
    this.hasNewRow = false; // since the last drawing of the charts
    this.adding = 0; // nodes that a click adds
    document.title = `${recording.metadata.title}, live`;
  }

  /** Shows another recording, after a restart or when the current view does not have room for all nodes. */
  adopt(recording) {
    const [{ view: old, recording: { metadata } }] = this.runs;
    const isSame = metadata.title === recording.metadata.title;
    const holder = old.holder.cloneNode(true);
    holder.querySelector('.labels').replaceChildren();
    old.holder.after(holder);
    const run = new Run(recording, holder);
    this.runs = [run];
    this.described = null;
    run.view.setTheme(this.theme);
    this.bindView();
    this.bindPicking(run);
    const { name } = this.legend.field;
    this.legend.frame = null;
    this.legend.setFields(this.fields);
    this.resize();
    if (isSame) run.view.lookAs(old);
    old.dispose();
    this.legend.choose(Math.max(this.fields.findIndex((field) => field.name === name), 0));
    this.drawCharts();
    if (!isSame) {
      this.describeRun();
      this.hasOwnRange = false;
      this.selected = null;
    }
    this.show(recording.times.at(-1));
  }

  /** Adds a frame, and moves the picture to it until the next frame is expected. */
  add(event, bytes) {
    const { recording } = this;
    const now = performance.now();
    const isNew = !(event.time <= recording.times.at(-1));
    if (!isNew) recording.replaceLast(event, bytes);
    const widened = isNew && recording.add(event, bytes);
    if (isNew) {
      this.interval = Math.min(Math.max(0.7 * this.interval + 0.3 * (now - this.arrived), 16), 400);
      this.arrived = now;
    }
    if (widened) this.widen();
    if (this.playing !== event.running) this.setPlaying(event.running);
    if (element('speed').value !== String(event.speed)) element('speed').value = String(event.speed);
    this.speed = event.speed;
    this.hasNewRow ||= Boolean(event.metrics);
    // A pause must not hide the last rows.
    if (this.hasNewRow && !element('charts').hidden && (now - this.charted > CHART_MS || !event.running)) this.redrawCharts(now);
    this.describeInspection(event.node);
    if (!this.resting) this.showNow(now);
  }

  /** Extends the colours to all values so far. */
  widen() {
    this.recording.fields.forEach(({ least, greatest }, i) => Object.assign(this.fields[i], { least, greatest }));
    const { legend } = this;
    if (palettesOf(legend.field)[0] !== element('palette').options[0]?.value) legend.choose(this.fields.indexOf(legend.field));
    else if (legend.field.kind === 'category') legend.colour();
    else if (!this.hasOwnRange) legend.setRange(...legend.wholeRange());
  }

  redrawCharts(now) {
    this.charted = now;
    this.hasNewRow = false;
    const { scrollTop } = element('charts');
    this.drawCharts();
    element('charts').scrollTop = scrollTop;
    this.resize();
  }

  /** Called before each picture. If drawing is slow, pauses between pictures, and shows only the times of recorded frames. */
  tick(now) {
    const latency = now - this.requested;
    this.isSlow = latency > SLOW_MS;
    if (!this.isSlow) this.showNow(now);
    else if (!this.resting) {
      this.resting = true;
      setTimeout(() => {
        this.resting = false;
        this.showNow(performance.now());
      }, latency);
    }
  }

  /** Shows the current time, which requests the next picture. Does nothing if the time is already shown. */
  showNow(now) {
    const { times, frames } = this.recording;
    const last = times.length - 1;
    const share = last === 0 || !this.playing || this.isSlow ? 1 : Math.min((now - this.arrived) / this.interval, 1);
    const time = last === 0 ? times[0] : times[last - 1] + share * (times[last] - times[last - 1]);
    if (time === this.shownTime && frames[last] === this.shownFrame) return;
    [this.shownTime, this.shownFrame] = [time, frames[last]];
    this.show(time);
    this.requested = performance.now();
  }

  describeTime() {
    const { tick, speed, running } = this.recording.latest;
    element('position').value = `tick ${tick.toLocaleString('en')} · ${running ? `real time × ${speed}` : 'paused'}`;
  }

  describeInspection(node) {
    const rows = (title, list) => (list.length === 0 ? [] : [part('dt', title), part('dd', ''), ...list.flatMap(([name, value]) => [
      part('dt', name || 'value'), part('dd', value)])]);
    const shown = node && node.id === this.selected ? node : null;
    element('inspection').hidden = !shown;
    if (!shown) return;
    const { state, roundMicros } = shown;
    const known = roundMicros > 0 ? [['duration', `${roundMicros.toLocaleString('en', { maximumSignificantDigits: 3 })} µs`]] : [];
    element('inspection').replaceChildren(
      ...rows('Sensors', shown.sensors), ...rows('Answer', shown.answer), ...rows('Last round', known),
      ...rows('State', state ? (state.length > 0 ? state : [['', 'empty']]) : [['', 'after the next tick']]),
      ...rows('Receives from', shown.links.length > 0 ? shown.links : [['', 'no node']]), ...(shown.error ? rows('Last error', [['', shown.error]]) : []));
    for (const term of element('inspection').children) if (term.nextSibling?.textContent === '' && term.tagName === 'DT') term.className = 'group';
  }

  async showHistory() {} // frames before the page was opened are unknown

  select(id) {
    super.select(id);
    this.send({ select: id });
  }

  play() {
    this.send({ run: true });
    this.setPlaying(true);
  }

  pause() {
    this.send?.({ run: false });
    this.setPlaying(false);
  }

  step(ticks) {
    if (ticks > 0) this.send({ step: ticks });
  }

  seek() {}

  setSpeed(speed) {
    super.setSpeed(speed);
    this.send?.({ speed });
  }

  showCharts(visible) {
    super.showCharts(visible);
    if (visible) this.drawCharts();
    element('charts-shown').hidden = false;
  }

  bind() {
    super.bind();
    for (const id of ['range-min', 'range-max', 'fit']) element(id).addEventListener('click', () => { this.hasOwnRange = true; });
    element('whole-range').addEventListener('click', () => { this.hasOwnRange = false; });
    const inspection = part('dl', '');
    inspection.id = 'inspection';
    const remove = part('button', 'Remove node');
    remove.addEventListener('click', () => this.send({ remove: this.selected }));
    element('selected-values').after(inspection, remove);
  }

  bindPicking(run) {
    super.bindPicking(run);
    run.view.canvas.addEventListener('click', (event) => {
      if (this.adding > 0) this.send({ add: this.adding, at: run.view.floorAt(event.offsetX, event.offsetY) });
    });
  }

  describeRun() {
    super.describeRun();
    element('title').title = `seed ${this.recording.metadata.seed}, ${plural(this.recording.nodes, 'node')}`;
  }
}

/** Passes events of the simulation to the view. `send` sends a command to the simulation. */
export function connect(send) {
  let player = null;
  let pending = null; // a recording without frames
  let hasFailed = false;
  return {
    header(header) {
      if (player && !header.restarted && player.recording.fits(header)) return;
      pending = new LiveRecording(header);
    },
    frame(event, bytes) {
      if (hasFailed) return;
      try {
        if (pending) {
          pending.add(event, bytes);
          if (player) player.adopt(pending);
          else {
            requireGraphics();
            player = new LivePlayer(pending, send);
            Object.assign(window.replay, commandsOf(player), { player });
          }
          pending = null;
        }
        player.add(event, bytes);
      } catch (error) {
        hasFailed = true;
        showMessage(error.message);
        throw error;
      }
    },
    /** Returns a point in the middle of the view. */
    get centre() {
      const { x, y, z } = player.view.controls.target;
      return [x, y, -z];
    },
    setAdding(count) {
      player.adding = count;
      element('canvas').style.cursor = count > 0 ? 'copy' : '';
    },
    command: (name) => document.getElementById(name).click(),
  };
}

document.body.classList.add('live');
window.replay = { connect };
window.parent.live?.attach(window.replay);
