// Joins the recording, the view and the controls, and offers `window.replay` to scripts.
import { Charts } from './charts.js';
import { canRecord, compose, save, Video } from './exports.js';
import { fieldsOf, textOf } from './fields.js';
import { bindKeys } from './keys.js';
import { Legend, part } from './legend.js';
import { open } from './recording.js';
import { View } from './view.js';

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8];
const MOST_LISTED = 60; // neighbours with a button
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
    this.selected = null; // a node's id

    this.fields = fieldsOf(recording);
    this.view = new View(element('canvas'), element('labels'), recording);
    this.view.onFrame = (now) => this.tick(now);
    this.view.onDrawn = () => this.video?.frame();
    this.describeRun();
    this.charts = new Charts(element('charts'), recording.metrics, (time) => this.show(time));
    this.legend = new Legend(this.fields, () => this.recolour());
    this.legend.choose(0);
    this.bind();
    const shows = this.charts.charts.length > 0 && window.innerWidth >= 1000 && window.innerHeight >= 600;
    this.showCharts(shows);
    this.setFactor(Math.min(Math.max(Math.ceil((4 * READABLE_PIXELS) / this.view.nodePixels) / 4, 1), 3));
    this.resize(); // now the panels have their words
  }

  get lastTime() {
    return this.recording.times[this.recording.count - 1];
  }

  /**
   * Shows the moment `time`: nodes between two frames are drawn between their places, everything else is the earlier frame's. The promise
   * resolves when it, or a later request, is shown.
   */
  show(time) {
    this.time = Math.min(Math.max(time, this.recording.times[0]), this.lastTime);
    if (this.refresh()) return undefined;
    const arrival = this.arrive(this.time);
    arrival.catch(() => {}); // reported on the page
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
    const selected = this.selectedSlot;
    view.show({ here, next, share, links: this.links, selected, factor: this.factor });
    this.showTrails();
    this.legend.show(here);
    this.charts.show(this.time);
    const links = here.pairs.length / 2;
    element('scrub').value = frame;
    element('scrub').setAttribute('aria-valuetext', `${this.time.toFixed(1)} seconds`);
    const tick = Math.round(this.time / recording.metadata.deltaTime).toLocaleString('en');
    element('position').value = `${this.time.toFixed(1)} / ${this.lastTime.toFixed(1)} s · tick ${tick} · frame ${frame + 1} / ${recording.count}`;
    element('clock').textContent = `t = ${this.time.toFixed(1)} s`;
    element('node-count').textContent = plural(here.slots.length, 'node');
    element('link-count').textContent = (here.linksInAll > links ? `${links.toLocaleString('en')} of ` : '') + plural(here.linksInAll, 'link');
    this.describeSelection();
    return true;
  }

  /** The slot of the selected node in the shown frame, or -1. */
  get selectedSlot() {
    const { slots, ids } = this.here;
    return slots.find((slot) => ids[slot] === this.selected) ?? -1;
  }

  get links() {
    if (!this.linksVisible) return 'none';
    return element('links-selected').checked ? 'selected' : 'all';
  }

  /** Colours the nodes as in the legend. */
  recolour() {
    const { legend, view } = this;
    view.swarm.setColours((frame) => {
      const values = legend.field.valuesOf(frame);
      return (slot) => legend.of(values[slot]);
    });
    if (this.here) this.refresh();
  }

  showTrails() {
    const mode = element('trails').checked ? 'all' : 'none';
    const selected = this.selectedSlot;
    const slots = mode === 'all' ? (selected >= 0 ? [selected] : this.here.slots) : [];
    const wanted = `${mode} ${this.here.index} ${this.selected}`;
    if (wanted === this.trails) return;
    this.trails = wanted;
    this.view.swarm.trails.show(this.recording, this.here, slots, () => {
      if (this.trails !== wanted) return;
      this.trails = null;
      this.refresh();
    });
  }

  describeSelection() {
    element('selection').hidden = this.selected === null;
    if (this.selected === null) return;
    const { selectedSlot: selected, here: frame } = this;
    element('selected-name').textContent = `Node ${this.selected}`;
    const here = selected >= 0;
    element('selected-position').textContent = here
      ? `at ${this.view.swarm.placeOf(selected, [0, 0, 0]).map((x) => x.toFixed(2)).join(', ')} m` : 'not there at this time';
    if (this.described === frame && this.describedNode === this.selected) return;
    [this.described, this.describedNode] = [frame, this.selected];
    element('selected-values').replaceChildren(...(here ? this.fields : []).filter(({ name }) => name !== 'node' && name !== 'neighbours').flatMap((field) => [
      part('dt', field.name), part('dd', textOf(field, field.valuesOf(frame)[selected])),
    ]));
    const neighbours = here ? this.neighbours(selected) : [];
    const some = frame.linksInAll > frame.pairs.length / 2 ? ' by the links shown' : '';
    element('selected-neighbours').textContent = here ? plural(neighbours.length, 'neighbour') + some : '';
    element('neighbour-list').replaceChildren(...neighbours.slice(0, MOST_LISTED).map((id) => {
      const button = part('button', id);
      button.setAttribute('aria-label', `Select node ${id}`);
      button.addEventListener('click', () => this.selectId(id));
      return button;
    }), ...(neighbours.length > MOST_LISTED ? [part('span', `and ${neighbours.length - MOST_LISTED} more`)] : []));
  }

  neighbours(slot) {
    const found = [];
    const { pairs, ids } = this.here;
    for (let i = 0; i < pairs.length; i += 2) {
      if (pairs[i] === slot) found.push(ids[pairs[i + 1]]);
      else if (pairs[i + 1] === slot) found.push(ids[pairs[i]]);
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
    if (!playing && this.video) {
      this.video.stop();
      this.video = null;
      this.setRecording(false);
    }
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

  /** Selects the node of that id; null: none. */
  select(id) {
    this.selected = id;
    element('find').value = id ?? '';
    this.refresh();
  }

  /** Selects the node with the next greater or lesser id of those on show. */
  selectNext(by) {
    const order = Array.from(this.here.slots, (slot) => this.here.ids[slot]).sort((a, b) => a - b);
    if (order.length === 0) return;
    const at = order.indexOf(this.selected);
    const first = by > 0 ? 0 : order.length - 1;
    this.select(order[at < 0 ? first : (at + by + order.length) % order.length]);
  }

  selectId(id) {
    this.select(this.recording.has(id) ? id : null);
  }

  describeRun() {
    const { metadata, count, nodes } = this.recording;
    document.title = metadata.title;
    element('title').textContent = metadata.title;
    element('title').title = `seed ${metadata.seed}, ${plural(nodes, 'node')} in all`;
    element('scrub').max = count - 1;
  }

  showCharts(visible) {
    element('charts-shown').setAttribute('aria-pressed', String(visible));
    element('charts-shown').hidden = this.charts.charts.length === 0;
    element('charts').hidden = !visible;
    this.resize();
  }

  /** The picture on show as a file. */
  async savePicture() {
    this.view.draw();
    const canvas = compose(document.createElement('canvas'), this.legend);
    save(await new Promise((resolve) => { canvas.toBlob(resolve); }), `${this.fileName()}-${this.time.toFixed(1)}s.png`);
  }

  /** Records what plays from now on, until the end, a pause or the next call. */
  async toggleVideo() {
    if (this.video) {
      this.pause();
      return;
    }
    this.view.draw();
    this.video = new Video(this.legend);
    this.setRecording(true);
    this.play();
    const { video } = this;
    const file = await video.done;
    save(file, `${this.fileName()}.${video.extension}`);
  }

  setRecording(recording) {
    element('video').setAttribute('aria-pressed', String(recording));
    element('video').textContent = recording ? 'Stop' : 'Video';
  }

  fileName() {
    const { title, seed } = this.recording.metadata;
    return `${title.replace(/[^\w-]+/g, '-')}-seed${seed}`;
  }

  resize() {
    const picture = document.body.classList.contains('picture');
    const controls = element('controls').getBoundingClientRect();
    const bottom = picture ? 16 : window.innerHeight - controls.top;
    const charts = element('charts');
    const summary = element('summary').getBoundingClientRect();
    charts.style.top = `${summary.bottom + 10}px`;
    charts.style.maxHeight = `${controls.top - summary.bottom - 20}px`;
    document.body.style.setProperty('--controls', `${picture ? 0 : window.innerHeight - controls.top}px`);
    const left = picture || charts.hidden ? 0 : charts.getBoundingClientRect().right;
    // Both panels leave most of a wide window; in a narrow one they lie over the picture.
    const right = left > 0 ? window.innerWidth - element('legend').getBoundingClientRect().left : 0;
    const wide = window.innerWidth >= 1000;
    this.view.resize(window.innerWidth, window.innerHeight, { top: 28, bottom, left: wide ? left : 0, right: wide ? right : 0 });
    if (!charts.hidden) this.charts.redraw(charts);
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
      const id = event.target.value === '' ? null : Number(event.target.value);
      event.target.setCustomValidity(id === null || this.recording.has(id) ? '' : 'No node of this run has that id.');
      if (event.target.reportValidity()) this.select(id);
    });
    element('deselect').addEventListener('click', () => {
      this.select(null);
      element('canvas').focus(); // the button is gone
    });
    element('step-back').addEventListener('click', () => this.step(-1));
    element('step-on').addEventListener('click', () => this.step(1));
    for (const id of ['links-selected', 'trails']) element(id).addEventListener('change', () => this.refresh());
    element('follow').addEventListener('change', (event) => this.view.setFollows(event.target.checked));
    element('charts-shown').addEventListener('click', () => this.showCharts(element('charts').hidden));
    element('picture').addEventListener('click', () => this.savePicture());
    element('video').addEventListener('click', () => this.toggleVideo());
    element('video').hidden = !canRecord();
    element('view-above').addEventListener('click', () => this.view.frame('above'));
    element('view-top').addEventListener('click', () => this.view.frame('top'));
    element('help').addEventListener('click', (event) => {
      const keys = element('keys');
      keys.hidden = !keys.hidden;
      event.target.setAttribute('aria-expanded', String(!keys.hidden));
      this.resize();
    });
    this.bindPicking(element('canvas'));
    window.addEventListener('resize', () => this.resize());
    bindKeys(this);
    const dark = matchMedia('(prefers-color-scheme: dark)');
    const theme = () => {
      this.view.setTheme(dark.matches ? 'dark' : 'light');
      this.charts.redraw(element('charts'));
    };
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
      this.select(this.here.ids[this.view.pick(event.clientX, event.clientY)] ?? null);
    });
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

function showMessage(text) {
  element('message-text').textContent = text;
  element('message').hidden = false;
  for (const id of ['summary', 'legend', 'charts', 'controls']) element(id).hidden = true;
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
      /** The id of the node at a point of the page, or null. */
      at: (x, y) => player.here.ids[player.view.pick(x, y)] ?? null,
      /** Names of what can colour the nodes, and the choice of one. */
      fields: player.fields.map(({ name }) => name),
      colourBy: (name) => player.legend.choose(player.fields.findIndex((field) => field.name === name)),
      /** The frame on show, in Unity's axes, as recorded. */
      state: () => {
        const { here } = player;
        const { ids } = here;
        return {
          frame: here.index,
          time: player.time,
          playing: player.playing,
          nodes: Array.from(here.slots, (s) => ({
            id: ids[s], x: here.places[4 * s], y: here.places[4 * s + 1], z: here.places[4 * s + 2], scalar: here.values[0][s],
            values: here.values.map((column) => column[s]),
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
ready.catch(() => {}); // reported on the page
window.replay = { ready };
