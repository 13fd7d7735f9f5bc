// Saves frames of a replay page as PNG files: node moving_picture.mjs replay.html FOLDER COUNT
import { mkdirSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch } from '../../../unity/Headless~/Replay/browser.mjs';

const [page, folder, count] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const browser = await launch();
try {
  const tab = await browser.newPage({ viewport: { width: 960, height: 540 }, colorScheme: 'dark' });
  await tab.goto(pathToFileURL(resolve(page)).href);
  const frames = await tab.evaluate(async () => {
    await window.replay.ready;
    window.replay.setControls(false);
    return window.replay.frames;
  });
  for (let i = 0; i < count; i++) {
    await tab.evaluate(async (frame) => {
      await window.replay.seek(frame);
      window.replay.draw();
    }, Math.round((i * (frames - 1)) / (count - 1)));
    await tab.screenshot({ path: join(folder, `${String(i).padStart(4, '0')}.png`), type: 'png' });
  }
} finally {
  await browser.close();
}
