// Takes start.png, middle.png and end.png (1600 x 900) of a replay page: node pictures.mjs replay.html OUTDIR [light|dark]
import { mkdirSync, renameSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch } from './browser.mjs';

const [page, out, colorScheme = 'light'] = process.argv.slice(2);
if (!page || !out) {
  console.error('Usage: node pictures.mjs replay.html OUTDIR [light|dark]');
  process.exit(2);
}

mkdirSync(out, { recursive: true });
const browser = await launch();
try {
  const tab = await browser.newPage({ viewport: { width: 1600, height: 900 }, colorScheme });
  // Drawing 10,000 nodes without a graphics processor takes long on a busy machine.
  tab.setDefaultTimeout(180000);
  await tab.goto(pathToFileURL(resolve(page)).href);
  const [middle, last] = await tab.evaluate(async () => {
    const { replay } = window;
    await replay.ready;
    replay.setControls(false);
    // Frames of larger swarms are farther apart, so the middle frame need not have the middle time.
    await replay.seek(replay.frames - 1);
    await replay.show(replay.state().time / 2);
    return [replay.state().frame, replay.frames - 1];
  });
  for (const [name, frame] of [['start', 0], ['middle', middle], ['end', last]]) {
    await tab.evaluate(async (i) => {
      await window.replay.seek(i);
      window.replay.draw();
    }, frame);
    const picture = resolve(out, `${name}.png`);
    await tab.screenshot({ path: `${picture}.part`, type: 'png' });
    renameSync(`${picture}.part`, picture);
  }
} finally {
  await browser.close();
}
