// Boxes of cells that share a whole side become one: the server sends rows of cells, thousands of which lie on each other,
// and all that lies within is painted for nothing.

/// Joins along one axis (0, 1, 2) those that agree in the other two.
function along(boxes, axis) {
  const [a, b] = [0, 1, 2].filter((other) => other !== axis), groups = new Map();
  for (const box of boxes) {
    const key = `${box[a]},${box[a + 3]},${box[b]},${box[b + 3]}`, group = groups.get(key);
    if (group) group.push(box);
    else groups.set(key, [box]);
  }
  const joined = [];
  for (const group of groups.values()) {
    group.sort((p, q) => p[axis] - q[axis]);
    let last = null;
    for (const box of group) {
      if (last && last[axis + 3] === box[axis]) last[axis + 3] = box[axis + 3];
      else joined.push(last = box.slice());
    }
  }
  return joined;
}

/// Boxes as [x0, y0, z0, x1, y1, z1]; the given ones are left as they are.
export const merged = (boxes) => (boxes.length < 2 ? boxes : along(along(along(boxes, 0), 1), 2));
