// All objects of a 3D world as a few draw calls: instanced balls and boxes, one batch for the other shapes. Objects in
// the PVS, the rest, and what the viewer rides on are apart, since the viewer's pane draws the first only.
import { BatchedMesh, Color, DynamicDrawUsage, Group, InstancedMesh, Matrix4, MeshLambertMaterial, Quaternion, Vector3 } from 'three';
import { withEdges } from './edges.js';
import { coarseBall, geometryOf, kindOf, unitBall, unitBox } from './solids.js';
import { Fate } from './fate.js';
import { stride } from './world.js';

const position = new Vector3(), turn = new Quaternion(), scale = new Vector3(), matrix = new Matrix4();

const many = 1500;

function placed(record, pose, slot) {
  const at = slot * stride, { shape } = record;
  position.set(pose[at], pose[at + 1], pose[at + 2]);
  turn.set(pose[at + 4], pose[at + 5], pose[at + 6], pose[at + 3]);
  if (shape.type === 'sphere') scale.setScalar(shape.radius);
  else if (shape.type === 'box') scale.set(...shape.size);
  else scale.setScalar(1);
  return matrix.compose(position, turn, scale);
}

/// Copies of one geometry, as many as a frame needs.
class Copies {
  /// `coarse`: the geometry that stands in where there are thousands.
  constructor(geometry, material, group, coarse = geometry) {
    Object.assign(this, { geometry, material, group, coarse, ids: [] });
    this.grow(64);
  }

  grow(count) {
    if (this.mesh) {
      this.group.remove(this.mesh);
      this.mesh.dispose();
    }
    this.mesh = new InstancedMesh(this.geometry, this.material, count);
    this.mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    this.mesh.setColorAt(0, new Color());
    this.mesh.frustumCulled = false;
    this.mesh.userData.ids = this.ids;
    this.group.add(this.mesh);
  }

  begin(most) {
    if (most > this.mesh.instanceMatrix.count) this.grow(2 * most);
    this.ids.length = 0;
  }

  add(id, place, colour) {
    this.mesh.setMatrixAt(this.ids.length, place);
    this.mesh.setColorAt(this.ids.length, colour);
    this.ids.push(id);
  }

  end() {
    this.mesh.count = this.ids.length;
    this.mesh.geometry = this.ids.length > many ? this.coarse : this.geometry;
    this.mesh.visible = this.ids.length > 0;
    this.mesh.instanceMatrix.needsUpdate = this.mesh.instanceColor.needsUpdate = true;
    this.mesh.boundingSphere = null; // clicks are told by it
  }
}

/// Prisms, convex bodies and faces: one batch, built anew only when objects come or go.
class Batch {
  constructor(material, group) {
    Object.assign(this, { material, group, instances: new Map() });
  }

  build(world) {
    const wanted = [], geometries = new Map();
    let vertices = 0;
    for (const [id, slot] of world.slots) {
      const kind = kindOf(world.records[slot].shape);
      if (kind === 'ball' || kind === 'box') continue;
      if (!geometries.has(kind)) {
        const geometry = geometryOf(world.records[slot].shape);
        geometries.set(kind, geometry);
        vertices += geometry.attributes.position.count;
      }
      wanted.push([id, kind]);
    }
    if (this.mesh) {
      this.group.remove(this.mesh);
      this.mesh.dispose();
    }
    this.instances.clear();
    this.mesh = null;
    if (!wanted.length) return;
    this.mesh = new BatchedMesh(wanted.length, vertices, 0, this.material);
    this.mesh.frustumCulled = this.mesh.perObjectFrustumCulled = this.mesh.sortObjects = false;
    const numbers = new Map([...geometries].map(([kind, geometry]) => [kind, this.mesh.addGeometry(geometry)]));
    this.mesh.userData.ids = [];
    for (const [id, kind] of wanted) {
      const instance = this.mesh.addInstance(numbers.get(kind));
      this.instances.set(id, instance);
      this.mesh.userData.ids[instance] = id;
    }
    this.group.add(this.mesh);
  }

  begin() { for (const instance of this.instances.values()) this.mesh.setVisibleAt(instance, false); }

  add(id, place, colour) {
    const instance = this.instances.get(id);
    this.mesh.setMatrixAt(instance, place);
    this.mesh.setColorAt(instance, colour);
    this.mesh.setVisibleAt(instance, true);
  }
}

class Set3d {
  constructor(scene, look, layers, order = 0) {
    this.group = new Group();
    this.ball = new Copies(unitBall(), new MeshLambertMaterial(look), this.group, coarseBall());
    this.box = new Copies(unitBox(), withEdges(new MeshLambertMaterial(look), { alpha: look.transparent ? 0.75 : 0 }), this.group);
    this.batch = new Batch(new MeshLambertMaterial(look), this.group);
    Object.assign(this, { layers, order });
    scene.add(this.group);
  }

  of(kind) { return kind === 'ball' ? this.ball : kind === 'box' ? this.box : this.batch; }

  end() {
    this.ball.end();
    this.box.end();
    for (const mesh of this.group.children) {
      mesh.layers.mask = this.layers;
      mesh.renderOrder = this.order;
    }
  }
}

export const worldPane = 1, eyePane = 2; // masks of camera layers

export class Objects3d {
  constructor(scene) {
    this.seen = new Set3d(scene, { transparent: true }, worldPane | eyePane);
    this.own = new Set3d(scene, {}, worldPane);
    this.rest = new Set3d(scene, { transparent: true, opacity: 0.3, depthWrite: false }, worldPane, 1);
    this.colour = Object.fromEntries(['seen', 'own', 'pick', 'blocker', 'unseen', 'beyond'].map((name) => [name, new Color()]));
  }

  recolour(colours) {
    for (const name of ['seen', 'own', 'pick', 'blocker']) this.colour[name].set(colours[name]);
    this.colour.unseen.set(colours.dark ? '#8b97a6' : '#76818f');
    this.colour.beyond.set(colours.dark ? '#4a5461' : '#c3c9d1');
  }

  update({ world, fates, on, picked }) {
    if (this.world !== world || this.changes !== world.changes) {
      this.seen.batch.build(world);
      this.rest.batch.build(world);
      this.own.batch.build(world);
      this.world = world;
      this.changes = world.changes;
    }
    for (const set of [this.seen, this.rest, this.own]) {
      set.ball.begin(world.size);
      set.box.begin(world.size);
      set.batch.begin();
    }
    const by = new Set(picked?.by);
    for (const [id, slot] of world.slots) {
      const record = world.records[slot], fate = fates.of[slot], marked = id === picked?.id || by.has(id);
      if (!marked && ((fate === Fate.unseen && !on.unseen) || (fate === Fate.beyond && !on.beyond))) continue;
      const set = fate === Fate.own ? this.own : fate === Fate.seen ? this.seen : this.rest;
      const colour = id === picked?.id ? this.colour.pick : by.has(id) ? this.colour.blocker :
        [this.colour.beyond, this.colour.unseen, this.colour.seen, this.colour.own][fate];
      set.of(kindOf(record.shape)).add(id, placed(record, world.pose, slot), colour);
    }
    this.seen.end();
    this.rest.end();
    this.own.end();
  }

  /// Opaque cells lie within objects, so that these have to let them through.
  showThrough(opacity) {
    for (const copies of [this.seen.ball, this.seen.box, this.seen.batch]) copies.material.opacity = opacity;
  }

  /// The id that a ray meets first; what is seen comes before what is drawn as if of glass.
  hit(raycaster) {
    for (const set of [this.own, this.seen, this.rest]) {
      for (const { object, instanceId, batchId } of raycaster.intersectObjects(set.group.children, false)) {
        const id = object.userData.ids[instanceId ?? batchId];
        if (id !== undefined) return id;
      }
    }
    return undefined;
  }
}
