// The object that somebody asks about, and the server's answer. It explains its newest frame; of older ones the page
// knows whether the object was reported, but not why. The exact reference may take a second in 3D, so that one question
// is asked at a time, and seldom while frames run on.
const leastPause = 200; // ms from an answer to the next question of the same object

export class Picked {
  /// `ask(viewer, object)` gives the server's answer; `changed()`: draw again.
  constructor({ ask, changed }) {
    Object.assign(this, { ask, changed, about: null, asking: false, rest: 0 });
  }

  clear() {
    this.about = null;
    this.changed();
  }

  choose(id, situation) {
    this.about = id === undefined ? null : { id };
    this.rest = 0;
    this.update(situation);
    this.changed();
  }

  /// `situation`: {viewer, seq, newest: is the frame shown the server's last, cellBox: the box in metres of a cell}
  update(situation) {
    this.situation = situation;
    const { about } = this, { viewer, seq, newest } = situation;
    if (!about || viewer === undefined) return;
    if (about.viewer !== viewer || (about.asOf !== undefined && about.asOf > seq)) this.about = { id: about.id, viewer };
    if (newest) this.plan();
    else if (this.about.asOf !== seq) this.about = { id: about.id, viewer, note: 'Why is worked out for the newest frame only: press End.' };
  }

  plan() {
    const { about, situation } = this;
    if (!about || !situation.newest || this.asking || about.asOf === situation.seq) return;
    if (about.asOf === undefined) about.note = 'Working out why…';
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.question(), Math.max(0, this.rest - performance.now()));
  }

  async question() {
    const { about, situation } = this;
    if (!about || this.asking || !situation.newest) return;
    this.asking = true;
    const { id } = about, { viewer, seq, cellBox } = situation, began = performance.now();
    let answer;
    try {
      const { verdict, by, cells, sees } = await this.ask(viewer, id);
      answer = { verdict, by, sees, cells: cells?.map(cellBox) };
    } catch (fault) {
      answer = { note: `The server does not say why: ${fault.message}` };
    }
    const now = performance.now();
    this.asking = false;
    this.rest = now + Math.max(leastPause, 3 * (now - began));
    if (this.about?.id === id && this.situation.viewer === viewer) {
      if (this.situation.seq >= seq) this.about = { id, viewer, asOf: seq, ...answer };
    } else {
      this.rest = 0;
    }
    this.plan();
    this.changed();
  }
}
