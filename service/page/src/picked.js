// The object that somebody asks about, and the server's answer. It explains its newest frame; of older ones the page
// knows whether the object was reported, but not why.
const pause = 200; // ms between two questions while frames run on

export class Picked {
  /// `ask(viewer, object)` gives the server's answer; `changed()`: draw again.
  constructor({ ask, changed }) {
    Object.assign(this, { ask, changed, about: null });
  }

  clear() {
    this.about = null;
    this.changed();
  }

  /// `cellBox`: the box in metres of a cell given by its indices.
  choose(id, situation) {
    this.about = id === undefined ? null : { id };
    this.last = 0;
    this.update(situation);
    this.changed();
  }

  /// `situation`: {viewer, seq, newest: is the frame shown the server's last, cellBox}
  update(situation) {
    const { about } = this, { viewer, seq, newest } = situation;
    if (!about || viewer === undefined || (about.seq === seq && about.viewer === viewer && about.newest === newest)) return;
    if (about.viewer !== viewer || !newest) this.about = { id: about.id };
    Object.assign(this.about, { seq, viewer, newest });
    if (!newest) {
      this.about.note = 'Why is worked out for the newest frame only: press End, then step.';
      return;
    }
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.question(situation), Math.max(0, (this.last ?? 0) + pause - performance.now()));
  }

  async question({ viewer, cellBox }) {
    const { id } = this.about ?? {};
    if (id === undefined) return;
    this.last = performance.now();
    let answer;
    try {
      const { verdict, by, cells, sees } = await this.ask(viewer, id);
      answer = { verdict, by, sees, cells: cells?.map(cellBox) };
    } catch (fault) {
      answer = { note: `The server does not say why: ${fault.message}` };
    }
    if (this.about?.id !== id || this.about.viewer !== viewer || !this.about.newest) return;
    const { seq, newest } = this.about;
    this.about = { id, seq, viewer, newest, ...answer };
    this.changed();
  }
}
