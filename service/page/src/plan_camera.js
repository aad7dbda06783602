// The camera of the ground plan: what is where on the canvas, moved by pointer and wheel. Subclasses know what is hit.
import { fitCanvas } from './fit_canvas.js';

export class PlanCamera {
  constructor(canvas, { onPick, onMove }) {
    Object.assign(this, { canvas, onPick, onMove, camera: { x: 0, y: 0, scale: 1 }, follows: false });
    this.listen();
  }

  resize() { fitCanvas(this); }

  frame(centre, half) {
    this.camera = { x: centre[0], y: centre[1], scale: Math.min(this.width / half[0], this.height / half[1]) / 2 };
  }

  fit(bounds) {
    this.follows = false;
    const half = [0, 1].map((axis) => Math.max(0.52 * (bounds.max[axis] - bounds.min[axis]), 0.5));
    this.frame([0, 1].map((axis) => (bounds.min[axis] + bounds.max[axis]) / 2), half);
  }

  follow(view) {
    this.follows = true;
    if (!view) return;
    const half = 1.08 * (view.range ?? 0);
    if (half) this.frame(view.position, [half, half]);
  }

  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const x = this.worldX(px), y = this.worldY(py);
    this.camera.scale = Math.min(1e5, Math.max(1e-6, this.camera.scale * factor));
    this.camera.x += x - this.worldX(px);
    this.camera.y += y - this.worldY(py);
    this.onMove();
  }

  pan(dx, dy) {
    this.follows = false;
    this.camera.x -= dx / this.camera.scale;
    this.camera.y += dy / this.camera.scale;
    this.onMove();
  }

  x(x) { return (x - this.camera.x) * this.camera.scale + this.width / 2; }
  y(y) { return this.height / 2 - (y - this.camera.y) * this.camera.scale; }
  worldX(px) { return (px - this.width / 2) / this.camera.scale + this.camera.x; }
  worldY(py) { return (this.height / 2 - py) / this.camera.scale + this.camera.y; }

  listen() {
    const { canvas } = this;
    let from = null;
    canvas.addEventListener('pointerdown', (event) => {
      from = { x: event.clientX, y: event.clientY, moved: false };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!from) return;
      const dx = event.clientX - from.x, dy = event.clientY - from.y;
      if (!from.moved && Math.hypot(dx, dy) < 4) return;
      from = { x: event.clientX, y: event.clientY, moved: true };
      this.pan(dx, dy);
    });
    canvas.addEventListener('pointerup', (event) => {
      if (from && !from.moved) this.onPick(this.hit(event.offsetX, event.offsetY));
      from = null;
    });
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY / 400), event.offsetX, event.offsetY);
    }, { passive: false });
  }
}
