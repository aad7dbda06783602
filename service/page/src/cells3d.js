// Cells as instanced boxes that show the lattice, TBVs as instanced balls.
import { Color, InstancedMesh, Matrix4, MeshBasicMaterial, MeshLambertMaterial, Quaternion, Vector3 } from 'three';
import { latticeUniforms, withEdges } from './edges.js';
import { merged } from './merge.js';
import { coarseBall, unitBox } from './solids.js';
import { worldPane } from './objects3d.js';

const none = new Quaternion(), position = new Vector3(), scale = new Vector3(), matrix = new Matrix4();

class Instances {
  constructor(scene, geometry, material, order) {
    Object.assign(this, { scene, geometry, material, order });
    this.grow(256);
  }

  grow(count) {
    if (this.mesh) {
      this.scene.remove(this.mesh);
      this.mesh.dispose();
    }
    this.mesh = new InstancedMesh(this.geometry, this.material, count);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = this.order;
    this.mesh.layers.mask = worldPane;
    this.scene.add(this.mesh);
  }

  /// `place(item)` sets `position` and `scale`.
  fill(items, place) {
    if (items.length > this.mesh.instanceMatrix.count) this.grow(2 * items.length);
    items.forEach((item, i) => {
      place(item);
      this.mesh.setMatrixAt(i, matrix.compose(position, none, scale));
    });
    this.mesh.count = items.length;
    this.mesh.visible = items.length > 0;
    this.mesh.instanceMatrix.needsUpdate = true;
  }
}

const box = ([x0, y0, z0, x1, y1, z1]) => {
  position.set((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2);
  scale.set(x1 - x0, y1 - y0, z1 - z0);
};
const ball = ({ centre, radius }) => {
  position.set(...centre);
  scale.setScalar(radius);
};

const styles = {
  touched: { cells: 'touched', colour: 'touched', opacity: 0.3 },
  tbv: { cells: 'tbv', colour: 'tbv-cell', opacity: 0.3 },
  'seen-area': { cells: 'visited', colour: 'region-line', opacity: 0.25 },
  hidden: { cells: 'hidden', colour: 'hidden', opacity: 0.5 },
  opaque: { cells: 'opaque', colour: 'opaque', opacity: 1 },
  volume: { cells: 'line_of_sight', colour: 'sight', opacity: 0.7 },
};

export class Cells3d {
  constructor(scene) {
    this.lattice = latticeUniforms();
    this.layers = Object.entries(styles).map(([key, style], i) => {
      const clear = style.opacity < 1, material = withEdges(new MeshLambertMaterial({ transparent: clear, opacity: style.opacity }), { strength: 0.2, lattice: this.lattice });
      // Of clear cells only the nearest faces are painted: their depths go first. Thousands of panes one behind the other
      // would be as good as black.
      const depths = clear ? [new Instances(scene, unitBox(), new MeshBasicMaterial({ colorWrite: false, transparent: true }), 10 + 2 * i)] : [];
      return { key, ...style, material, copies: [...depths, new Instances(scene, unitBox(), material, 11 + 2 * i)] };
    });
    const balls = () => new MeshBasicMaterial({ wireframe: true, transparent: true, opacity: 0.25 });
    this.volumes = new Instances(scene, coarseBall(), balls(), 30);
    this.revealed = new Instances(scene, coarseBall(), balls(), 31);
  }

  recolour(colours) {
    for (const layer of this.layers) layer.material.color = new Color(colours[layer.colour]);
    this.volumes.material.color = new Color(colours.tbv);
    this.revealed.material.color = new Color(colours.revealed);
  }

  update({ drawn, on, lattice }) {
    this.lattice.origin.value.set(...lattice.bounds.min);
    this.lattice.cell.value = lattice.cell;
    for (const layer of this.layers) {
      const cells = merged((on[layer.key] && drawn?.cells?.[layer.cells]) || []);
      for (const copies of layer.copies) copies.fill(cells, box);
    }
    const volumes = (on.tbv && drawn?.volumes) || [];
    this.volumes.fill(volumes.filter((v) => !v.revealed), ball);
    this.revealed.fill(volumes.filter((v) => v.revealed), ball);
  }
}
