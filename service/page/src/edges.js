// Draws the edges of boxes in their own material, however many copies there are and however they are scaled: a line of a
// pixel or so where a face ends. On boxes of cells the lines are those of the lattice, so that merged boxes show cells.
import { Vector3 } from 'three';

const declared = 'varying vec3 vAt;\n';

/// `strength`: 0 leaves the edges as they are, 1 makes them black; `alpha`: their least opacity; `lattice`: {origin, cell}
/// as uniforms (see latticeUniforms), else the sides of the unit box.
export function withEdges(material, { strength = 0.55, alpha = 0, lattice } = {}) {
  material.onBeforeCompile = (shader) => {
    if (lattice) Object.assign(shader.uniforms, lattice);
    const at = lattice ? '((instanceMatrix * vec4(position, 1.0)).xyz - origin) / cell' : 'position';
    shader.vertexShader = declared + (lattice ? 'uniform vec3 origin;\nuniform float cell;\n' : '') +
      shader.vertexShader.replace('#include <begin_vertex>', `#include <begin_vertex>\nvAt = ${at};`);
    shader.fragmentShader = declared + shader.fragmentShader.replace('#include <color_fragment>', `#include <color_fragment>
      vec3 aPixel = max(fwidth(vAt), vec3(1e-6));
      // Pixels to the next side by axis; on a face one of the three is nought, the next is that to its edge.
      vec3 off = ${lattice ? 'abs(fract(vAt - 0.5) - 0.5)' : '(0.5 - abs(vAt))'} / aPixel;
      float nearest = max(min(off.x, off.y), min(max(off.x, off.y), off.z));
      float edge = 1.0 - smoothstep(0.4, 1.4, nearest);
      ${lattice ? 'edge *= smoothstep(2.0, 7.0, 1.0 / max(aPixel.x, max(aPixel.y, aPixel.z)));' : ''}
      diffuseColor.rgb *= 1.0 - ${strength.toFixed(3)} * edge;
      diffuseColor.a = max(diffuseColor.a, ${alpha.toFixed(3)} * edge);`);
  };
  material.customProgramCacheKey = () => `edges ${strength} ${alpha} ${lattice ? 'lattice' : 'box'}`;
  return material;
}

export const latticeUniforms = () => ({ origin: { value: new Vector3() }, cell: { value: 1 } });
