/** A covariance of a pose, as RViz draws it: an ellipsoid for the position, a fan for the yaw. */
import * as THREE from 'three';
import { unit } from '../model/geometry';
import { colour, flag, num, type Properties, type PropertySpec } from './properties';
import { InstancePool } from './instanced_shapes';

const SMALLEST_M = 1e-3;
const WIDEST_RAD = 1.4;

/** A pose and its 36 numbers. */
export interface Uncertain {
  pose: THREE.Matrix4;
  values: readonly number[];
}

/** RViz's properties below `Covariance`. */
export function covarianceProperties(): PropertySpec[] {
  return [
    flag('Covariance', true, 'Whether the covariance is drawn.'),
    flag('Covariance/Position', true, 'The ellipsoid of the position.'),
    colour('Covariance/Position/Color', '204; 51; 204', 'Colour of the ellipsoid.'),
    num('Covariance/Position/Alpha', 0.3, 'How opaque the ellipsoid is.', { min: 0, max: 1 }),
    num('Covariance/Position/Scale', 1, 'Standard deviations to the surface.', { min: 0 }),
    flag('Covariance/Orientation', true, 'The fan of the yaw.'),
    colour('Covariance/Orientation/Color', '255; 255; 127', 'Colour of the fan.'),
    num('Covariance/Orientation/Alpha', 0.5, 'How opaque the fan is.', { min: 0, max: 1 }),
    num('Covariance/Orientation/Offset', 1, 'How far from the pose the fan ends, metres.', {
      min: 0,
    }),
    num('Covariance/Orientation/Scale', 1, 'Standard deviations to each side.', { min: 0 }),
  ];
}

/** Draws covariances by the properties above. */
export class Covariance {
  private readonly positionPaint = new THREE.MeshPhongMaterial({
    transparent: true,
    depthWrite: false,
  });
  private readonly yawPaint = new THREE.MeshBasicMaterial({
    transparent: true,
    depthWrite: false,
    side: THREE.DoubleSide,
  });
  private readonly ellipsoids: InstancePool;
  private readonly fans = new THREE.Group();

  constructor(
    parent: THREE.Object3D,
    private readonly props: Properties,
  ) {
    this.ellipsoids = new InstancePool(parent, unit.sphere(), this.positionPaint);
    parent.add(this.fans);
  }

  get count(): number {
    return this.ellipsoids.count;
  }

  restyle(): void {
    this.positionPaint.color.setRGB(...this.props.colour('Covariance/Position/Color'));
    this.positionPaint.opacity = this.props.num('Covariance/Position/Alpha');
    this.yawPaint.color.setRGB(...this.props.colour('Covariance/Orientation/Color'));
    this.yawPaint.opacity = this.props.num('Covariance/Orientation/Alpha');
  }

  set(items: readonly Uncertain[]): void {
    const on = this.props.flag('Covariance');
    this.ellipsoids.begin();
    this.fans.children.forEach((child) => (child as THREE.Mesh).geometry.dispose());
    this.fans.clear();
    for (const item of on ? items : []) {
      if (item.values.length < 36) continue;
      if (this.props.flag('Covariance/Position')) this.ellipsoids.put(this.ellipsoid(item));
      if (this.props.flag('Covariance/Orientation')) this.fans.add(this.fan(item));
    }
    this.ellipsoids.end();
  }

  /** The covariance of the position is in the frame of the message, not of the pose. */
  private ellipsoid({ pose, values }: Uncertain): THREE.Matrix4 {
    const scale = this.props.num('Covariance/Position/Scale');
    const { axes, squares } = eigen(
      [0, 1, 2].map((row) => [0, 1, 2].map((column) => values[row * 6 + column] || 0)),
    );
    const lengths = squares.map((square) =>
      Math.max(Math.sqrt(Math.max(square, 0)) * scale, SMALLEST_M),
    );
    const matrix = new THREE.Matrix4().makeBasis(
      ...(axes.map((axis, i) => new THREE.Vector3(...axis).multiplyScalar(lengths[i])) as [
        THREE.Vector3,
        THREE.Vector3,
        THREE.Vector3,
      ]),
    );
    return matrix.setPosition(new THREE.Vector3().setFromMatrixPosition(pose));
  }

  private fan({ pose, values }: Uncertain): THREE.Mesh {
    const scale = this.props.num('Covariance/Orientation/Scale');
    const half = Math.min(WIDEST_RAD, Math.max(0.005, Math.sqrt(Math.max(values[35], 0)) * scale));
    const radius = this.props.num('Covariance/Orientation/Offset');
    const mesh = new THREE.Mesh(
      new THREE.CircleGeometry(radius, 24, -half, 2 * half),
      this.yawPaint,
    );
    mesh.matrixAutoUpdate = false;
    mesh.matrix.copy(pose);
    mesh.raycast = () => undefined;
    return mesh;
  }
}

/** Eigenvectors and eigenvalues of a symmetric matrix, by Jacobi's turns. */
export function eigen(matrix: number[][]): { axes: [number, number, number][]; squares: number[] } {
  const a = matrix.map((row) => [...row]);
  const v = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  for (let sweep = 0; sweep < 12; sweep++) {
    for (const [p, q] of [
      [0, 1],
      [0, 2],
      [1, 2],
    ]) {
      if (Math.abs(a[p][q]) < 1e-15) continue;
      const angle = 0.5 * Math.atan2(2 * a[p][q], a[q][q] - a[p][p]);
      turn(a, v, p, q, Math.cos(angle), Math.sin(angle));
    }
  }
  const axes = [0, 1, 2].map((i) => [v[0][i], v[1][i], v[2][i]] as [number, number, number]);
  return { axes, squares: [a[0][0], a[1][1], a[2][2]] };
}

function turn(a: number[][], v: number[][], p: number, q: number, c: number, s: number): void {
  for (let k = 0; k < 3; k++) {
    [a[k][p], a[k][q]] = [c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]];
  }
  for (let k = 0; k < 3; k++) {
    [a[p][k], a[q][k]] = [c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]];
    [v[k][p], v[k][q]] = [c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q]];
  }
}
