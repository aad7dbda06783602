// Numbers and objects in words.
export const count = (n, one, many = `${one}s`) => `${n.toLocaleString('en')} ${n === 1 ? one : many}`;

export const nameOf = (record) => (record?.name ? `${record.id} (${record.name})` : `${record?.id}`);

export const coordinates = (point) => `(${point.map((v) => v.toFixed(1)).join(', ')})`;

const lengths = (sizes) => `${sizes.map((v) => +v.toFixed(2)).join(' × ')} m`;

export function shapeInWords(shape) {
  switch (shape.type) {
    case 'disc': case 'sphere': return `${shape.type}, radius ${lengths([shape.radius])}`;
    case 'box': return `box, ${lengths(shape.size)}`;
    case 'prism': return `prism of ${shape.vertices.length} corners, ${lengths([shape.height])} high`;
    case 'faces': return count(shape.triangles.length, 'face');
    default: return `${shape.type} of ${count(shape.vertices?.length ?? 0, 'corner')}`;
  }
}

export const aboutObject = (record) => [
  shapeInWords(record.shape),
  record.isStatic ? 'static' : record.maxSpeed === undefined ? 'moving' : `moving, at most ${record.maxSpeed} m/s`,
  ...(record.occluder ? [] : ['hides nothing']),
].join('; ');
