// Which frame is shown: the newest of a live session, or one of those kept, at the pace in which they were made.
export class Player {
  /// `source`: {next(), ended, gap()} of a trace, or null where somebody else drives the session.
  constructor(history, { onShow, onFault }) {
    Object.assign(this, { history, onShow, onFault, source: null, speed: 1 });
    this.reset();
  }

  reset(source = null) {
    clearTimeout(this.timer);
    this.timer = undefined;
    this.source = source;
    this.playing = true;
    this.asked = false; // a frame of the trace is on its way
    this.stepping = false;
    this.shown = null; // {seq, world, step}
  }

  get seq() { return this.shown?.seq ?? this.history.first - 1; }
  get atHead() { return this.seq >= this.history.last; }
  get follows() { return this.playing && !this.source && !this.replaying; }

  /// The world before any frame.
  begin() {
    if (this.shown) return;
    this.shown = { seq: this.history.last, world: this.history.head.clone(), step: null };
    this.onShow();
    this.tick();
  }

  /// A frame has come in, or the newest once more.
  arrived() {
    if (this.shown?.seq === this.history.last) {
      this.shown.step = null;
      return this.show(this.history.last);
    }
    this.asked = false;
    if (this.shown && this.shown.seq < this.history.first - 1) this.show(this.history.first);
    if (this.stepping) {
      this.stepping = false;
      this.show(this.history.last);
    } else if (this.follows || (this.source && this.playing && this.seq === this.history.last - 1)) {
      this.late = true; // shown with the next picture: several may come between two
      this.onShow();
    }
    this.tick();
  }

  /// Called before drawing.
  catchUp() {
    if (!this.late) return;
    this.late = false;
    this.move(this.history.last);
  }

  move(seq) {
    if (!this.history.length) return;
    this.shown = this.history.at(Math.min(this.history.last, Math.max(this.history.first, seq)), this.shown);
  }

  show(seq) {
    this.late = false;
    this.move(seq);
    this.onShow();
  }

  seek(seq) {
    this.pause();
    this.show(seq);
  }

  play() {
    if (this.source?.ended && this.atHead && this.history.length) this.show(this.history.first); // once more
    this.playing = true;
    this.replaying = !this.atHead;
    this.tick();
    this.onShow();
  }

  pause() {
    this.playing = false;
    clearTimeout(this.timer);
    this.timer = undefined;
    this.onShow();
  }

  newest() {
    if (this.history.length) this.show(this.history.last);
    if (!this.source) this.play();
  }

  step() {
    this.pause();
    if (!this.atHead) return this.show(this.seq + 1);
    if (this.source?.ended) return;
    this.stepping = true;
    this.ask();
  }

  back() {
    this.pause();
    if (this.seq > this.history.first) this.show(this.seq - 1);
  }

  ask() {
    if (!this.source || this.source.ended || this.asked) return;
    this.asked = true;
    this.source.next().catch((fault) => {
      this.asked = false;
      this.stepping = false;
      this.pause();
      this.onFault(fault);
    });
  }

  /// Plans the next frame of a replay or a trace.
  tick() {
    if (!this.playing || this.timer !== undefined) return;
    if (this.atHead || (this.late && this.source)) this.replaying = false;
    const kept = this.history.entry(this.seq + 1), ahead = kept && !this.follows && !this.late;
    if (!ahead && !(this.source && !this.source.ended && !this.asked)) return;
    const gap = ahead ? kept.time - (this.history.entry(this.seq)?.time ?? kept.time) : this.source.gap();
    this.timer = setTimeout(() => {
      this.timer = undefined;
      if (!this.playing) return;
      if (ahead) {
        this.show(this.seq + 1);
        this.tick();
      } else {
        this.ask();
      }
    }, Math.min(2000, Math.max(15, (1000 * gap) / this.speed)));
  }
}
