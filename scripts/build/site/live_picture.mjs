// Saves frames of a ./collektive live page as PNG files while an edit turns the swarm around: node live_picture.mjs ADDRESS FOLDER COUNT
// The simulation should have just started. Between two frames it is paused, because a browser may be too busy to capture one while it runs.
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { launch } from '../../../unity/Headless~/Replay/browser.mjs';

const TICKS = 8; // between two frames
const FROM = 'there.intensity - here.intensity';
const TO = 'here.intensity - there.intensity';

const [address, folder, count] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const browser = await launch();
try {
  const tab = await browser.newPage({ viewport: { width: 1120, height: 630 }, colorScheme: 'dark' });
  tab.setDefaultTimeout(180000);
  await tab.goto(address);
  const view = tab.frame({ url: /\/view$/ });
  await view.waitForFunction(() => window.replay.player);
  await tab.evaluate(() => {
    window.live.send({ run: false });
    for (const details of document.querySelectorAll('details')) details.open = false;
    const { view: editor } = window.live.files;
    const at = editor.state.doc.toString().indexOf('val obstacle');
    editor.dispatch({ selection: { anchor: at }, scrollIntoView: true });
  });
  const tick = () => view.evaluate(() => window.replay.player.recording.latest.tick);
  for (let i = 0; i < count; i++) {
    const before = await tick();
    await tab.evaluate((step) => window.live.send({ step }), TICKS);
    while (await tick() < before + TICKS) await tab.waitForTimeout(50);
    if (i === Math.floor(count / 3)) {
      await tab.evaluate(([from, to]) => {
        const { view: editor } = window.live.files;
        const at = editor.state.doc.toString().indexOf(from);
        editor.dispatch({ changes: { from: at, to: at + from.length, insert: to }, selection: { anchor: at }, scrollIntoView: true });
      }, [FROM, TO]);
    }
    if (i === Math.floor(count / 3) + 3) {
      await tab.evaluate(() => window.live.files.save());
      await tab.waitForFunction(() => document.getElementById('outcome').textContent.startsWith('compiled'), null, { timeout: 60000 });
    }
    await tab.screenshot({ path: join(folder, `${String(i).padStart(4, '0')}.png`) });
  }
} finally {
  await browser.close();
}
