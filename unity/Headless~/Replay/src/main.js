// Joins the recording, the view and the controls, and offers `window.replay` to scripts.
import { ColourScale, gradient, NO_VALUE } from './colours.js';
import { decode, NodeState } from './recording.js';
import { View } from './view.js';

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8];
const READABLE_PIXELS = 4; // a node's radius at first sight, in pixels, at least
const element = (id) => document.getElementById(id);

class Player {
  constructor(recording) {
    this.recording = recording;
    const slots = recording.ids.length;
    this.state = new NodeState(slots);
    this.next = new NodeState(slots);
    this.positions = new Float32Array(3 * slots);
    this.pairs = new Int32Array(2 * recording.maxLinks);
    this.linkCount = 0;
    this.linkFrame = -1;
    this.time = recording.times[0];
    this.speed = 1;
    this.playing = false;
    this.linksVisible = true;
    this.selected = -1;

    const { metadata } = recording;
    const { min = recording.scalarMin, max = recording.scalarMax } = metadata.scalar;
    this.scale = new ColourScale(min, max);
    this.view = new View(element('canvas'), element('labels'), metadata, slots, recording.maxLinks);
    this.view.onFrame = (now) => this.tick(now);
    this.fillLegend(min, max);
    this.bind();
    this.resize();
    this.setFactor(Math.min(Math.max(Math.ceil((4 * READABLE_PIXELS) / this.view.nodePixels) / 4, 1), 3));
  }

  get frame() {
    return this.state.frame;
  }

  get lastTime() {
    return this.recording.times[this.recording.count - 1];
  }

  /** Shows the moment `time`: nodes between two frames are drawn between their places, everything else is the earlier frame's. */
  show(time) {
    const { recording } = this;
    this.time = Math.min(Math.max(time, recording.times[0]), this.lastTime);
    const frame = recording.frameAt(this.time);
    if (this.state.frame !== frame) {
      if (this.next.frame === frame) [this.state, this.next] = [this.next, this.state];
      else recording.readNodes(frame, this.state);
    }
    const share = frame + 1 < recording.count ? (this.time - recording.times[frame]) / (recording.times[frame + 1] - recording.times[frame]) : 0;
    if (share > 0 && this.next.frame !== frame + 1) recording.readNodes(frame + 1, this.next);
    this.place(share);
    if (this.linkFrame !== frame) {
      this.linkCount = recording.readLinks(frame, this.pairs);
      this.linkFrame = frame;
    }
    this.refresh();
  }

  place(share) {
    const { state, next, positions } = this;
    for (let i = 0; i < state.count; i++) {
      const slot = state.slots[i];
      const part = share > 0 && next.present[slot] ? share : 0;
      positions[3 * slot] = state.x[slot] + (part && part * (next.x[slot] - state.x[slot]));
      positions[3 * slot + 1] = state.y[slot] + (part && part * (next.y[slot] - state.y[slot]));
      positions[3 * slot + 2] = state.z[slot] + (part && part * (next.z[slot] - state.z[slot]));
    }
  }

  refresh() {
    const { state, view } = this;
    const selected = this.selected >= 0 && state.present[this.selected] ? this.selected : -1;
    view.show({
      count: state.count, slots: state.slots, positions: this.positions, scalars: state.scalar, scale: this.scale,
      pairs: this.pairs, linkCount: this.linkCount, linksVisible: this.linksVisible, selected, factor: this.factor,
    });
    const total = this.recording.count;
    element('scrub').value = state.frame;
    element('scrub').setAttribute('aria-valuetext', `${this.time.toFixed(1)} seconds`);
    element('position').value = `${this.time.toFixed(1)} / ${this.lastTime.toFixed(1)} s · frame ${state.frame + 1} / ${total}`;
    element('clock').textContent = `t = ${this.time.toFixed(1)} s`;
    element('node-count').textContent = plural(state.count, 'node');
    element('link-count').textContent = plural(this.linkCount, 'link');
    this.describeSelection();
  }

  describeSelection() {
    element('selection').hidden = this.selected < 0;
    if (this.selected < 0) return;
    const { selected, state, positions } = this;
    const { ids, metadata } = this.recording;
    element('selected-name').textContent = `Node ${ids[selected]}`;
    const here = state.present[selected] === 1;
    const value = state.scalar[selected];
    const told = Number.isNaN(value) ? 'has no value' : withUnit(value, metadata);
    element('selected-scalar').textContent = here ? `${metadata.scalar.name} ${told}` : 'not there at this time';
    element('selected-position').textContent = here ? `at ${[0, 1, 2].map((axis) => positions[3 * selected + axis].toFixed(2)).join(', ')} m` : '';
    const neighbours = here ? this.neighbours(selected) : [];
    const listed = neighbours.length ? `: ${neighbours.join(', ')}` : '';
    element('selected-neighbours').textContent = here ? `${plural(neighbours.length, 'neighbour')}${listed}` : '';
  }

  neighbours(slot) {
    const found = [];
    for (let i = 0; i < 2 * this.linkCount; i += 2) {
      if (this.pairs[i] === slot) found.push(this.recording.ids[this.pairs[i + 1]]);
      else if (this.pairs[i + 1] === slot) found.push(this.recording.ids[this.pairs[i]]);
    }
    return found.sort((a, b) => a - b);
  }

  tick(now) {
    if (!this.playing) return;
    const passed = Math.min((now - this.lastTick) / 1000, 0.25); // a sleeping tab must not jump
    this.lastTick = now;
    this.show(this.time + passed * this.speed);
    if (this.time >= this.lastTime) this.pause();
  }

  seek(frame) {
    this.show(this.recording.times[Math.min(Math.max(Math.round(frame), 0), this.recording.count - 1)]);
  }

  play() {
    if (this.playing) return;
    if (this.time >= this.lastTime) this.seek(0);
    this.lastTick = performance.now();
    this.setPlaying(true);
    this.view.request();
  }

  pause() {
    this.setPlaying(false);
  }

  setPlaying(playing) {
    this.playing = playing;
    document.body.classList.toggle('playing', playing);
    element('play').setAttribute('aria-label', playing ? 'Pause' : 'Play');
  }

  setSpeed(speed) {
    if (!SPEEDS.includes(speed)) throw new RangeError(`speed ${speed}: one of ${SPEEDS.join(', ')}`);
    this.speed = speed;
    element('speed').value = String(speed);
  }

  setLinks(visible) {
    this.linksVisible = visible;
    element('links').checked = visible;
    this.refresh();
  }

  setFactor(factor) {
    this.factor = factor;
    element('factor').value = factor;
    element('factor-text').value = `${factor}×`;
    element('scales').textContent = `Grid ${this.view.gridStep} m · nodes drawn ${factor === 1 ? 'at real size' : `${factor}× real size`}`;
    this.show(this.time);
  }

  select(slot) {
    this.selected = slot;
    element('find').value = slot < 0 ? '' : this.recording.ids[slot];
    this.refresh();
  }

  selectId(id) {
    this.select(this.recording.slotOfId.get(id) ?? -1);
  }

  fillLegend(min, max) {
    const { metadata, count, ids } = this.recording;
    document.title = metadata.title;
    element('title').textContent = metadata.title;
    element('title').title = `seed ${metadata.seed}, ${plural(ids.length, 'node')} in all`;
    element('scalar-name').textContent = metadata.scalar.name + (metadata.scalar.unit ? ` (${metadata.scalar.unit})` : '');
    element('gradient').style.background = gradient;
    element('ticks').replaceChildren(...[min, (min + max) / 2, max].map((value) => {
      const tick = document.createElement('span');
      tick.textContent = short(value);
      return tick;
    }));
    element('no-value').querySelector('i').style.background = NO_VALUE;
    element('no-value').hidden = !this.recording.someWithoutScalar;
    element('scrub').max = count - 1;
  }

  resize() {
    const picture = document.body.classList.contains('picture');
    const controls = element('controls').getBoundingClientRect();
    this.view.resize(window.innerWidth, window.innerHeight, { top: 28, bottom: picture ? 16 : window.innerHeight - controls.top });
  }

  /** Hides what can be pressed, for pictures. */
  setControls(visible) {
    document.body.classList.toggle('picture', !visible);
    this.resize();
  }

  bind() {
    element('play').addEventListener('click', () => (this.playing ? this.pause() : this.play()));
    element('scrub').addEventListener('input', (event) => {
      this.pause();
      this.seek(Number(event.target.value));
    });
    element('speed').addEventListener('change', (event) => this.setSpeed(Number(event.target.value)));
    element('links').addEventListener('change', (event) => this.setLinks(event.target.checked));
    element('factor').addEventListener('input', (event) => this.setFactor(Number(event.target.value)));
    element('find').addEventListener('change', (event) => {
      const slot = event.target.value === '' ? -1 : this.recording.slotOfId.get(Number(event.target.value));
      event.target.setCustomValidity(slot === undefined ? 'No node of this run has that id.' : '');
      if (event.target.reportValidity()) this.select(slot);
    });
    element('deselect').addEventListener('click', () => this.select(-1));
    element('view-above').addEventListener('click', () => this.view.frame('above'));
    element('view-top').addEventListener('click', () => this.view.frame('top'));
    element('help').addEventListener('click', (event) => {
      const keys = element('keys');
      keys.hidden = !keys.hidden;
      event.target.setAttribute('aria-expanded', String(!keys.hidden));
    });
    this.bindPicking(element('canvas'));
    window.addEventListener('resize', () => this.resize());
    window.addEventListener('keydown', (event) => this.onKey(event));
    const dark = matchMedia('(prefers-color-scheme: dark)');
    const theme = () => this.view.setTheme(dark.matches ? 'dark' : 'light');
    dark.addEventListener('change', theme);
    theme();
  }

  bindPicking(canvas) {
    let down = null;
    canvas.addEventListener('pointerdown', (event) => {
      down = event.isPrimary && event.button === 0 ? { x: event.clientX, y: event.clientY } : null;
    });
    canvas.addEventListener('pointerup', (event) => {
      // A click, not the end of a turn.
      if (!down || Math.hypot(event.clientX - down.x, event.clientY - down.y) > 4) return;
      const { count, slots } = this.state;
      this.select(this.view.pick(event.clientX, event.clientY, { count, slots, positions: this.positions, factor: this.factor }));
    });
  }

  onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { target } = event;
    if (target.matches('select, input[type="number"]')) return;
    if (target.matches('input[type="range"]') && /^(Arrow|Home|End|Page)/.test(event.key)) return;
    if (target.matches('button, input[type="checkbox"]') && (event.key === ' ' || event.key === 'Enter')) return;
    const turn = 0.08;
    const actions = {
      ' ': () => (this.playing ? this.pause() : this.play()),
      ArrowLeft: () => this.step(event.shiftKey ? -10 : -1),
      ArrowRight: () => this.step(event.shiftKey ? 10 : 1),
      Home: () => this.seek(0),
      End: () => this.seek(this.recording.count - 1),
      ',': () => this.changeSpeed(-1),
      '.': () => this.changeSpeed(1),
      l: () => this.setLinks(!this.linksVisible),
      r: () => this.view.frame('above'),
      t: () => this.view.frame('top'),
      a: () => this.view.turn(-turn, 0, 1),
      d: () => this.view.turn(turn, 0, 1),
      w: () => this.view.turn(0, turn, 1),
      s: () => this.view.turn(0, -turn, 1),
      '+': () => this.view.turn(0, 0, 0.9),
      '=': () => this.view.turn(0, 0, 0.9),
      '-': () => this.view.turn(0, 0, 1 / 0.9),
      Escape: () => this.select(-1),
    };
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  step(frames) {
    this.pause();
    this.seek(this.frame + frames);
  }

  changeSpeed(by) {
    const at = SPEEDS.indexOf(this.speed) + by;
    if (at >= 0 && at < SPEEDS.length) this.setSpeed(SPEEDS[at]);
  }
}

function plural(count, noun) {
  return `${count.toLocaleString('en')} ${noun}${count === 1 ? '' : 's'}`;
}

function short(value) {
  return Number(value.toPrecision(4)).toLocaleString('en', { maximumSignificantDigits: 4 });
}

function withUnit(value, metadata) {
  return short(value) + (metadata.scalar.unit ? ` ${metadata.scalar.unit}` : '');
}

function showMessage(text) {
  element('message-text').textContent = text;
  element('message').hidden = false;
  for (const id of ['summary', 'legend', 'controls']) element(id).hidden = true;
}

async function start() {
  const holder = element('replay');
  const recording = await decode(holder.textContent);
  holder.remove(); // the text is of no more use, and large
  const probe = document.createElement('canvas');
  if (!probe.getContext('webgl2')) {
    throw new Error('This browser shows no 3D graphics (WebGL 2). Switch on hardware acceleration in its settings, or open the page in another browser.');
  }
  return new Player(recording);
}

const started = start();
const ready = started.then(
  (player) => {
    const { recording } = player;
    Object.assign(window.replay, {
      frames: recording.count,
      metadata: recording.metadata,
      seek: (frame) => player.seek(frame),
      play: () => player.play(),
      pause: () => player.pause(),
      setSpeed: (speed) => player.setSpeed(speed),
      setLinks: (visible) => player.setLinks(visible),
      setNodeSize: (factor) => player.setFactor(factor),
      setControls: (visible) => player.setControls(visible),
      select: (id) => player.selectId(id),
      view: (from) => player.view.frame(from),
      /** The frame on show, in Unity's axes, as recorded. */
      state: () => {
        const { state, pairs, linkCount } = player;
        const { ids } = recording;
        return {
          frame: state.frame,
          time: player.time,
          playing: player.playing,
          nodes: Array.from(state.slots.subarray(0, state.count), (s) => ({
            id: ids[s], x: state.x[s], y: state.y[s], z: state.z[s], scalar: state.scalar[s],
          })),
          links: Array.from({ length: linkCount }, (_, i) => [ids[pairs[2 * i]], ids[pairs[2 * i + 1]]]),
        };
      },
      /** Draws the frame on show now, for a picture right after. */
      draw: () => {
        player.view.draw();
        if (player.playing) player.view.request();
      },
    });
  },
  (error) => {
    showMessage(error.message);
    throw error;
  },
);
ready.catch(() => {}); // said on the page
window.replay = { ready };
