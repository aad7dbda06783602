// The viewer page: a list of sessions, one of them drawn live, or a trace played through a session of its own.
import { followColours } from './colours.js';
import { listenToFiles } from './drop.js';
import { Fate, Fates } from './fate.js';
import { History } from './history.js';
import { listenToKeys } from './keys.js';
import { layerCounts, LayerList } from './layers.js';
import { Picked } from './picked.js';
import { Player } from './player.js';
import { showReadings } from './readings.js';
import { SessionList } from './sessions.js';
import { Timeline } from './timeline.js';
import { TraceDriver, traceFromFiles, traceFromServer } from './trace.js';
import { View2d } from './view2d.js';
import { View3d } from './view3d.js';
import { ViewerChoice } from './viewers.js';
import { Watcher } from './watcher.js';
import { streamAddress } from './connection.js';
import { count } from './words.js';
import { showScale, showTime } from './clock.js';
import { showWhy } from './why.js';

const $ = (id) => document.getElementById(id);
const methods = { 2: ['silhouette', 'voxel', 'frustum', 'shadow-frusta', 'pairwise-rays'],
  3: ['silhouette', 'voxel', 'frustum', 'shadow-frusta', 'pairwise-rays', 'depth-rays'] };

let token = ''; // the server's, where it asks for one; kept as long as the page is open
let watcher = null, driver = null, trace = null, start = null, view = null, dirty = false, busy = 0;
const history = new History(), fates = new Fates();
const shown = { fates, on: {}, changed: true };

// -- drawing: at most once a screen's frame, and only where something is new
function refresh() {
  shown.changed = true;
  redraw();
}

function redraw() {
  if (dirty) return;
  dirty = true;
  requestAnimationFrame(paint);
}

const layerList = new LayerList($('layers'), refresh);
shown.on = layerList.on;
const timeline = new Timeline($('timeline'), { onSeek: (seq) => player.seek(seq) });
const player = new Player(history, { onShow: refresh, onFault: (fault) => complain(fault) });
const viewers = new ViewerChoice($('viewer'), chooseViewer);
const picked = new Picked({ ask: (viewer, object) => (driver ?? watcher).explain(viewer, object), changed: refresh });
const views = {
  2: new View2d($('flat'), { onPick: pick, onMove: redraw }),
  3: null, // made when a 3D world comes: a page without WebGL still shows ground plans
};

function situation() {
  const cellBox = (cell) => [...cell.map((i, axis) => start.bounds.min[axis] + i * start.cell), ...cell.map((i, axis) => start.bounds.min[axis] + (i + 1) * start.cell)];
  return { viewer: viewers.viewer, seq: player.seq, newest: player.atHead && player.seq >= history.first, cellBox };
}

function paint() {
  dirty = false;
  if ($('work').hidden || !start || !player.shown) return;
  player.catchUp();
  const { world, step } = player.shown, { viewer } = viewers;
  const seen = step?.answers.find((answer) => answer.viewer === viewer)?.visible;
  const eye = step?.views.find((each) => each.viewer === viewer);
  if (shown.changed) {
    fates.update(world, eye, seen);
    picked.update(situation());
    Object.assign(shown, { world, view: eye, drawn: step?.drawn && step.drawn.viewer === viewer ? step.drawn : null, picked: picked.about, lattice: start });
    if (eye && !shown.framed) frameFirst(eye);
    showReadings({ size: $('pvs-size'), words: $('pvs-words'), list: $('readings') }, { step, viewer, view: eye, pvs: seen?.length, fates, world });
    showWhy($('why'), { picked: picked.about, world, viewer, seq: player.seq, fates, onPick: pick });
    layerList.show(layerCounts(shown));
    $('drawn-note').hidden = !step?.drawn || step.drawn.viewer === viewer;
    $('drawn-note').textContent = `Cells and TBVs of viewer ${viewer} come with the next frame.`;
    showTime({ history, player, driver });
    $('follow').setAttribute('aria-pressed', String(view.follows));
    $('eye-title').textContent = `What viewer ${viewer} sees: its PVS, nothing else`;
  }
  view.resize();
  view.draw(shown);
  showScale(start.dimension, view);
  timeline.resize();
  timeline.draw({ history, viewer, seq: player.seq, total: driver?.total });
}

/// A viewer that sees a small part of the world is followed, otherwise the world is shown.
function frameFirst(eye) {
  shown.framed = true;
  const size = Math.max(start.bounds.max[0] - start.bounds.min[0], start.bounds.max[1] - start.bounds.min[1]);
  if (start.dimension === 2 && eye.range && 2.2 * eye.range < size) follow(true);
}

function follow(on) {
  if (on) view.follow(shown.view);
  else view.follows = false;
  $('follow').setAttribute('aria-pressed', String(on));
  redraw();
}

// -- what goes wrong, in words
function complain(fault, { forToken } = {}) {
  $('notice').hidden = false;
  $('notice-text').textContent = fault.message ?? String(fault);
  $('token-form').hidden = !forToken;
  retry = forToken ?? null;
}
let retry = null;

function content() {
  $('notice').hidden = true;
}

function state(kind, words) {
  $('state').dataset.state = kind;
  $('state').textContent = words;
}

// -- a session comes and goes
function leave() {
  busy++;
  watcher?.close();
  driver?.close();
  watcher = driver = start = null;
  player.reset();
  history.clear();
  viewers.reset();
  picked.about = null;
  shown.framed = false;
}

function showStart() {
  leave();
  trace = null;
  $('work').hidden = $('back').hidden = $('method-box').hidden = true;
  $('start').hidden = false;
  $('name').textContent = 'Who can see whom';
  $('facts').textContent = '';
  document.title = 'gridcull';
  state('none', '');
}

function begin(message) {
  const again = start?.session === message.session;
  if (again && message.seq === history.last) return; // only the choice of viewer has changed
  start = message;
  history.start(message.scene, message.seq);
  player.reset(driver);
  $('start').hidden = true;
  $('work').hidden = $('back').hidden = false;
  $('name').textContent = message.name || message.session;
  $('facts').textContent = `${message.dimension}D · ${message.method} · cells of ${+message.cell.toPrecision(4)} m · ${count(message.scene.objects.length, 'object')}`;
  document.title = `${message.name || message.session} – gridcull`;
  $('object-names').replaceChildren(...message.scene.objects.filter((o) => o.name).slice(0, 2000).map((o) => new Option(o.name)));
  if (!again && !useView(message.dimension)) return;
  player.begin();
}

function useView(dimension) {
  $('flat').hidden = dimension === 3;
  $('solid').hidden = dimension === 2;
  if (dimension === 3 && !views[3]) {
    try {
      views[3] = new View3d($('solid'), { onPick: pick, onMove: redraw });
    } catch (fault) {
      showStart();
      complain(new Error(`This browser draws nothing in 3D: ${fault.message}`));
      return false;
    }
  }
  view = views[dimension];
  layerList.reset(dimension);
  view.resize();
  view.fit(start.bounds);
  return true;
}

async function watch(session, { viewer, secret } = {}) {
  const mine = busy;
  watcher = new Watcher({
    session, token: secret ?? token,
    onStart: (message) => { if (mine === busy) begin(message); },
    onStep: (step, text) => { if (mine === busy) arrive(step, text); },
    onClose: (reason) => { if (mine === busy) lost(reason); },
  });
  await watcher.watch(viewer);
  state('live', driver ? 'trace' : 'live');
}

function arrive(step, text) {
  if (!history.push(step, text)) return void watcher.watch(viewers.viewer).catch(complain);
  viewers.offer(step.views.map((each) => each.viewer));
  player.arrived();
}

function lost(reason) {
  state('gone', 'ended');
  player.pause();
  complain(new Error(`The connection has ended${reason ? `: ${reason}` : ''}. What has come so far can still be looked at.`));
}

async function chooseSession(session) {
  leave();
  content();
  try {
    await watch(session);
  } catch (fault) {
    showStart();
    complain(fault, fault.code === 'forbidden' ? { forToken: () => chooseSession(session) } : {});
  }
}

async function playTrace(next, method = 'silhouette') {
  leave();
  content();
  trace = next;
  const mine = busy;
  try {
    driver = new TraceDriver(trace, (reason) => { if (mine === busy) lost(reason); });
    const { session } = await driver.open(method, token);
    if (mine !== busy) return;
    const select = $('method');
    select.replaceChildren(...methods[trace.scene.dimension].map((name) => new Option(name)));
    select.value = method;
    $('method-box').hidden = false;
    const first = trace.scene.viewers?.map(({ id }) => id).sort((a, b) => a - b)[0];
    await watch(session, { viewer: first });
  } catch (fault) {
    if (mine !== busy) return;
    showStart();
    complain(fault, fault.code === 'forbidden' ? { forToken: () => playTrace(next, method) } : {});
  }
}

async function openFiles(files) {
  try {
    await playTrace(await traceFromFiles(files));
  } catch (fault) {
    complain(fault);
  }
}

function chooseViewer(viewer) {
  picked.rest = 0;
  // The drawing is made for one viewer; that of another comes with the next frame.
  if (watcher && watcher.viewer !== viewer) watcher.watch(viewer).catch(complain);
  if (view?.follows) shown.framed = false;
  refresh();
}

function pick(id) {
  picked.choose(id, situation());
}

function find(text) {
  const wanted = text.trim(), { world } = player.shown ?? {};
  if (!world || !wanted) return;
  let id = /^\d+$/.test(wanted) && world.slots.has(Number(wanted)) ? Number(wanted) : undefined;
  if (id === undefined) for (const record of world.records) if (record?.name === wanted) id = record.id;
  if (id === undefined) {
    $('why').textContent = `No object has the id or name "${wanted}" in this frame.`;
    return;
  }
  pick(id);
}

/// The next object of the PVS, or the next one hidden within the view, by id.
function nextObject(fate) {
  const { world } = player.shown ?? {};
  if (!world) return;
  const ids = [...world.slots].filter(([, slot]) => fates.of[slot] === fate).map(([id]) => id).sort((a, b) => a - b);
  if (ids.length) pick(ids.find((id) => id > (picked.about?.id ?? -1)) ?? ids[0]);
}

// -- controls
const playOrPause = () => (player.playing && !(driver?.ended && player.atHead) ? player.pause() : player.play());
const inWork = (act) => () => { if (!$('work').hidden && start) act(); };
const onClick = (id, act) => $(id).addEventListener('click', act);
onClick('back', showStart);
onClick('choose-trace', () => $('files').click());
onClick('choose-trace-2', () => $('files').click());
onClick('show-help', () => $('help').showModal());
onClick('notice-close', content);
onClick('step-back', () => player.back());
onClick('step', () => player.step());
onClick('play', playOrPause);
onClick('newest', () => player.newest());
onClick('fit', () => { view.fit(start.bounds); refresh(); });
onClick('follow', () => follow(!view.follows));
onClick('zoom-in', () => { view.zoom(1.3); redraw(); });
onClick('zoom-out', () => { view.zoom(1 / 1.3); redraw(); });
$('speed').addEventListener('change', () => { player.speed = Number($('speed').value); });
$('method').addEventListener('change', () => { if (trace) playTrace(trace, $('method').value); });
$('find').addEventListener('submit', (event) => { event.preventDefault(); find($('object-id').value); });
$('token-form').addEventListener('submit', (event) => {
  event.preventDefault();
  token = $('token').value;
  retry?.();
});
const step = inWork(() => player.step()), back = inWork(() => player.back());
const pan = (dx, dy) => inWork(() => { view.pan(dx, dy); redraw(); });
listenToKeys({
  ' ': inWork(playOrPause), '.': step, ArrowRight: step, ',': back, ArrowLeft: back,
  Home: inWork(() => player.seek(history.first)), End: inWork(() => player.newest()),
  v: inWork(() => viewers.next(1)), V: inWork(() => viewers.next(-1)),
  n: inWork(() => nextObject(Fate.seen)), N: inWork(() => nextObject(Fate.unseen)),
  '+': inWork(() => { view.zoom(1.3); redraw(); }), '=': inWork(() => { view.zoom(1.3); redraw(); }), '-': inWork(() => { view.zoom(1 / 1.3); redraw(); }),
  f: inWork(() => { view.fit(start.bounds); refresh(); }), c: inWork(() => follow(!view.follows)), o: () => $('files').click(),
  'Shift+ArrowLeft': pan(60, 0), 'Shift+ArrowRight': pan(-60, 0), 'Shift+ArrowUp': pan(0, 60), 'Shift+ArrowDown': pan(0, -60),
  Escape: inWork(() => picked.clear()), '?': () => $('help').showModal(),
  ...Object.fromEntries([...'12345678'].map((key, i) => [key, inWork(() => layerList.toggle(i))])),
});
listenToFiles({ veil: $('drop'), input: $('files'), onFiles: openFiles });
followColours(() => {
  views[3]?.recolour();
  refresh();
});
new ResizeObserver(redraw).observe($('stage'));

new SessionList({
  table: $('sessions'), empty: $('sessions-empty'), onChoose: chooseSession,
  onList: (sessions) => {
    if (!start || driver || $('state').dataset.state !== 'live') return;
    const session = sessions.find((each) => each.session === start.session);
    if (!session) state('gone', 'ended');
    else state('live', session.connected ? 'live' : 'live, its client is away');
  },
  onFault: () => { if ($('work').hidden) complain(new Error('The server does not answer any more. Is gridcull serve still running?')); },
});
$('address').textContent = streamAddress();
$('client-line').textContent = `python3 examples/python/replay.py ${streamAddress().replace('/v1/stream', '')} town/scene.json town/frames.jsonl pvs.jsonl`;
traceFromServer().then((found) => { if (found) playTrace(found); }).catch(complain);
