// The page's memory of frames, without a browser: back and forth, frames that come twice or not at all, forgetting.
import assert from 'node:assert/strict';
import { History } from '../../service/page/src/history.js';

const disc = (id) => ({ id, shape: { type: 'disc', radius: 1 }, position: [0, 0] });
const scene = { dimension: 2, objects: [disc(1)] };

/// Frame `seq` moves object 1 to x = seq; object 2 lives from frame 50 to 79.
function step(seq) {
  const more = seq === 50 ? { add: [disc(2)] } : seq === 80 ? { remove: [2] } : {};
  const message = { type: 'step', seq, time: seq, frame: { set: [{ id: 1, position: [seq, 0] }], ...more }, views: [], answers: [{ viewer: 1, visible: [1] }] };
  return [message, JSON.stringify(message)];
}

const history = new History();
history.start(scene, 5);
assert.ok(history.push(...step(5)), 'the frame that the world holds already');
assert.deepEqual([history.first, history.last], [5, 5]);
for (let seq = 6; seq < 200; seq++) assert.ok(history.push(...step(seq)));
assert.ok(history.push(...step(199)), 'the newest once more');
assert.equal(history.push(...step(201)), false, 'one is missing');
let shown = null;
for (const seq of [100, 101, 102, 50, 49, 199, 6, 60, 81, 80, 79]) {
  shown = history.at(seq, shown);
  assert.equal(shown.step.seq, seq);
  assert.equal(shown.world.pose[0], seq);
  assert.equal(shown.world.slots.has(2), seq >= 50 && seq < 80);
}

history.start(scene, 0);
for (let seq = 1; seq < 30000; seq++) history.push(...step(seq));
assert.ok(history.length <= 20000 && history.first > 1, 'the oldest are forgotten');
for (const seq of [history.first, history.first + 1, history.last]) assert.equal(history.at(seq, null).world.pose[0], seq);
