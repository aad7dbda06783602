// The panel that says why an object is seen or hidden.
import { aboutObject, coordinates, nameOf } from './words.js';
import { Fate } from './fate.js';

const element = (name, text, className) => {
  const made = document.createElement(name);
  if (text) made.textContent = text;
  if (className) made.className = className;
  return made;
};

const most = 12; // occluders shown at first

/// `state`: {picked: {id, by, sees, verdict, ...}, world, viewer, fates}
export function showWhy(box, { picked, world, viewer, seq, fates, onPick }) {
  if (!picked) {
    box.replaceChildren(element('p', 'Click an object, or press n, to learn why it is seen or hidden.', 'faint'));
    return;
  }
  const slot = world.slots.get(picked.id), record = world.records[slot], parts = [];
  if (!record) {
    box.replaceChildren(element('p', `Object ${picked.id} is not there in this frame.`, 'verdict'));
    return;
  }
  const verdict = element('p', sentence(picked, fates.of[slot], viewer, record), 'verdict');
  verdict.dataset.verdict = picked.verdict ?? ['outside', 'hidden', 'visible', 'own'][fates.of[slot]];
  parts.push(verdict);
  if (picked.by?.length && picked.verdict === 'hidden') parts.push(coverers(picked.by, world, onPick));
  if (picked.sees?.length) parts.push(element('p', `A free line of sight ends at ${picked.sees.map(coordinates).join(', ')} on it.`));
  if (picked.cells?.length) parts.push(element('p', `It touches ${picked.cells.length === 1 ? 'one cell' : `${picked.cells.length} cells`}.`, 'faint'));
  if (picked.asOf !== undefined && picked.asOf !== seq) parts.push(element('p', `So it was in frame ${picked.asOf}.`, 'faint'));
  if (picked.note) parts.push(element('p', picked.note, 'faint'));
  parts.push(element('p', aboutObject(record), 'faint'));
  box.replaceChildren(...parts);
}

function sentence({ verdict }, fate, viewer, record) {
  const name = `Object ${nameOf(record)}`, who = `viewer ${viewer}`;
  const reported = fate === Fate.seen;
  if (fate === Fate.own) return `${name} is what ${who} rides on: it is never reported.`;
  switch (verdict) {
    case 'visible': return `${name} is seen by ${who}.`;
    case 'hidden': return reported ? `${name} is hidden, but ${who} is told of it: the PVS may hold too many, never too few.` : `${name} is hidden from ${who}.`;
    case 'outside': return `${name} is outside the view volume of ${who}.`;
    case 'contains_viewer': return `${name} holds ${who} within itself: it is always reported and hides nothing from it.`;
    default:
  }
  if (viewer === undefined) return `${name}. There is no viewer to ask about.`;
  return reported ? `${name} is in the PVS of ${who}.` : fate === Fate.unseen ? `${name} is in the view of ${who}, but hidden.` : `${name} is outside the view volume of ${who}.`;
}

function coverers(ids, world, onPick) {
  const box = element('div');
  box.append(element('p', ids.length === 1 ? 'It is covered by this object:' : `Together these ${ids.length} objects cover it:`));
  const list = element('div', '', 'ids');
  for (const id of ids.slice(0, most)) {
    const button = element('button', nameOf(world.record(id) ?? { id }));
    button.type = 'button';
    button.addEventListener('click', () => onPick(id));
    list.append(button);
  }
  if (ids.length > most) list.append(element('span', `and ${ids.length - most} more`));
  box.append(list);
  return box;
}
