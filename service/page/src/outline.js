// 2D shapes as outlines in the object's own frame, worked out once a shape, and what a click hits.
const cache = new WeakMap();

/// `{kind: 'disc', radius}`, or `{kind: 'box'|'ring'|'chain', points: Float64Array [x, y, ...]}`.
export function outlineOf(shape) {
  let outline = cache.get(shape);
  if (!outline) cache.set(shape, outline = made(shape));
  return outline;
}

function made(shape) {
  if (shape.type === 'disc') return { kind: 'disc', radius: shape.radius };
  if (shape.type === 'box') {
    const [l, w] = shape.size.map((side) => side / 2);
    return { kind: 'box', points: Float64Array.of(-l, -w, l, -w, l, w, -l, w) };
  }
  return { kind: shape.type === 'polyline' ? 'chain' : 'ring', points: Float64Array.from(shape.vertices.flat()) };
}

/// Metres from a point (in the object's frame) to the shape; 0 inside.
export function distanceTo(outline, x, y) {
  if (outline.kind === 'disc') return Math.max(0, Math.hypot(x, y) - outline.radius);
  const p = outline.points, n = p.length / 2;
  let inside = false, nearest = Infinity;
  for (let i = 0, j = n - 1; i < n; j = i++) {
    const ax = p[2 * j], ay = p[2 * j + 1], bx = p[2 * i], by = p[2 * i + 1];
    if ((ay > y) !== (by > y) && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) inside = !inside;
    if (outline.kind === 'chain' && i === 0) continue; // it does not close
    const dx = bx - ax, dy = by - ay, length = dx * dx + dy * dy;
    const t = length ? Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / length)) : 0;
    nearest = Math.min(nearest, Math.hypot(x - ax - t * dx, y - ay - t * dy));
  }
  return inside && outline.kind !== 'chain' ? 0 : nearest;
}
