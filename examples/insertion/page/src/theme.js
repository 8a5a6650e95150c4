// Colours are named once, in style.css, for light and dark.

const KIND_COLOURS = ['--plane', '--edge', '--vertex'];

/** The colour of a kind of contact; kinds that the page does not know share one. */
export function kindColour(kind) {
  return colour(KIND_COLOURS[kind] ?? '--other');
}

export function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

export function onThemeChange(listener) {
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', listener);
}
