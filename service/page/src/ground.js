// The ground of a 3D world: lines a round number of metres apart, cut into short pieces.
export function groundLines({ min, max }) {
  const side = Math.max(max[0] - min[0], max[1] - min[1]), power = 10 ** Math.floor(Math.log10(side / 10));
  const step = power * ([1, 2, 5, 10].find((n) => n * power >= side / 24) ?? 10), z = Math.max(min[2], Math.min(0, max[2]));
  const ticks = (axis) => {
    const list = [min[axis]];
    for (let i = Math.floor(min[axis] / step) + 1; i * step < max[axis]; i++) list.push(i * step);
    return [...list, max[axis]];
  };
  const xs = ticks(0), ys = ticks(1), ends = [];
  for (let i = 0; i < xs.length; i++) {
    for (let j = 0; j < ys.length; j++) {
      if (i) ends.push([xs[i - 1], ys[j], z], [xs[i], ys[j], z]);
      if (j) ends.push([xs[i], ys[j - 1], z], [xs[i], ys[j], z]);
    }
  }
  return ends;
}
