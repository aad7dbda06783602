// What becomes of each object for one viewer: beyond its view volume, hidden in it, in the PVS, or what it rides on.
// Bounds are balls here, so that an object at the border of the view may be called hidden; the PVS is the server's.
import { stride } from './world.js';

export const Fate = { beyond: 0, unseen: 1, seen: 2, own: 3 };

export function rotate([w, x, y, z], [a, b, c]) {
  const tx = 2 * (y * c - z * b), ty = 2 * (z * a - x * c), tz = 2 * (x * b - y * a);
  return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx];
}

function sectorTest(view) {
  const [x, y] = view.position, half = view.fov / 2, range = view.range ?? Infinity, all = view.fov > 2 * Math.PI - 1e-9;
  return (px, py, _pz, radius) => {
    const dx = px - x, dy = py - y, distance = Math.hypot(dx, dy);
    if (distance > range + radius) return false;
    if (all || distance <= radius) return true;
    let off = Math.abs(Math.atan2(dy, dx) - view.heading) % (2 * Math.PI);
    if (off > Math.PI) off = 2 * Math.PI - off;
    return off <= half + Math.asin(radius / distance);
  };
}

function frustumTest(view) {
  const [x, y, z] = view.position, range = view.range ?? Infinity;
  if (!view.frustum) return (px, py, pz, radius) => Math.hypot(px - x, py - y, pz - z) <= range + radius;
  const { fov_y, aspect, near = 0, far = Infinity } = view.frustum;
  const ty = Math.tan(fov_y / 2), tx = ty * aspect, cy = Math.hypot(1, ty), cx = Math.hypot(1, tx);
  const ahead = rotate(view.orientation, [1, 0, 0]), left = rotate(view.orientation, [0, 1, 0]), up = rotate(view.orientation, [0, 0, 1]);
  return (px, py, pz, radius) => {
    const dx = px - x, dy = py - y, dz = pz - z;
    if (Math.hypot(dx, dy, dz) > range + radius) return false;
    const depth = dx * ahead[0] + dy * ahead[1] + dz * ahead[2];
    if (depth < near - radius || depth > far + radius) return false;
    const side = Math.abs(dx * left[0] + dy * left[1] + dz * left[2]), height = Math.abs(dx * up[0] + dy * up[1] + dz * up[2]);
    return (side - depth * tx) / cx <= radius && (height - depth * ty) / cy <= radius;
  };
}

export class Fates {
  constructor() {
    this.of = new Uint8Array(64); // by slot
    this.counts = [0, 0, 0, 0];
  }

  /// Without a view all is beyond it.
  update(world, view, visible) {
    const slots = world.records.length;
    if (this.of.length < slots) this.of = new Uint8Array(2 * slots);
    this.of.fill(Fate.beyond);
    this.counts.fill(0);
    const inView = view && (world.dimension === 2 ? sectorTest(view) : frustumTest(view));
    for (let slot = 0; slot < slots; slot++) {
      const record = world.records[slot], at = slot * stride, p = world.pose;
      if (record && inView?.(p[at], p[at + 1], p[at + 2], record.reach)) this.of[slot] = Fate.unseen;
    }
    for (const id of visible ?? []) {
      const slot = world.slots.get(id);
      if (slot !== undefined) this.of[slot] = Fate.seen;
    }
    const own = world.slots.get(view?.rides);
    if (own !== undefined) this.of[own] = Fate.own;
    for (let slot = 0; slot < slots; slot++) if (world.records[slot]) this.counts[this.of[slot]]++;
  }
}
