// The world in 3D, as in Figure 6 of Batagelo and Wu 2002: cells, objects, TBVs and the view volume from outside, and
// what the viewer sees in a second pane, for which only its PVS is drawn.
import {
  AmbientLight, Box3, Box3Helper, BufferAttribute, BufferGeometry, Color, DirectionalLight, LineBasicMaterial, LineSegments,
  PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Cells3d } from './cells3d.js';
import { colours } from './colours.js';
import { rotate } from './fate.js';
import { eyePane, Objects3d, worldPane } from './objects3d.js';
import { frustumLines } from './frustum_lines.js';
import { groundLines } from './ground.js';
import { stride } from './world.js';

const widest = 0.42, tallest = 0.56; // of the stage, for the viewer's pane
const edge = 10; // pixels about it

class Lines {
  constructor(scene, mask) {
    this.object = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
    this.object.frustumCulled = false;
    this.object.renderOrder = 30;
    this.object.layers.mask = mask;
    scene.add(this.object);
  }

  /// Pairs of ends.
  set(points, colour) {
    this.object.visible = points.length > 0;
    this.object.material.color.set(colour);
    this.object.geometry.dispose();
    this.object.geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(Float32Array.from(points.flat()), 3));
  }
}

export class View3d {
  constructor(canvas, { onPick, onMove }) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.renderer.autoClear = false;
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(45, 1, 0.1, 1000);
    this.camera.up.set(0, 0, 1);
    this.eye = new PerspectiveCamera(60, 1, 0.1, 1000);
    this.camera.layers.mask = worldPane;
    this.eye.layers.mask = eyePane;
    const sun = new DirectionalLight(0xffffff, 2.2);
    sun.position.set(-0.5, -0.9, 1.6);
    for (const light of [sun, new AmbientLight(0xffffff, 1.5)]) {
      light.layers.mask = worldPane | eyePane;
      this.scene.add(light);
    }
    this.objects = new Objects3d(this.scene);
    this.cells = new Cells3d(this.scene);
    this.floor = new Lines(this.scene, worldPane | eyePane);
    this.volume = new Lines(this.scene, worldPane);
    this.sight = new Lines(this.scene, worldPane);
    this.marker = new Lines(this.scene, worldPane);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => onMove());
    this.raycaster = new Raycaster();
    this.follows = false;
    this.listen(onPick);
    this.recolour();
  }

  recolour() {
    this.objects.recolour(colours);
    this.cells.recolour(colours);
    this.bounds = null; // the ground is made anew
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === this.width && height === this.height) return;
    Object.assign(this, { width, height });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio || 1, 2));
    this.renderer.setSize(width, height, false);
  }

  // -- the camera
  fit(bounds) {
    this.follows = false;
    const box = new Box3(new Vector3(...bounds.min), new Vector3(...bounds.max)), size = box.getSize(new Vector3()).length();
    box.getCenter(this.controls.target);
    this.camera.position.copy(this.controls.target).add(new Vector3(-0.42, -0.72, 0.62).normalize().multiplyScalar(1.22 * size));
    this.camera.near = size / 500;
    this.camera.far = size * 20;
    this.controls.update();
  }

  follow(view) {
    this.follows = true;
    if (view) this.stay(view.position);
  }

  stay(position) {
    const move = new Vector3(...position).sub(this.controls.target);
    this.controls.target.add(move);
    this.camera.position.add(move);
    this.controls.update();
  }

  zoom(factor) {
    this.camera.position.sub(this.controls.target).divideScalar(factor).add(this.controls.target);
    this.controls.update();
  }

  pan(dx, dy) {
    this.follows = false;
    const metres = this.camera.position.distanceTo(this.controls.target) / this.height;
    const right = new Vector3().setFromMatrixColumn(this.camera.matrix, 0), up = new Vector3().setFromMatrixColumn(this.camera.matrix, 1);
    const move = right.multiplyScalar(-dx * metres).addScaledVector(up, dy * metres);
    this.controls.target.add(move);
    this.camera.position.add(move);
    this.controls.update();
  }

  listen(onPick) {
    let from = null;
    this.canvas.addEventListener('pointerdown', (event) => {
      from = { x: event.offsetX, y: event.offsetY };
      this.controls.enabled = !this.inPane(from);
    }, { capture: true });
    this.canvas.addEventListener('pointerup', (event) => {
      if (from && Math.hypot(event.offsetX - from.x, event.offsetY - from.y) < 4) onPick(this.hit(event.offsetX, event.offsetY));
      from = null;
    });
  }

  inPane({ x, y }) {
    const p = this.pane;
    return p && x >= p.x && x < p.x + p.width && y >= p.y && y < p.y + p.height;
  }

  hit(x, y) {
    const inner = this.inPane({ x, y }), p = inner ? this.pane : { x: 0, y: 0, width: this.width, height: this.height };
    const camera = inner ? this.eye : this.camera;
    this.raycaster.setFromCamera(new Vector2(((x - p.x) / p.width) * 2 - 1, 1 - ((y - p.y) / p.height) * 2), camera);
    this.raycaster.layers.mask = camera.layers.mask;
    return this.objects.hit(this.raycaster);
  }

  // -- the picture; `shown` as in View2d
  draw(shown) {
    const { view, lattice } = shown;
    if (this.bounds !== lattice.bounds) this.ground(lattice);
    if (this.shown !== shown || shown.changed) {
      this.shown = shown;
      shown.changed = false;
      this.objects.update(shown);
      this.cells.update(shown);
      this.lines(shown);
      if (this.follows && view) this.stay(view.position);
    }
    this.pane = view ? this.paneFor(view) : null;
    const shift = this.pane ? 0.4 * this.pane.width : 0; // the middle of what the pane leaves free
    this.camera.aspect = this.width / this.height;
    this.camera.setViewOffset(this.width, this.height, shift, 0, this.width, this.height);
    this.objects.showThrough(shown.on.opaque && shown.drawn?.cells?.opaque?.length ? 0.55 : 1);
    this.paint(this.camera, { x: 0, y: 0, width: this.width, height: this.height }, colours.map);
    if (!view) return;
    this.aim(view, lattice);
    this.objects.showThrough(1);
    this.paint(this.eye, this.pane, colours.dark ? '#10151b' : '#dfe9f3');
  }

  paint(camera, { x, y, width, height }, background) {
    const { renderer } = this, foot = this.height - y - height;
    renderer.setScissorTest(true);
    renderer.setViewport(x, foot, width, height);
    renderer.setScissor(x, foot, width, height);
    renderer.setClearColor(new Color(background));
    renderer.clear();
    renderer.render(this.scene, camera);
  }

  paneFor(view) {
    const aspect = view.frustum?.aspect ?? 4 / 3;
    const width = Math.round(Math.min(widest * this.width, tallest * this.height * aspect)), height = Math.round(width / aspect);
    return { x: this.width - width - edge, y: edge, width, height };
  }

  /// Without a frustum the viewer looks everywhere; its pane shows what is ahead.
  aim(view, { bounds }) {
    const ahead = rotate(view.orientation, [1, 0, 0]), up = rotate(view.orientation, [0, 0, 1]), [x, y, z] = view.position;
    const size = Math.hypot(...bounds.max.map((v, i) => v - bounds.min[i]));
    const eye = this.eye;
    eye.fov = ((view.frustum?.fov_y ?? 1.2) * 180) / Math.PI;
    eye.aspect = this.pane.width / this.pane.height;
    eye.near = Math.max(view.frustum?.near ?? 0, 0.05);
    eye.far = Math.max(Math.min(view.frustum?.far ?? Infinity, view.range ?? Infinity, 4 * size), 2 * eye.near);
    eye.position.set(x, y, z);
    eye.up.set(...up);
    eye.lookAt(x + ahead[0], y + ahead[1], z + ahead[2]);
    eye.updateProjectionMatrix();
  }

  ground({ bounds }) {
    this.bounds = bounds;
    for (const old of this.fixed ?? []) this.scene.remove(old);
    const box = new Box3(new Vector3(...bounds.min), new Vector3(...bounds.max));
    const frame = new Box3Helper(box, new Color(colours['beyond-line']));
    Object.assign(frame.material, { transparent: true, opacity: 0.6 });
    frame.layers.mask = worldPane;
    this.floor.set(groundLines(bounds), colours.line);
    this.fixed = [frame];
    this.scene.add(frame);
  }

  lines({ view, on, picked, world, lattice }) {
    this.volume.set(view && on.volume ? frustumLines(view, lattice.bounds) : [], colours.volume);
    this.marker.set(view ? this.cross(view.position, lattice.bounds) : [], colours.eye);
    const slot = picked?.id === undefined ? undefined : world.slots.get(picked.id);
    if (!view || slot === undefined) return this.sight.set([], colours.pick);
    const end = picked.sees?.[0] ?? Array.from(world.pose.subarray(slot * stride, slot * stride + 3));
    this.sight.set([view.position, end], colours.pick);
  }

  cross(position, bounds) {
    const arm = 0.012 * Math.hypot(...bounds.max.map((v, i) => v - bounds.min[i]));
    const ends = [];
    for (let axis = 0; axis < 3; axis++) {
      for (const sign of [-1, 1]) ends.push(position.map((v, i) => (i === axis ? v + sign * arm : v)));
    }
    return ends;
  }
}
