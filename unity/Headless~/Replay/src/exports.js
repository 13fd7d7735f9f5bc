// Exports pictures and videos of the current view, with the panels' text painted on the canvas.
import { css, NO_VALUE } from './colours.js';
import { element } from './dom.js';

const FRAMES_PER_SECOND = 30;
const FORMATS = [['video/webm;codecs=vp9', 'webm'], ['video/webm;codecs=vp8', 'webm'], ['video/webm', 'webm'], ['video/mp4', 'mp4']];

/** Paints the current view to another canvas of the same size. */
export function compose(target, legend) {
  const scale = scaleOf(element('canvas'));
  target.width = Math.round(window.innerWidth * scale);
  target.height = element('canvas').height;
  const context = target.getContext('2d');
  context.scale(scale, scale);
  const style = getComputedStyle(document.documentElement);
  const colour = (name) => style.getPropertyValue(name);
  context.fillStyle = colour('--background');
  context.fillRect(0, 0, target.width, target.height);
  for (const canvas of document.querySelectorAll('.side canvas')) {
    const { x, y, width, height } = canvas.getBoundingClientRect();
    context.drawImage(canvas, x, y, width, height);
  }
  const font = (size, weight = 400) => { context.font = `${weight} ${size}px system-ui, "Open Sans", sans-serif`; };
  const panel = (x, y, width, height) => {
    context.fillStyle = colour('--panel');
    context.beginPath();
    context.roundRect(x, y, width, height, 10);
    context.fill();
  };
  const text = (words, x, y, name = '--text') => {
    context.fillStyle = colour(name);
    context.fillText(words, x, y);
  };
  context.textBaseline = 'middle';
  for (const marker of document.querySelectorAll('.marker')) paintMarker(context, marker, style);

  const lines = [element('title').textContent, element('clock').textContent, `${element('node-count').textContent} · ${element('link-count').textContent}`];
  font(15, 650);
  panel(14, 14, Math.max(...lines.map((line) => context.measureText(line).width)) + 28, 84);
  text(lines[0], 28, 32);
  font(20);
  text(lines[1], 28, 56);
  font(13);
  text(lines[2], 28, 80, '--quiet');

  if (!element('other-summary').hidden) {
    const { x, y, width } = element('other-summary').getBoundingClientRect();
    panel(x, y, width, 60);
    font(15, 650);
    text(element('other-title').textContent, x + 14, y + 18);
    font(13);
    text(element('other-counts').textContent, x + 14, y + 42, '--quiet');
  }

  const rows = [
    ...legend.categories,
    ...(legend.others ? [{ text: legend.others }] : []),
    ...(element('no-value').hidden ? [] : [{ colour: NO_VALUE, text: 'no value' }]),
  ];
  const left = window.innerWidth - 238;
  const isScale = legend.field.kind === 'number';
  panel(left, 14, 224, 38 + (isScale ? 36 : 0) + 20 * rows.length);
  font(13, 600);
  text(element('scalar-name').textContent, left + 14, 33);
  font(13);
  let y = 52;
  if (isScale) {
    for (let i = 0; i < 196; i++) {
      context.fillStyle = css(legend.of(legend.min + ((legend.max - legend.min) * i) / 195));
      context.fillRect(left + 14 + i, y - 4, 1.5, 10);
    }
    legend.ticks.forEach((tick, i) => {
      context.textAlign = ['left', 'center', 'right'][i];
      text(tick, left + 14 + 98 * i, y + 16, '--quiet');
    });
    context.textAlign = 'left';
    y += 38;
  }
  for (const row of rows) {
    if (row.colour) {
      context.fillStyle = css(row.colour);
      context.beginPath();
      context.arc(left + 19, y + 1, 5, 0, 2 * Math.PI);
      context.fill();
    }
    text(row.text, left + 32, y, '--quiet');
    y += 20;
  }
  return target;
}

function scaleOf(canvas) {
  return canvas.width / canvas.clientWidth;
}

function paintMarker(context, marker, style) {
  const box = marker.getBoundingClientRect();
  if (box.width === 0) return;
  context.fillStyle = style.getPropertyValue('--accent');
  context.beginPath();
  context.roundRect(box.x, box.y, box.width, box.height, 9);
  context.fill();
  context.font = '600 12px system-ui, "Open Sans", sans-serif';
  context.fillStyle = getComputedStyle(marker).color;
  context.textAlign = 'center';
  context.fillText(marker.textContent, box.x + box.width / 2, box.y + box.height / 2 + 1);
  context.textAlign = 'left';
}

export function save(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/** Returns whether this browser can record videos. */
export function canRecord() {
  return typeof MediaRecorder !== 'undefined' && FORMATS.some(([type]) => MediaRecorder.isTypeSupported(type));
}

/** Records a video of the views that `frame` adds. */
export class Video {
  constructor(legend) {
    this.legend = legend;
    this.canvas = compose(document.createElement('canvas'), legend);
    const [type, extension] = FORMATS.find(([name]) => MediaRecorder.isTypeSupported(name));
    this.extension = extension;
    this.recorder = new MediaRecorder(this.canvas.captureStream(FRAMES_PER_SECOND), { mimeType: type, videoBitsPerSecond: 8e6 });
    const pieces = [];
    this.recorder.addEventListener('dataavailable', ({ data }) => pieces.push(data));
    this.done = new Promise((resolve) => {
      this.recorder.addEventListener('stop', () => resolve(new Blob(pieces, { type })));
    });
    this.recorder.start();
  }

  /** Adds the current view. */
  frame() {
    // Skip the view if the size has changed, because a canvas of another size would end the recording.
    const width = Math.round(window.innerWidth * scaleOf(element('canvas')));
    if (this.canvas.width === width && this.canvas.height === element('canvas').height) compose(this.canvas, this.legend);
  }

  /** Ends the video and returns a promise that resolves to its file. */
  stop() {
    if (this.recorder.state !== 'inactive') this.recorder.stop();
    return this.done;
  }
}
