// Joins the recording, the view and the controls, and offers `window.replay` to scripts.
import { ColourScale, gradient, NO_VALUE } from './colours.js';
import { open } from './recording.js';
import { View } from './view.js';

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8];
const READABLE_PIXELS = 4; // a node's radius at first sight, in pixels, at least
const element = (id) => document.getElementById(id);

class Player {
  constructor(recording) {
    this.recording = recording;
    this.here = null; // the frame on show
    this.waits = 0;
    this.time = recording.times[0];
    this.speed = 1;
    this.playing = false;
    this.linksVisible = true;
    this.selected = -1;

    const { metadata } = recording;
    const { min = recording.scalarMin, max = recording.scalarMax } = metadata.scalar;
    const scale = new ColourScale(min, max);
    this.view = new View(element('canvas'), element('labels'), metadata, recording.ids.length, recording.maxLinks, scale);
    this.view.onFrame = (now) => this.tick(now);
    this.fillLegend(min, max);
    this.bind();
    this.resize();
    this.setFactor(Math.min(Math.max(Math.ceil((4 * READABLE_PIXELS) / this.view.nodePixels) / 4, 1), 3));
  }

  get lastTime() {
    return this.recording.times[this.recording.count - 1];
  }

  /**
   * Shows the moment `time`: nodes between two frames are drawn between their places, everything else is the earlier frame's. The promise
   * is fulfilled when it is on show, or a later wish is.
   */
  show(time) {
    this.time = Math.min(Math.max(time, this.recording.times[0]), this.lastTime);
    if (this.refresh()) return undefined;
    const arrival = this.arrive(this.time);
    arrival.catch(() => {}); // said on the page
    return arrival;
  }

  async arrive(time) {
    const { recording } = this;
    const frame = recording.frameAt(time);
    this.waits++;
    try {
      await Promise.all([recording.load(frame), recording.load(Math.min(frame + 1, recording.count - 1))]);
      if (this.time === time) this.refresh();
    } catch (error) {
      this.pause();
      showMessage(error.message);
      throw error;
    } finally {
      this.waits--;
    }
  }

  /** Shows this moment if its frames are there. */
  refresh() {
    const { recording, view } = this;
    const frame = recording.frameAt(this.time);
    const last = recording.count - 1;
    const here = recording.frame(frame);
    const next = recording.frame(Math.min(frame + 1, last));
    if (!here || !next) return false;
    // What plays on finds its frames there.
    if (this.here !== here) for (const near of [frame, frame + 1, frame + recording.framesPerSegment]) recording.load(Math.min(near, last)).catch(() => {});
    this.here = here;
    const share = here === next ? 0 : (this.time - recording.times[frame]) / (recording.times[frame + 1] - recording.times[frame]);
    const selected = this.selected >= 0 && here.present[this.selected] ? this.selected : -1;
    view.show({ here, next, share, linksVisible: this.linksVisible, selected, factor: this.factor });
    const links = here.pairs.length / 2;
    element('scrub').value = frame;
    element('scrub').setAttribute('aria-valuetext', `${this.time.toFixed(1)} seconds`);
    element('position').value = `${this.time.toFixed(1)} / ${this.lastTime.toFixed(1)} s · frame ${frame + 1} / ${recording.count}`;
    element('clock').textContent = `t = ${this.time.toFixed(1)} s`;
    element('node-count').textContent = plural(here.slots.length, 'node');
    element('link-count').textContent = (here.linksInAll > links ? `${links.toLocaleString('en')} of ` : '') + plural(here.linksInAll, 'link');
    this.describeSelection();
    return true;
  }

  describeSelection() {
    element('selection').hidden = this.selected < 0;
    if (this.selected < 0) return;
    const { selected, here: frame } = this;
    const { ids, metadata } = this.recording;
    element('selected-name').textContent = `Node ${ids[selected]}`;
    const here = frame.present[selected] === 1;
    const value = frame.scalars[selected];
    const told = Number.isNaN(value) ? 'has no value' : withUnit(value, metadata);
    element('selected-scalar').textContent = here ? `${metadata.scalar.name} ${told}` : 'not there at this time';
    element('selected-position').textContent = here ? `at ${this.view.swarm.placeOf(selected, [0, 0, 0]).map((x) => x.toFixed(2)).join(', ')} m` : '';
    const neighbours = here ? this.neighbours(selected) : [];
    const listed = neighbours.length ? `: ${neighbours.join(', ')}` : '';
    const some = frame.linksInAll > frame.pairs.length / 2 ? ' by the links shown' : '';
    element('selected-neighbours').textContent = here ? `${plural(neighbours.length, 'neighbour')}${some}${listed}` : '';
  }

  neighbours(slot) {
    const found = [];
    const { pairs } = this.here;
    for (let i = 0; i < pairs.length; i += 2) {
      if (pairs[i] === slot) found.push(this.recording.ids[pairs[i + 1]]);
      else if (pairs[i + 1] === slot) found.push(this.recording.ids[pairs[i]]);
    }
    return found.sort((a, b) => a - b);
  }

  tick(now) {
    if (!this.playing) return;
    const passed = Math.min((now - this.lastTick) / 1000, 0.25); // a sleeping tab must not jump
    this.lastTick = now;
    if (this.waits > 0) this.view.request();
    else this.show(this.time + passed * this.speed);
    if (this.time >= this.lastTime) this.pause();
  }

  seek(frame) {
    return this.show(this.recording.times[Math.min(Math.max(Math.round(frame), 0), this.recording.count - 1)]);
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
      this.select(this.view.pick(event.clientX, event.clientY));
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
    this.seek(this.recording.frameAt(this.time) + frames);
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
  const recording = await open(holder.textContent.trim());
  await recording.load(0);
  holder.remove(); // the page needs its text no more
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
      /** Both return a promise where the frame must be read first. */
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
      /** The frame on show, in Unity's axes, as recorded. */
      state: () => {
        const { here } = player;
        const { ids } = recording;
        return {
          frame: here.index,
          time: player.time,
          playing: player.playing,
          nodes: Array.from(here.slots, (s) => ({
            id: ids[s], x: here.places[4 * s], y: here.places[4 * s + 1], z: here.places[4 * s + 2], scalar: here.scalars[s],
          })),
          links: Array.from({ length: here.pairs.length / 2 }, (_, i) => [ids[here.pairs[2 * i]], ids[here.pairs[2 * i + 1]]]),
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
