// Elements of the page.

export const element = (id) => document.getElementById(id);

export function part(tag, text, properties = {}) {
  return Object.assign(document.createElement(tag), { textContent: text }, properties);
}
