// Imported before uPlot, which formats numbers in the browser's language as soon as it is loaded: without a locale of the system Chromium
// names 'en-US@posix', which no formatter takes.
try {
  new Intl.NumberFormat(navigator.language);
} catch {
  Object.defineProperty(navigator, 'language', { value: 'en-US' });
}
