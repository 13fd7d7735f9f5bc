// The replay page. It plays the recording that the page contains, and offers `window.replay` to scripts.
import { Player, requireGraphics, showMessage } from './player.js';
import { open } from './recording.js';
import { commandsOf } from './scripting.js';

async function start() {
  const holder = document.getElementById('replay');
  const recording = await open(holder.textContent.trim());
  await recording.load(0);
  holder.remove(); // the page no longer needs its text
  requireGraphics();
  return new Player(recording);
}

const ready = start().then(
  (player) => Object.assign(window.replay, commandsOf(player)),
  (error) => {
    showMessage(error.message);
    throw error;
  },
);
ready.catch(() => {}); // reported on the page
window.replay = { ready };
