// Replaces an invalid language of the browser. Without a system locale, Chromium reports the language 'en-US@posix', which number formatters reject. Import
// this module before uPlot, which creates formatters when it is loaded.
try {
  new Intl.NumberFormat(navigator.language);
} catch {
  Object.defineProperty(navigator, 'language', { value: 'en-US' });
}
