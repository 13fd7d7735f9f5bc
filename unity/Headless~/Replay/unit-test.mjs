// Tests parts of the pages that need no browser: node [TEST OPTIONS] unit-test.mjs
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const modules = process.env.COLLEKTIVE_NODE_MODULES;
const { buildSync } = createRequire(join(modules, 'x.js'))('esbuild');
const { outputFiles: [{ text }] } = buildSync({
  stdin: {
    contents: ['colours', 'fields', 'legend', 'live-recording', 'recording', 'view'].map((name) => `export * from './${name}.js';`).join('')
      + "export { Group } from 'three';",
    resolveDir: join(dirname(fileURLToPath(import.meta.url)), 'src'),
  },
  bundle: true, write: false, format: 'esm', nodePaths: [modules],
});
const { clock, colouring, conflicting, digitsOf, drawable, fieldsOf, Group, historyOf, isolated, Legend, LiveRecording, open, short, View } = await import(
  `data:text/javascript;base64,${Buffer.from(text).toString('base64')}`
);

const number = (value) => (value < 128 ? [value] : [(value & 127) | 128, ...number(value >>> 7)]);
const signed = (value) => number(((value << 1) ^ (value >> 31)) >>> 0);

const bytesOf = (x, category, links) => [
  ...number(1), 1, ...signed(x), ...signed(0), ...signed(0), ...signed(1 + 2 * category), ...number(links), 0, 0,
];

/** Returns a segment (FORMAT.md) with a single frame of one node at (x, 0, 0), with a category and no stored link. */
const frameOf = (id, x, category, links = 0) => Uint8Array.from([...number(1), ...signed(id), ...bytesOf(x, category, links)]).buffer;

const live = () => new LiveRecording({
  positionStep: 1, slots: 1, ids: [0, 9], fields: [{ name: 'leader', kind: 'category', order: [] }], metrics: [], movers: [], metadata: {},
});

const valueOf = (recording, name) => fieldsOf(recording).find((field) => field.name === name).valuesOf(recording.frames.at(-1))[0];

test('live frames have speeds for as long as the page is open', () => {
  const recording = live();
  for (let i = 0; i < 400; i++) {
    recording.add({ time: i / 4, poses: [] }, frameOf(7, i, 0));
    if (i > 0) assert.equal(valueOf(recording, 'speed'), 4, `frame ${i}`);
  }
});

test('a node does not get the speed from the place of the node whose slot it has', () => {
  const recording = live();
  recording.add({ time: 0, poses: [] }, frameOf(7, 0, 0));
  recording.add({ time: 1, poses: [] }, frameOf(8, 50, 0));
  assert.ok(Number.isNaN(valueOf(recording, 'speed')));
});

test('the only frame of the last segment has speeds', async () => {
  const header = {
    version: 6, times: [0, 1, 3], framesPerSegment: 2, positionStep: 1, slots: 1, ids: [0, 9], fields: [{ name: 'leader', kind: 'category', order: [] }],
  };
  const packed = (bytes) => gzipSync(bytes).toString('base64');
  const segments = [[...new Uint8Array(frameOf(7, 5, 0)), ...bytesOf(1, -1, 0)], new Uint8Array(frameOf(7, 12, 0))];
  const frames = `\n${segments.map((bytes) => packed(Uint8Array.from(bytes))).join('\n')}`;
  const recording = await open(packed(JSON.stringify({ ...header, length: frames.length })) + frames);
  await recording.load(2);
  assert.equal(fieldsOf(recording).find(({ name }) => name === 'speed').valuesOf(recording.frame(2))[0], 3);
});

test('the number of neighbours is unknown if not all links are stored', () => {
  const recording = live();
  recording.add({ time: 0, poses: [] }, frameOf(7, 0, 0));
  assert.equal(valueOf(recording, 'neighbours'), 0);
  recording.add({ time: 1, poses: [] }, frameOf(7, 0, 0, 70000));
  assert.ok(Number.isNaN(valueOf(recording, 'neighbours')));
});

test('categories of a live run have an order, which defines their colours', () => {
  const recording = live();
  assert.deepEqual([3, 13, 3].map((category, time) => recording.add({ time, poses: [] }, frameOf(7, 0, category))), [true, true, false]);
  assert.deepEqual(recording.fields[0].order, [3, 13]);
});

test('a number has up to 2^32 - 1 codes', () => {
  const recording = Object.assign(live(), { fields: [{ name: 'hops', kind: 'number' }] });
  const range = [...new Uint8Array(new Float64Array([0, 65534]).buffer)];
  const node = [...number(1), ...signed(7), ...number(1), 1, ...signed(0), ...signed(0), ...signed(0), ...signed(-1), 0, 0, 0];
  recording.add({ time: 0, poses: [] }, Uint8Array.from([...range, ...node]).buffer);
  assert.equal(valueOf(recording, 'hops'), 2 ** 32 - 2);
});

test('a scale from high to low has the colours in reverse order', () => {
  const [up, down] = [[0, 10], [10, 0]].map(([min, max]) => [0, 2, 10].map(colouring({ kind: 'number' }, 'Viridis', min, max)));
  assert.deepEqual([down[0], down[2]], [up[2], up[0]]);
  assert.notEqual(down[1], down[0]);
});

test('two compared runs have the range of the frame if that of one run is unknown', () => {
  const recorded = { name: 'neighbours', kind: 'number', least: 2, greatest: 6 };
  const derived = { name: 'neighbours', kind: 'number' };
  for (const [one, other] of [[recorded, derived], [derived, recorded]]) {
    assert.equal(Legend.prototype.wholeOf.call({ otherFields: [other] }, one).least, undefined);
  }
});

test('values between gaps are isolated, also with the times of another run', () => {
  for (const [values, expected] of [
    [[1, null, 2, null, 3], [0, 2, 4]], [[1, 2, null, 3], [3]], [[null, 1, undefined, null, 2, undefined, 3], [1]], [[1, undefined, 2], []], [[], []],
  ]) assert.deepEqual(isolated(values), expected, JSON.stringify(values));
});

test('a compared run without a field has no values of it', async () => {
  assert.deepEqual(await historyOf({ recording: { times: [0, 1], texts: ['segment'] }, fields: [] }, { name: 'hops' }, 7), [null, null]);
});

test('runs whose fields have other kinds or constants conflict', () => {
  const field = (kind, ...words) => ({ name: 'role', kind, words });
  const run = [{ name: 'hops', kind: 'number', words: [] }, field('category', 'explorer', 'relay')];
  assert.equal(conflicting(run, [field('category', 'relay', 'explorer')]), run[1]);
  assert.equal(conflicting(run, [field('number')]), run[1]);
  for (const others of [run, [], [field('category', 'explorer', 'relay', 'base')], [field('category', 'explorer')]]) {
    assert.equal(conflicting(run, others), undefined);
  }
});

test('texts of numbers and times are short and exact', () => {
  assert.deepEqual([Number.MAX_VALUE, 2 ** 126, -1e-9, 123456789, 1.5e9, 0, 0.25].map((value) => short(value)),
    ['1.798e308', '8.507e37', '-1e-9', '123,456,789', '1,500,000,000', '0', '0.25']);
  assert.deepEqual([[0.25, 0.25], [0.75, 0.25], [12, 0.10000000149011612], [0.04, 0.019999999552965164], [2, 1], [1 / 3, 0.3333333432674408]]
    .map(([time, deltaTime]) => clock(time, deltaTime)), ['0.25', '0.75', '12.0', '0.04', '2.0', '0.333']);
});

test('texts of neighbouring ticks differ, and integer parts are not rounded', () => {
  const texts = (first, step) => [0, 1, 2].map((index) => short(first + index * step, step));
  assert.deepEqual(texts(12345, 0.2), ['12,345', '12,345.2', '12,345.4']);
  assert.deepEqual(texts(12345, 0.25), ['12,345', '12,345.25', '12,345.5']);
  assert.deepEqual(texts(0.99992, 0.00002), ['0.99992', '0.99994', '0.99996']);
  assert.deepEqual(texts(-1.5e12, 1e7), ['-1.5e12', '-1.49999e12', '-1.49998e12']);
  assert.deepEqual([123456.789, 12345.25, 1234.5678, 2.34567, 0].map((value) => short(value)), ['123,457', '12,345', '1,235', '2.346', '0']);
  assert.deepEqual([[12345.6, 0.001], [12345.6, 1], [0, 1], [5, 0]].map(([value, step]) => digitsOf(value, step)), [9, 6, 4, 4]);
});

test('a chart has gaps where no axis can show the values', () => {
  assert.deepEqual([Number.MAX_VALUE, -1e301, 1e299, null, undefined].map(drawable), [null, null, 1e299, null, undefined]);
});

test('a moving shape is visible while it exists', () => {
  const object = new Group();
  const view = { movers: [{ object, poses: [0, 1, 2, 0, 0, 0, 1, 4, 1, 2, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0] }], place: View.prototype.place };
  const shown = [[0, 1], [1, 2], [2, 2]].map(([here, next]) => {
    View.prototype.move.call(view, here, next, 0.5);
    return object.visible && object.position.toArray();
  });
  assert.deepEqual(shown, [[2, 1, -2], [4, 1, -2], false]);
});
