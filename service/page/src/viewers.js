// The choice of viewer. Once chosen by hand a viewer stays chosen, though it may be away for some frames.
export class ViewerChoice {
  constructor(select, changed) {
    Object.assign(this, { select, changed, ids: [] });
    select.addEventListener('change', () => this.choose(Number(select.value)));
  }

  reset() {
    this.ids = [];
    this.viewer = undefined;
    this.byHand = false;
    this.select.replaceChildren();
  }

  /// The viewers of a frame; the first is taken until somebody chooses.
  offer(ids) {
    if (ids.length === this.ids.length && ids.every((id, i) => id === this.ids[i])) return;
    this.ids = ids;
    if (this.viewer === undefined || (!this.byHand && !ids.includes(this.viewer))) {
      if (ids.length) this.set(ids[0]);
    }
    this.fill();
  }

  fill() {
    const away = this.viewer !== undefined && !this.ids.includes(this.viewer);
    const shown = away ? [...this.ids, this.viewer] : this.ids;
    this.select.replaceChildren(...shown.map((id) => new Option(`${id}${away && id === this.viewer ? ' (away)' : ''}`, id)));
    this.select.disabled = !shown.length;
    if (this.viewer !== undefined) this.select.value = this.viewer;
  }

  set(id) {
    this.viewer = id;
    this.changed(id);
  }

  choose(id) {
    this.byHand = true;
    this.set(id);
    this.fill();
  }

  next(by) {
    if (!this.ids.length) return;
    const at = this.ids.indexOf(this.viewer);
    this.choose(this.ids[(Math.max(at, by > 0 ? at : 0) + by + this.ids.length) % this.ids.length]);
  }
}
