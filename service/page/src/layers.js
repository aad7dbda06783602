// What can be drawn and what is: the list beside the map is its legend too.
import { Fate } from './fate.js';

export const layers = [
  { key: 'seen-area', text: 'what it looks into', fill: 'visited', line: 'region-line', flat: true, solid: false },
  { key: 'hidden', text: 'hidden cells (H)', fill: 'hidden', flat: true, solid: true },
  { key: 'opaque', text: 'opaque cells (O)', fill: 'opaque', flat: true, solid: true },
  { key: 'touched', text: "objects' cells (I)", fill: 'touched', fade: 0.38, flat: false, solid: false },
  { key: 'tbv', text: 'TBVs of hidden movers', line: 'tbv', dash: '4 2', disc: true, flat: true, solid: true },
  { key: 'volume', text: 'view volume, sight line', line: 'volume', bar: true, flat: true, solid: true },
  { key: 'unseen', text: 'hidden objects', fill: 'unseen', line: 'unseen-line', dash: '3 2', flat: true, solid: true },
  { key: 'beyond', text: 'objects out of view', fill: 'beyond', line: 'beyond-line', flat: true, solid: true },
];

const samples = {
  area: ({ fill, line, dash, fade }) => `<rect x="1" y="2" width="22" height="10" style="fill:${fill ? `var(--${fill})` : 'none'};fill-opacity:${fade ?? 1};stroke:var(--${line ?? 'line'});stroke-dasharray:${dash ?? 'none'}"/>`,
  disc: ({ line, dash }) => `<circle cx="12" cy="7" r="6" style="fill:none;stroke:var(--${line});stroke-width:1.5;stroke-dasharray:${dash}"/>`,
  bar: ({ line }) => `<path d="M1 12L12 2L23 12" style="fill:none;stroke:var(--${line});stroke-width:1.8"/>`,
};

export class LayerList {
  constructor(box, changed) {
    this.on = {};
    this.counts = {};
    this.changed = changed;
    layers.forEach((layer, i) => {
      const label = document.createElement('label');
      const kind = layer.disc ? 'disc' : layer.bar ? 'bar' : 'area';
      // The list's texts are the page's own; nothing of a session gets in here.
      label.innerHTML = `<input type="checkbox" id="layer-${layer.key}"><svg width="24" height="14" aria-hidden="true">${samples[kind](layer)}</svg>` +
        `<span>${layer.text}</span><span class="count"></span><kbd>${i + 1}</kbd>`;
      layer.input = label.querySelector('input');
      layer.count = label.querySelector('.count');
      layer.input.addEventListener('change', () => { this.on[layer.key] = layer.input.checked; changed(); });
      box.append(label);
    });
  }

  /// What is on to begin with.
  reset(dimension) {
    for (const layer of layers) this.on[layer.key] = layer.input.checked = dimension === 2 ? layer.flat : layer.solid;
  }

  toggle(index) {
    layers[index]?.input.click();
  }

  show(counts) {
    for (const layer of layers) {
      const text = counts[layer.key] === undefined ? '' : counts[layer.key].toLocaleString('en');
      if (layer.count.textContent !== text) layer.count.textContent = text;
    }
  }
}

/// Cells come in boxes of several.
function cellsIn(boxes, { dimension, cell }) {
  if (!boxes) return undefined;
  let sum = 0;
  for (const box of boxes) {
    let product = 1;
    for (let axis = 0; axis < dimension; axis++) product *= Math.round((box[axis + dimension] - box[axis]) / cell);
    sum += product;
  }
  return sum;
}

/// How many of each there are, as far as that is known.
export function layerCounts({ drawn, fates, lattice }) {
  const cells = drawn?.cells ?? {};
  return {
    hidden: cellsIn(cells.hidden, lattice), opaque: cellsIn(cells.opaque, lattice), touched: cellsIn(cells.touched, lattice),
    tbv: drawn?.volumes?.length, unseen: fates.counts[Fate.unseen], beyond: fates.counts[Fate.beyond],
  };
}
