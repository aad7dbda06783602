// Cells as instanced boxes with edges, TBVs as instanced balls.
import { Color, InstancedMesh, Matrix4, MeshBasicMaterial, MeshLambertMaterial, Quaternion, Vector3 } from 'three';
import { unitBall, unitBox } from './solids.js';
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
  'seen-area': { cells: 'visited', colour: 'visited', opacity: 0.1 },
  hidden: { cells: 'hidden', colour: 'unseen-line', opacity: 0.1 },
  opaque: { cells: 'opaque', colour: 'opaque', opacity: 1 },
  touched: { cells: 'touched', colour: 'touched', opacity: 0.22 },
  tbv: { cells: 'tbv', colour: 'tbv-cell', opacity: 0.16 },
  volume: { cells: 'line_of_sight', colour: 'sight', opacity: 0.7 },
};

export class Cells3d {
  constructor(scene) {
    this.layers = Object.entries(styles).map(([key, style], i) => {
      const clear = style.opacity < 1;
      const Material = clear ? MeshBasicMaterial : MeshLambertMaterial;
      const material = new Material({ transparent: clear, opacity: style.opacity, depthWrite: !clear });
      return { key, ...style, material, copies: new Instances(scene, unitBox(), material, 10 + i) };
    });
    const balls = () => new MeshBasicMaterial({ wireframe: true, transparent: true, opacity: 0.25 });
    this.volumes = new Instances(scene, unitBall(), balls(), 20);
    this.revealed = new Instances(scene, unitBall(), balls(), 21);
  }

  recolour(colours) {
    for (const layer of this.layers) layer.material.color = new Color(colours[layer.colour]);
    this.volumes.material.color = new Color(colours.tbv);
    this.revealed.material.color = new Color(colours.revealed);
  }

  update({ drawn, on }) {
    for (const layer of this.layers) layer.copies.fill((on[layer.key] && drawn?.cells?.[layer.cells]) || [], box);
    const volumes = (on.tbv && drawn?.volumes) || [];
    this.volumes.fill(volumes.filter((v) => !v.revealed), ball);
    this.revealed.fill(volumes.filter((v) => v.revealed), ball);
  }
}
