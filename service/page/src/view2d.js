// The ground plan, as in Figure 1 of Batagelo and Wu 2002 and in the pictures of `gridcull run --picture`.
import { stride } from './world.js';
import { Fate } from './fate.js';
import { colours } from './colours.js';
import { distanceTo, outlineOf } from './outline.js';
import { PlanCamera } from './plan_camera.js';

const leastObject = 3; // pixels; smaller objects are drawn as squares of this side
const leastCell = 5; // pixels; finer lattices are not drawn as lines
const mostDashed = 1500; // dashes are slow: more hidden objects than this get plain outlines

export class View2d extends PlanCamera {
  constructor(canvas, callbacks) {
    super(canvas, callbacks);
    this.context = canvas.getContext('2d', { alpha: false });
  }

  /// The object under a pixel, the smallest where several are; undefined where none is.
  hit(px, py) {
    const { world, fates, on } = this.shown ?? {};
    if (!world) return undefined;
    const x = this.worldX(px), y = this.worldY(py), slack = 5 / this.camera.scale;
    let best, least = Infinity;
    for (const [id, slot] of world.slots) {
      if (!this.draws(fates.of[slot], on)) continue;
      const record = world.records[slot], at = slot * stride, p = world.pose;
      const dx = x - p[at], dy = y - p[at + 1];
      if (Math.hypot(dx, dy) > record.reach + slack) continue;
      const c = Math.cos(p[at + 3]), s = Math.sin(p[at + 3]);
      const off = distanceTo(outlineOf(record.shape), c * dx + s * dy, c * dy - s * dx);
      if (off <= slack && off * 10 + record.reach < least) {
        best = id;
        least = off * 10 + record.reach;
      }
    }
    return best;
  }

  draws(fate, on) { return fate === Fate.unseen ? on.unseen : fate === Fate.beyond ? on.beyond : true; }

  // -- the picture; `shown`: {world, fates, view, drawn, lattice: {cell, bounds}, on, picked}
  draw(shown) {
    this.shown = shown;
    if (this.follows && shown.view) [this.camera.x, this.camera.y] = shown.view.position;
    const g = this.context;
    g.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    g.fillStyle = colours.map;
    g.fillRect(0, 0, this.width, this.height);
    g.lineJoin = 'round';
    this.cells(shown);
    this.lattice(shown.lattice);
    if (shown.on.volume && shown.view) this.volume(shown.view, shown.lattice);
    this.objects(shown);
    if (shown.on.tbv) this.tbvs(shown.drawn);
    this.pick(shown);
    if (shown.view) this.eye(shown.view);
  }

  fillCells(list, colour, alpha = 1) {
    if (!list?.length) return;
    const g = this.context;
    g.fillStyle = colour;
    g.globalAlpha = alpha;
    for (const [x0, y0, x1, y1] of list) {
      // Whole pixels, so that neighbours leave no seam.
      const left = Math.round(this.x(x0)), right = Math.round(this.x(x1)), top = Math.round(this.y(y1)), foot = Math.round(this.y(y0));
      if (right < 0 || left > this.width || foot < 0 || top > this.height) continue;
      g.fillRect(left, top, Math.max(1, right - left), Math.max(1, foot - top));
    }
    g.globalAlpha = 1;
  }

  cells({ drawn, on }) {
    const cells = drawn?.cells ?? {}, region = drawn?.region;
    // Where it is known what the viewer sees, cells that it merely looked into stand back.
    if (on['seen-area']) this.fillCells(cells.visited, region ? colours.met : colours.visited);
    if (on.hidden) this.fillCells(cells.hidden, colours.hidden);
    if (on['seen-area'] && region?.length) {
      const g = this.context;
      g.beginPath();
      for (const [x, y] of region) g.lineTo(this.x(x), this.y(y));
      g.closePath();
      g.fillStyle = colours.region;
      g.fill();
      g.strokeStyle = colours['region-line'];
      g.lineWidth = 0.8;
      g.stroke();
    }
    if (on.touched) this.fillCells(cells.touched, colours.touched, 0.38);
    if (on.tbv) this.fillCells(cells.tbv, colours['tbv-cell'], 0.3);
    if (on.opaque) this.fillCells(cells.opaque, colours.opaque);
    if (on.volume) this.fillCells(cells.line_of_sight, colours.sight, 0.85);
  }

  lattice({ cell, bounds }) {
    const g = this.context, step = cell * this.camera.scale;
    const x0 = this.x(bounds.min[0]), x1 = this.x(bounds.max[0]), y0 = this.y(bounds.max[1]), y1 = this.y(bounds.min[1]);
    g.strokeStyle = colours.lattice;
    g.lineWidth = 1;
    g.globalAlpha = 0.25;
    g.strokeRect(x0, y0, x1 - x0, y1 - y0);
    if (step >= leastCell) {
      g.globalAlpha = 0.09;
      g.beginPath();
      for (let i = Math.max(0, Math.floor(-x0 / step)), x; (x = x0 + i * step) <= Math.min(x1, this.width) + 0.5; i++) {
        g.moveTo(x, Math.max(y0, 0));
        g.lineTo(x, Math.min(y1, this.height));
      }
      for (let i = Math.max(0, Math.floor((y1 - this.height) / step)), y; (y = y1 - i * step) >= Math.max(y0, 0) - 0.5; i++) {
        g.moveTo(Math.max(x0, 0), y);
        g.lineTo(Math.min(x1, this.width), y);
      }
      g.stroke();
    }
    g.globalAlpha = 1;
  }

  volume(view, { bounds }) {
    const g = this.context, x = this.x(view.position[0]), y = this.y(view.position[1]);
    const world = Math.hypot(bounds.max[0] - bounds.min[0], bounds.max[1] - bounds.min[1]);
    const reach = Math.min((view.range ?? 2 * world) * this.camera.scale, 1e5), all = view.fov > 2 * Math.PI - 1e-9;
    g.strokeStyle = colours.volume;
    g.lineWidth = 1.8;
    g.beginPath();
    if (!all) g.moveTo(x, y);
    g.arc(x, y, reach, -view.heading - view.fov / 2, -view.heading + view.fov / 2);
    if (!all) g.closePath();
    g.stroke();
    g.setLineDash([7, 5]);
    g.lineWidth = 1.2;
    g.beginPath();
    g.moveTo(x, y);
    g.lineTo(x + reach * Math.cos(view.heading), y - reach * Math.sin(view.heading));
    g.stroke();
    g.setLineDash([]);
  }

  /// The object's outline is added to the current path.
  trace(record, pose, at) {
    const g = this.context, outline = outlineOf(record.shape), x = this.x(pose[at]), y = this.y(pose[at + 1]), scale = this.camera.scale;
    if (outline.kind === 'disc') {
      g.moveTo(x + outline.radius * scale, y);
      g.arc(x, y, outline.radius * scale, 0, 2 * Math.PI);
      return;
    }
    const c = Math.cos(pose[at + 3]) * scale, s = Math.sin(pose[at + 3]) * scale, p = outline.points;
    for (let i = 0; i < p.length; i += 2) {
      const px = x + c * p[i] - s * p[i + 1], py = y - s * p[i] - c * p[i + 1];
      if (i) g.lineTo(px, py);
      else g.moveTo(px, py);
    }
    if (outline.kind !== 'chain') g.closePath();
  }

  objects({ world, fates, on }) {
    const dashed = fates.counts[Fate.unseen] <= mostDashed ? [3, 2.2] : [];
    if (on.beyond) this.kind(world, fates, Fate.beyond, [colours.beyond, 0.55, colours['beyond-line'], 1, []]);
    if (on.unseen) this.kind(world, fates, Fate.unseen, [colours.unseen, 0.25, colours['unseen-line'], 1.3, dashed]);
    this.kind(world, fates, Fate.seen, [colours.seen, 0.55, colours['seen-line'], 1.8, []]);
    this.kind(world, fates, Fate.own, [colours.own, 0.35, colours['own-line'], 1.6, []]);
  }

  /// All objects of one fate: boxes and discs as one path, polygons one by one, since they may be concave.
  kind(world, fates, fate, [fill, alpha, line, width, dash]) {
    const g = this.context, { scale } = this.camera, p = world.pose, rings = [], chains = [];
    const paint = (solid) => {
      if (solid) {
        g.globalAlpha = alpha;
        g.fill('evenodd');
        g.globalAlpha = 1;
      }
      g.stroke();
    };
    g.fillStyle = fill;
    g.strokeStyle = line;
    g.lineWidth = width;
    g.setLineDash(dash);
    const dots = [];
    g.beginPath();
    for (let slot = 0; slot < world.records.length; slot++) {
      const record = world.records[slot];
      if (!record || fates.of[slot] !== fate) continue;
      const at = slot * stride, x = this.x(p[at]), y = this.y(p[at + 1]), r = record.reach * scale;
      if (x + r < 0 || x - r > this.width || y + r < 0 || y - r > this.height) continue;
      const kind = outlineOf(record.shape).kind;
      if (2 * r < leastObject) dots.push(x, y);
      else if (kind === 'ring') rings.push(slot);
      else if (kind === 'chain') chains.push(slot);
      else this.trace(record, p, at);
    }
    g.globalAlpha = alpha;
    g.fill('nonzero');
    g.globalAlpha = 1;
    g.stroke();
    for (const slot of rings) {
      g.beginPath();
      this.trace(world.records[slot], p, slot * stride);
      paint(true);
    }
    g.beginPath();
    for (const slot of chains) this.trace(world.records[slot], p, slot * stride);
    g.stroke();
    g.setLineDash([]);
    g.fillStyle = line;
    for (let i = 0; i < dots.length; i += 2) g.fillRect(dots[i] - leastObject / 2, dots[i + 1] - leastObject / 2, leastObject, leastObject);
  }

  tbvs(drawn) {
    const g = this.context, crowd = (drawn?.volumes?.length ?? 0) > mostDashed;
    for (const revealed of [false, true]) {
      g.beginPath();
      for (const volume of drawn?.volumes ?? []) {
        if (volume.revealed !== revealed) continue;
        const x = this.x(volume.centre[0]), y = this.y(volume.centre[1]), r = volume.radius * this.camera.scale;
        if (x + r < 0 || x - r > this.width || y + r < 0 || y - r > this.height) continue;
        g.moveTo(x + r, y);
        g.arc(x, y, r, 0, 2 * Math.PI);
      }
      g.strokeStyle = revealed ? colours.revealed : colours.tbv;
      g.lineWidth = revealed ? 1.8 : crowd ? 0.6 : 1.4;
      g.setLineDash(revealed || crowd ? [] : [5, 3]);
      g.stroke();
    }
    g.setLineDash([]);
  }

  /// The object asked about, what covers it, and the line to it.
  pick({ world, view, picked }) {
    const g = this.context, p = world.pose;
    const outline = (id, colour, width) => {
      const slot = world.slots.get(id);
      if (slot === undefined) return undefined;
      g.beginPath();
      this.trace(world.records[slot], p, slot * stride);
      g.strokeStyle = colour;
      g.lineWidth = width;
      g.stroke();
      return slot;
    };
    if (picked?.id === undefined) return;
    this.fillCells(picked.cells, colours.pick, 0.3);
    for (const id of picked.by ?? []) outline(id, colours.blocker, 3.5);
    const slot = outline(picked.id, colours.pick, 4);
    if (slot === undefined) return;
    const at = slot * stride, sees = picked.sees?.[0];
    const end = sees ?? [p[at], p[at + 1]];
    const x = this.x(end[0]), y = this.y(end[1]);
    if (view) {
      g.beginPath();
      g.moveTo(this.x(view.position[0]), this.y(view.position[1]));
      g.lineTo(x, y);
      g.strokeStyle = colours.pick;
      g.lineWidth = 1.6;
      g.setLineDash(sees ? [] : [4, 4]);
      g.stroke();
      g.setLineDash([]);
      if (sees) {
        g.beginPath();
        g.arc(x, y, 3.5, 0, 2 * Math.PI);
        g.fillStyle = colours.pick;
        g.fill();
      }
    }
    this.ring(p[at], p[at + 1], Math.max(14, world.records[slot].reach * this.camera.scale + 7));
  }

  /// Small objects are found again by the ring about them.
  ring(wx, wy, radius) {
    const g = this.context;
    g.beginPath();
    g.arc(this.x(wx), this.y(wy), radius, 0, 2 * Math.PI);
    g.strokeStyle = colours.pick;
    g.lineWidth = 1.5;
    g.stroke();
  }

  /// A dot with a pointer along the viewing direction.
  eye(view) {
    const g = this.context, x = this.x(view.position[0]), y = this.y(view.position[1]), c = Math.cos(view.heading), s = -Math.sin(view.heading);
    g.fillStyle = colours.eye;
    g.strokeStyle = colours['eye-line'];
    g.lineWidth = 1.5;
    g.beginPath();
    g.moveTo(x - 5 * s, y + 5 * c);
    g.lineTo(x + 19 * c, y + 19 * s);
    g.lineTo(x + 5 * s, y - 5 * c);
    g.closePath();
    g.fill();
    g.stroke();
    g.beginPath();
    g.arc(x, y, 6, 0, 2 * Math.PI);
    g.fill();
    g.stroke();
  }
}
