// Keyboard shortcuts; page.html lists them.

const TURN = 0.08;

export function bindKeys(player) {
  const click = (id) => () => document.getElementById(id).click();
  const actions = {
    ' ': () => (player.playing ? player.pause() : player.play()),
    ArrowLeft: (shift) => player.step(shift ? -10 : -1),
    ArrowRight: (shift) => player.step(shift ? 10 : 1),
    Home: () => player.seek(0),
    End: () => player.seek(player.clock.count - 1),
    ',': () => player.changeSpeed(-1),
    '.': () => player.changeSpeed(1),
    l: () => player.setLinks(!player.linksVisible),
    o: click('links-selected'),
    n: () => player.selectNext(1),
    b: () => player.selectNext(-1),
    f: click('follow'),
    g: click('trails'),
    c: click('charts-shown'),
    p: click('picture'),
    v: click('video'),
    '?': click('help'),
    r: () => player.view.frame('above'),
    t: () => player.view.frame('top'),
    a: () => player.view.turn(-TURN, 0, 1),
    d: () => player.view.turn(TURN, 0, 1),
    w: () => player.view.turn(0, TURN, 1),
    s: () => player.view.turn(0, -TURN, 1),
    '+': () => player.view.turn(0, 0, 0.9),
    '=': () => player.view.turn(0, 0, 0.9),
    '-': () => player.view.turn(0, 0, 1 / 0.9),
    Escape: () => (document.getElementById('keys').hidden ? player.select(null) : player.showKeys(false)),
  };
  window.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { key, target } = event;
    if (target.matches('select, input[type="number"]')) return;
    if (target.matches('input[type="range"], [tabindex]:not(canvas)') && /^(Arrow|Home|End|Page)/.test(key)) return;
    if (target.matches('button, summary, input[type="checkbox"]') && (key === ' ' || key === 'Enter')) return;
    const action = actions[key.length === 1 ? key.toLowerCase() : key];
    if (!action) return;
    event.preventDefault();
    action(event.shiftKey);
  });
}
