// The figures beside the map: how many the viewer may see, what that cost.
import { millis } from './timeline.js';
import { coordinates } from './words.js';

const put = (list, pairs) => {
  const wanted = pairs.filter(([, value]) => value !== undefined);
  while (list.children.length > 2 * wanted.length) list.lastChild.remove();
  while (list.children.length < 2 * wanted.length) list.append(document.createElement(list.children.length % 2 ? 'dd' : 'dt'));
  wanted.forEach((pair, i) => pair.forEach((text, j) => {
    const cell = list.children[2 * i + j];
    if (cell.textContent !== String(text)) cell.textContent = text;
  }));
};

export function showReadings({ size, words, list }, { step, viewer, view, pvs, fates, world }) {
  size.textContent = pvs === undefined ? '–' : pvs.toLocaleString('en');
  const inView = fates.counts[1] + fates.counts[2];
  words.textContent = viewer === undefined ? 'no viewer in this frame' : pvs === undefined ? `viewer ${viewer} has no answer in this frame` :
    `in the PVS, of ${inView.toLocaleString('en')} in the view volume`;
  const stats = step?.stats ?? {}, exact = step?.drawn && step.drawn.viewer !== viewer ? undefined : step?.exact;
  put(list, [
    ['exactly visible', exact === undefined || pvs === undefined ? undefined : `${exact}${exact ? ` (×${(pvs / exact).toFixed(3)})` : ''}`],
    ['viewer at', view && coordinates(view.position)],
    ['range', view?.range === undefined ? undefined : `${+view.range.toFixed(2)} m`],
    ['objects', world.size.toLocaleString('en')],
    ['frame time', stats.total_us === undefined ? undefined : millis(stats.total_us)],
    ['positions read', stats.positions_read?.toLocaleString('en')],
    ['TBVs active, revealed', stats.tbv_active === undefined ? undefined : `${stats.tbv_active}, ${stats.tbv_revealed}`],
  ]);
}
