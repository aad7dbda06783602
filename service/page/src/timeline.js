// PVS size of the chosen viewer (and the exact size, where audited) over the frames, frame time below it.
import { colours } from './colours.js';
import { fitCanvas } from './fit_canvas.js';

const left = 46, right = 12, top = 15, gap = 17, foot = 6;

/// A round number not below `value`.
function ceiling(value) {
  const power = 10 ** Math.floor(Math.log10(Math.max(value, 1e-9)));
  for (const step of [1, 1.5, 2, 3, 5, 7.5, 10]) if (step * power >= value) return step * power;
  return 10 * power;
}

const millis = (us) => (us >= 1e4 ? `${(us / 1000).toFixed(0)} ms` : us >= 1000 ? `${(us / 1000).toFixed(1)} ms` : `${Math.round(us)} µs`);

export class Timeline {
  constructor(canvas, { onSeek }) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    let held = false;
    const seek = (event) => {
      const seq = this.seqAt(event.offsetX);
      if (seq !== undefined) onSeek(seq);
    };
    canvas.addEventListener('pointerdown', (event) => { held = true; canvas.setPointerCapture(event.pointerId); seek(event); });
    canvas.addEventListener('pointermove', (event) => {
      if (held) return seek(event);
      const entry = this.history?.entry(this.seqAt(event.offsetX));
      const size = entry?.sizes.get(this.viewer);
      canvas.title = entry ? `frame ${entry.seq}, ${entry.time.toFixed(2)} s: ${size === undefined ? 'no answer' : `PVS ${size}`}` +
        `${entry.exact === undefined ? '' : `, exact ${entry.exact}`}${entry.micros === undefined ? '' : `, ${millis(entry.micros)}`}` : '';
    });
    canvas.addEventListener('pointerup', () => { held = false; });
  }

  resize() { fitCanvas(this); }

  /// Frames from the first to the last kept one fill the width; few frames keep a sensible step.
  get span() { return Math.max(this.total ?? 0, this.history.length, 20); }
  x(seq) { return left + ((seq - this.history.first + 0.5) / this.span) * (this.width - left - right); }
  seqAt(px) {
    if (!this.history?.length) return undefined;
    const index = Math.floor(((px - left) / (this.width - left - right)) * this.span);
    return this.history.first + Math.min(this.history.length - 1, Math.max(0, index));
  }

  draw({ history, viewer, seq, total }) {
    Object.assign(this, { history, viewer, total });
    const g = this.context, { width, height } = this, ink = colours.ink;
    g.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    g.clearRect(0, 0, width, height);
    const upper = { y0: top, y1: Math.round(0.6 * height) }, lower = { y0: Math.round(0.6 * height) + gap, y1: height - foot };
    let mostSize = 4, mostTime = 10;
    for (const entry of history.entries) {
      mostSize = Math.max(mostSize, entry.sizes.get(viewer) ?? 0);
      mostTime = Math.max(mostTime, entry.micros ?? 0);
    }
    mostSize = ceiling(mostSize);
    mostTime = ceiling(mostTime);
    g.font = '11px system-ui, "DejaVu Sans", sans-serif';
    g.textBaseline = 'middle';
    this.axis(upper, String(mostSize), '0');
    this.axis(lower, millis(mostTime), '');
    this.legend(upper, lower, history);
    const sizeY = (n) => upper.y1 - (n / mostSize) * (upper.y1 - upper.y0), timeY = (t) => lower.y1 - (t / mostTime) * (lower.y1 - lower.y0);
    this.area(history, (entry) => entry.sizes.get(viewer), sizeY, upper.y1);
    this.line(history, (entry) => (entry.drawnFor === undefined || entry.drawnFor === viewer ? entry.exact : undefined), sizeY, colours.exact, [3, 3]);
    this.bars(history, (entry) => entry.micros, timeY, lower.y1);
    if (!history.length) return;
    const x = Math.round(this.x(Math.max(seq, history.first))) + 0.5, at = history.entry(seq)?.sizes.get(viewer);
    g.strokeStyle = colours.eye;
    g.lineWidth = 1.5;
    g.beginPath();
    g.moveTo(x, top - 4);
    g.lineTo(x, height - foot);
    g.stroke();
    if (at === undefined) return;
    g.fillStyle = colours.eye;
    g.beginPath();
    g.arc(x, sizeY(at), 3.5, 0, 2 * Math.PI);
    g.fill();
    g.fillStyle = ink;
  }

  axis({ y0, y1 }, high, low) {
    const g = this.context;
    g.strokeStyle = colours.line;
    g.lineWidth = 1;
    g.beginPath();
    for (const y of [y0, y1]) {
      g.moveTo(left, y + 0.5);
      g.lineTo(this.width - right, y + 0.5);
    }
    g.stroke();
    g.fillStyle = colours.faint;
    g.textAlign = 'right';
    g.fillText(high, left - 5, y0 + 1);
    g.fillText(low, left - 5, y1 + 1);
  }

  legend(upper, lower, history) {
    const g = this.context;
    g.textAlign = 'left';
    g.fillStyle = colours.ink;
    let x = left;
    const put = (text, colour, y) => {
      g.fillStyle = colour;
      g.fillRect(x, y - 1.5, 12, 3);
      g.fillStyle = colours.ink;
      g.fillText(text, x + 16, y + 0.5);
      x += 30 + g.measureText(text).width;
    };
    put(this.viewer === undefined ? 'PVS size' : `PVS size of viewer ${this.viewer}`, colours['seen-line'], upper.y0 - 8);
    if (history.entries.some((entry) => entry.exact !== undefined)) put('exact size', colours.exact, upper.y0 - 8);
    x = left;
    put('frame time', colours['frame-time'], lower.y0 - 8);
  }

  /// Several frames a pixel are too many to draw; of each run the greatest stands for all.
  columns(history, value, draw) {
    const each = Math.max(1, Math.floor(this.span / (this.width - left - right)));
    for (let i = 0; i < history.length; i += each) {
      let most;
      for (let j = i; j < Math.min(i + each, history.length); j++) {
        const v = value(history.entries[j]);
        if (v !== undefined && (most === undefined || v > most)) most = v;
      }
      draw(this.x(history.entries[i].seq), most);
    }
  }

  area(history, value, y, base) {
    const g = this.context;
    let run = [];
    const flush = () => {
      if (!run.length) return;
      g.beginPath();
      g.moveTo(run[0][0], base);
      for (const [px, py] of run) g.lineTo(px, py);
      g.lineTo(run.at(-1)[0], base);
      g.fillStyle = colours['pvs-area'];
      g.fill();
      g.beginPath();
      for (const [px, py] of run) g.lineTo(px, py);
      if (run.length === 1) g.lineTo(run[0][0] + 2, run[0][1]);
      g.strokeStyle = colours['seen-line'];
      g.lineWidth = 1.8;
      g.stroke();
      run = [];
    };
    this.columns(history, value, (px, v) => (v === undefined ? flush() : run.push([px, y(v)])));
    flush();
  }

  line(history, value, y, colour, dash) {
    const g = this.context;
    let down = false;
    g.beginPath();
    this.columns(history, value, (px, v) => {
      if (v !== undefined) g[down ? 'lineTo' : 'moveTo'](px, y(v));
      down = v !== undefined;
    });
    g.strokeStyle = colour;
    g.lineWidth = 1.6;
    g.setLineDash(dash);
    g.stroke();
    g.setLineDash([]);
  }

  bars(history, value, y, base) {
    const g = this.context, wide = Math.max(1, ((this.width - left - right) / this.span) * 0.7);
    g.fillStyle = colours['frame-time'];
    this.columns(history, value, (px, v) => {
      if (v !== undefined) g.fillRect(px - wide / 2, y(v), wide, Math.max(1, base - y(v)));
    });
  }
}

export { millis };
