// The world as the session tells it: records of objects and their poses, moved on frame by frame.

/// Numbers a pose: position, then a unit quaternion (w, x, y, z) in 3D or the heading in 2D.
export const stride = 7;

const turn = (heading) => [Math.cos(heading / 2), 0, 0, Math.sin(heading / 2)];

/// The farthest that a shape reaches from its object's position, in metres.
export function reach(shape) {
  if (shape.radius) return shape.radius;
  if (shape.size) return 0.5 * Math.hypot(...shape.size);
  let farthest = 0;
  for (const vertex of shape.vertices ?? []) farthest = Math.max(farthest, Math.hypot(...vertex));
  return shape.height ? Math.hypot(farthest, shape.height) : farthest;
}

export class World {
  constructor(dimension) {
    this.dimension = dimension;
    this.slots = new Map(); // id -> slot
    this.records = []; // slot -> what does not change, or null where nobody is
    this.pose = new Float64Array(64 * stride);
    this.free = [];
    this.changes = 0; // grows when objects come or go
  }

  static from(scene) {
    const world = new World(scene.dimension);
    for (const object of scene.objects) world.add(object);
    return world;
  }

  get size() { return this.slots.size; }

  clone() {
    const other = new World(this.dimension);
    other.slots = new Map(this.slots);
    other.records = this.records.slice();
    other.pose = this.pose.slice();
    other.free = this.free.slice();
    other.changes = this.changes;
    return other;
  }

  record(id) {
    const slot = this.slots.get(id);
    return slot === undefined ? undefined : this.records[slot];
  }

  add(object) {
    const slot = this.free.pop() ?? this.records.length;
    if ((slot + 1) * stride > this.pose.length) {
      const larger = new Float64Array(2 * this.pose.length);
      larger.set(this.pose);
      this.pose = larger;
    }
    this.slots.set(object.id, slot);
    this.records[slot] = {
      id: object.id, name: object.name ?? '', shape: object.shape, isStatic: object.static === true,
      occluder: object.occluder !== false, maxSpeed: object.max_speed, reach: reach(object.shape),
    };
    this.pose.fill(0, slot * stride, (slot + 1) * stride);
    if (this.dimension === 3) this.pose[slot * stride + 3] = 1;
    this.place(slot, object);
    this.changes++;
  }

  remove(id) {
    const slot = this.slots.get(id);
    if (slot === undefined) return;
    this.slots.delete(id);
    this.records[slot] = null;
    this.free.push(slot);
    this.changes++;
  }

  place(slot, { position, heading, orientation }) {
    const at = slot * stride;
    if (position) for (let axis = 0; axis < position.length; axis++) this.pose[at + axis] = position[axis];
    if (this.dimension === 2) {
      if (heading !== undefined) this.pose[at + 3] = heading;
    } else {
      const q = orientation ?? (heading === undefined ? undefined : turn(heading));
      if (q) for (let i = 0; i < 4; i++) this.pose[at + 3 + i] = q[i];
    }
  }

  /// One line of gridcull.frames/1, in the order that the format prescribes.
  apply(frame) {
    for (const id of frame.remove ?? []) this.remove(id);
    for (const object of frame.add ?? []) this.add(object);
    for (const item of frame.set ?? []) {
      const slot = this.slots.get(item.id);
      if (slot !== undefined) this.place(slot, item);
    }
  }
}
