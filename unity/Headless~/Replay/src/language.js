// Must be imported before uPlot, which creates number formatters when it is loaded. Without a system locale, Chromium reports the language
// 'en-US@posix', which formatters reject.
try {
  new Intl.NumberFormat(navigator.language);
} catch {
  Object.defineProperty(navigator, 'language', { value: 'en-US' });
}
