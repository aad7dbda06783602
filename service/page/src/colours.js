// The style sheet's colours for those who draw; they change with the light.
const names = ['page', 'panel', 'ink', 'faint', 'line', 'map', 'visited', 'met', 'region', 'region-line', 'hidden', 'touched', 'opaque',
  'tbv-cell', 'sight', 'lattice', 'volume', 'tbv', 'revealed', 'seen', 'seen-line', 'unseen', 'unseen-line', 'beyond', 'beyond-line',
  'own', 'own-line', 'eye', 'eye-line', 'pick', 'blocker', 'frame-time', 'exact', 'pvs-area'];

export const colours = {};
const dark = matchMedia('(prefers-color-scheme: dark)');

function read() {
  const style = getComputedStyle(document.documentElement);
  for (const name of names) colours[name] = style.getPropertyValue(`--${name}`).trim();
  colours.dark = dark.matches;
}

export function followColours(changed) {
  read();
  dark.addEventListener('change', () => { read(); changed(); });
}
