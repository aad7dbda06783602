// The frames seen so far, so that one can go back. Frames are kept as the text they came in (a tenth of the memory of
// their objects); every so often a copy of the world is kept too, from which those after it are worked out.
import { World } from './world.js';

const between = 32; // frames from one copy of the world to the next
const mostText = 96e6; // characters
const mostFrames = 20000;

export class History {
  constructor() { this.clear(); }

  clear() {
    this.entries = [];
    this.head = null; // the world after the newest frame
    this.first = 0; // seq of entries[0]
    this.text = 0;
  }

  /// The world before the next frame, which will be `seq` + 1.
  start(scene, seq) {
    this.clear();
    this.head = World.from(scene);
    this.base = this.head.clone();
    this.first = seq + 1;
  }

  get last() { return this.first + this.entries.length - 1; }
  get length() { return this.entries.length; }
  entry(seq) { return this.entries[seq - this.first]; }

  /// False where a frame is missing before this one. The newest frame may come again, drawn for another viewer, and the
  /// one before the first, which the world holds already.
  push(step, text) {
    if (step.seq < this.last) return true;
    const again = step.seq === this.last;
    if (!again && step.seq !== this.last + 1) return false;
    if (!again) this.head.apply(step.frame);
    const old = again ? this.entries.pop() : undefined;
    if (again && !old) this.first = step.seq;
    this.text += text.length - (old?.text.length ?? 0);
    const keep = old ? old.world : again || this.entries.length % between === between - 1 ? this.head.clone() : null;
    this.entries.push({
      seq: step.seq, time: step.time, text, world: keep, micros: step.stats?.total_us, exact: step.exact,
      drawnFor: step.drawn?.viewer, sizes: new Map(step.answers.map((a) => [a.viewer, a.visible.length])),
    });
    if (this.text > mostText || this.entries.length > mostFrames) this.forget();
    return true;
  }

  /// Lets go of the oldest frames, up to a copy of the world to begin from.
  forget() {
    const at = this.entries.findIndex((entry) => entry.world);
    if (at < 0 || at === this.entries.length - 1) return;
    this.base = this.entries[at].world;
    for (const entry of this.entries.splice(0, at + 1)) this.text -= entry.text.length;
    this.first += at + 1;
  }

  /// The world after frame `seq` and that frame; `near` ({seq, world}) is moved on where that is the shorter way.
  at(seq, near) {
    let from = seq;
    while (from >= this.first && !this.entry(from).world) from--;
    let world;
    if (near?.world && near.seq <= seq && near.seq >= from && near.seq >= this.first - 1) {
      world = near.world;
      from = near.seq;
    } else {
      world = (from < this.first ? this.base : this.entry(from).world).clone();
    }
    let step = null;
    for (let next = Math.max(from + 1, this.first); next <= seq; next++) {
      step = JSON.parse(this.entry(next).text);
      world.apply(step.frame);
    }
    return { seq, world, step: step ?? JSON.parse(this.entry(seq).text) };
  }
}
