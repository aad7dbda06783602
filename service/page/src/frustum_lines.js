// A 3D view volume as lines: the frustum's edges, or circles about a viewer that looks everywhere; and where it heads.
import { rotate } from './fate.js';

const along = (p, ...terms) => p.map((v, i) => terms.reduce((sum, [d, t]) => sum + d[i] * t, v));

function circle(centre, a, b, radius) {
  const points = [];
  for (let i = 0; i < 64; i++) {
    for (const step of [i, i + 1]) {
      const t = (step / 64) * 2 * Math.PI;
      points.push(along(centre, [a, radius * Math.cos(t)], [b, radius * Math.sin(t)]));
    }
  }
  return points;
}

export function frustumLines(view, bounds) {
  const [ahead, left, up] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => rotate(view.orientation, axis));
  const size = Math.hypot(...bounds.max.map((v, i) => v - bounds.min[i]));
  const range = Math.min(view.range ?? Infinity, size), eye = view.position;
  if (!view.frustum) {
    const rings = view.range ? [...circle(eye, [1, 0, 0], [0, 1, 0], range), ...circle(eye, ahead, up, range)] : [];
    return [...rings, eye, along(eye, [ahead, 0.12 * size])];
  }
  const { fov_y, aspect, near = 0, far = Infinity } = view.frustum;
  const ty = Math.tan(fov_y / 2), tx = ty * aspect, depth = Math.min(far, range);
  const corner = (d, sx, sy) => along(eye, [ahead, d], [left, d * tx * sx], [up, d * ty * sy]);
  const signs = [[-1, -1], [1, -1], [1, 1], [-1, 1]], lines = [];
  signs.forEach(([sx, sy], i) => {
    const [nx, ny] = signs[(i + 1) % 4];
    lines.push(corner(near, sx, sy), corner(depth, sx, sy), corner(depth, sx, sy), corner(depth, nx, ny));
    if (near > 0) lines.push(corner(near, sx, sy), corner(near, nx, ny));
  });
  // The line of sight is dashed, as in the paper's figures.
  for (let i = 0; i < 40; i += 2) lines.push(along(eye, [ahead, (i / 40) * depth]), along(eye, [ahead, ((i + 1) / 40) * depth]));
  return lines;
}
