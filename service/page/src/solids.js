// 3D shapes as geometries. Spheres and boxes share one each and are scaled; the others have one a shape.
import { BoxGeometry, BufferAttribute, BufferGeometry, ExtrudeGeometry, IcosahedronGeometry, Shape, Vector2, Vector3 } from 'three';
import { ConvexGeometry } from 'three/addons/geometries/ConvexGeometry.js';

/// Round enough for a few, and for thousands.
export const unitBall = () => new IcosahedronGeometry(1, 3);
export const coarseBall = () => new IcosahedronGeometry(1, 1);
export const unitBox = () => new BoxGeometry(1, 1, 1);

/// 'ball', 'box', or a key that shapes alike share.
const keys = new WeakMap();
export function kindOf(shape) {
  if (shape.type === 'sphere') return 'ball';
  if (shape.type === 'box') return 'box';
  let key = keys.get(shape);
  if (!key) keys.set(shape, key = JSON.stringify(shape));
  return key;
}

function raw(shape) {
  if (shape.type === 'prism') {
    const outline = new Shape(shape.vertices.map(([x, y]) => new Vector2(x, y)));
    return new ExtrudeGeometry(outline, { depth: shape.height, bevelEnabled: false });
  }
  if (shape.type === 'convex') return new ConvexGeometry(shape.vertices.map((v) => new Vector3(...v)));
  if (shape.type === 'faces') {
    // Both sides: a wall is seen from either.
    const corners = shape.triangles.flatMap(([a, b, c]) => [a, b, c, c, b, a].flatMap((i) => shape.vertices[i]));
    return new BufferGeometry().setAttribute('position', new BufferAttribute(Float32Array.from(corners), 3));
  }
  return new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(9), 3)); // nothing to draw
}

/// Positions and normals only, without an index: geometries of one batch must be alike.
export function geometryOf(shape) {
  const made = raw(shape), geometry = made.index ? made.toNonIndexed() : made;
  for (const name of Object.keys(geometry.attributes)) if (name !== 'position') geometry.deleteAttribute(name);
  geometry.clearGroups();
  geometry.computeVertexNormals();
  return geometry;
}
