// Style of the scripts of the replay page and the site, checked by ./collektive test lint. COLLEKTIVE_NODE_MODULES is the folder with eslint.
import { createRequire } from 'node:module';
import { join } from 'node:path';

const js = createRequire(join(process.env.COLLEKTIVE_NODE_MODULES, 'eslint.config.mjs'))('@eslint/js');
const globals = (names) => Object.fromEntries(names.split(' ').map((name) => [name, 'readonly']));

export default [
  js.configs.recommended,
  {
    files: ['unity/Headless~/Replay/**/*.{js,mjs}', 'scripts/**/*.mjs'],
    languageOptions: { globals: globals(
      'Blob Buffer DecompressionStream MediaRecorder OffscreenCanvas Response TextDecoder URL WebSocket atob cancelAnimationFrame console devicePixelRatio'
        + ' document getComputedStyle innerWidth matchMedia navigator performance process requestAnimationFrame setTimeout window',
    ) },
    rules: { eqeqeq: 'error', 'no-var': 'error', 'prefer-const': 'error', 'no-unused-vars': ['error', { argsIgnorePattern: '^_' }] },
  },
];
