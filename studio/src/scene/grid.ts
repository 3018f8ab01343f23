/** A grid of lines in a plane, RViz's and Gazebo's ground. */
import * as THREE from 'three';

/** What RViz's Grid display says. */
export interface GridLook {
  cells: number;
  size_m: number;
  colour: [number, number, number];
  alpha: number;
  plane: 'XY' | 'XZ' | 'YZ';
  /** The lines through the middle in the colours of the axes. */
  axes: boolean;
}

/** Software renderers drop a line that begins behind the eye: lines are cut at the cells. */
const MOST_PIECES = 40;

/** Draw a grid; its middle is at the origin. */
export function gridLines(look: GridLook): THREE.LineSegments {
  const half = (look.cells * look.size_m) / 2;
  const points: number[] = [];
  const colours: number[] = [];
  const pieces = Math.min(look.cells, MOST_PIECES);
  const put = (a: number[], b: number[], colour: number[]): void => {
    for (let piece = 0; piece < pieces; piece++) {
      const ends = [piece, piece + 1].map((n) =>
        a.map((value, axis) => value + ((b[axis] - value) * n) / pieces),
      );
      points.push(...turned(ends[0], look.plane), ...turned(ends[1], look.plane));
      colours.push(...colour, ...colour);
    }
  };
  for (let i = 0; i <= look.cells; i++) {
    const at = i * look.size_m - half;
    const middle = look.axes && Math.abs(at) < 1e-9;
    put([-half, at, 0], [half, at, 0], middle ? [0.62, 0.27, 0.27] : look.colour);
    put([at, -half, 0], [at, half, 0], middle ? [0.27, 0.52, 0.3] : look.colour);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
  geometry.setAttribute('color', new THREE.Float32BufferAttribute(colours, 3));
  const material = new THREE.LineBasicMaterial({
    vertexColors: true,
    opacity: look.alpha,
    transparent: true,
    depthWrite: false,
  });
  const lines = new THREE.LineSegments(geometry, material);
  lines.name = 'grid';
  lines.renderOrder = -1;
  return lines;
}

function turned([x, y, z]: number[], plane: GridLook['plane']): number[] {
  if (plane === 'XZ') return [x, z, y];
  if (plane === 'YZ') return [z, x, y];
  return [x, y, z];
}
