/** Imu, Range, Wrench and GridCells. */
import * as THREE from 'three';
import type { Point } from '../generated/messages';
import { arrowGeometry, shared, unit } from '../model/geometry';
import type { Drawing } from './display';
import { list, part, vector } from './message_fields';
import { colour, flag, num } from './properties';
import { InstancePool } from './instanced_shapes';

const X = new THREE.Vector3(1, 0, 0);

/** RViz's Imu: a box that turns, axes and an arrow of the acceleration. */
export const IMU: Drawing = {
  properties: [
    flag('Box properties/Enable box', false, 'A box with the orientation.'),
    colour('Box properties/Box color', '255; 0; 0', 'Colour of the box.'),
    num('Box properties/Box alpha', 1, 'How opaque the box is.', { min: 0, max: 1 }),
    num('Box properties/x_scale', 1, 'Size along x, metres.'),
    num('Box properties/y_scale', 1, 'Size along y, metres.'),
    num('Box properties/z_scale', 1, 'Size along z, metres.'),
    flag('Acceleration properties/Enable acceleration', true, 'An arrow along the acceleration.'),
    flag(
      'Acceleration properties/Derotate acceleration',
      true,
      'The acceleration is in the frame of the sensor.',
    ),
    colour('Acceleration properties/Acc. vector color', '255; 0; 0', 'Colour of the arrow.'),
    num('Acceleration properties/Acc. vector alpha', 1, 'How opaque the arrow is.', {
      min: 0,
      max: 1,
    }),
    num('Acceleration properties/Acc. vector scale', 0.1, 'Metres of arrow per m/s².'),
    flag(
      'fixed_frame_orientation',
      true,
      'The orientation is from the fixed frame, as REP-145 says.',
    ),
  ],
  make(site) {
    const box = new THREE.Mesh(unit.box(), new THREE.MeshPhongMaterial({ transparent: true }));
    const arrow = thinArrow();
    site.root.add(box, arrow);
    box.visible = arrow.visible = false;
    let taken = 0;
    return {
      take(value) {
        taken += 1;
        const message = part(value, 'message');
        const {
          x = 0,
          y = 0,
          z = 0,
          w = 1,
        } = part(message, 'orientation') as Record<string, number>;
        const turn = new THREE.Quaternion(x, y, z, w);
        if (turn.lengthSq() < 1e-9) turn.identity();
        if (site.props.flag('fixed_frame_orientation'))
          turn.premultiply(site.root.quaternion.clone().invert());
        box.quaternion.copy(turn);
        box.visible = site.props.flag('Box properties/Enable box');
        const acceleration = vector(message.linear_acceleration);
        if (!site.props.flag('Acceleration properties/Derotate acceleration'))
          acceleration.applyQuaternion(turn);
        aim(arrow, acceleration, site.props.num('Acceleration properties/Acc. vector scale'));
        arrow.visible &&= site.props.flag('Acceleration properties/Enable acceleration');
      },
      changed() {
        const p = 'Box properties/';
        const paint = box.material;
        paint.color.setRGB(...site.props.colour(`${p}Box color`));
        paint.opacity = site.props.num(`${p}Box alpha`);
        box.scale.set(
          ...(['x', 'y', 'z'].map((axis) => site.props.num(`${p}${axis}_scale`)) as [
            number,
            number,
            number,
          ]),
        );
        box.visible = taken > 0 && site.props.flag(`${p}Enable box`);
        tint(
          arrow,
          site.props.colour('Acceleration properties/Acc. vector color'),
          site.props.num('Acceleration properties/Acc. vector alpha'),
        );
      },
      clear() {
        taken = 0;
        box.visible = arrow.visible = false;
      },
      counts: () => ({ boxes: Number(box.visible), arrows: Number(arrow.visible) }),
    };
  },
};

/** RViz's Range: the cone of a sonar. */
export const RANGE: Drawing = {
  properties: [
    colour('Color', '255; 255; 255', 'Colour of the cone.'),
    num('Alpha', 0.5, 'How opaque the cone is, 0 to 1.', { min: 0, max: 1 }),
  ],
  make(site) {
    const geometry = shared('range', () =>
      new THREE.ConeGeometry(1, 1, 24, 1, true).rotateZ(Math.PI / 2).translate(0.5, 0, 0),
    );
    const cone = new THREE.Mesh(
      geometry,
      new THREE.MeshPhongMaterial({ transparent: true, depthWrite: false, side: THREE.DoubleSide }),
    );
    cone.visible = false;
    site.root.add(cone);
    return {
      take(value) {
        const {
          range = NaN,
          field_of_view: fov = 0.1,
          min_range: min = 0,
          max_range: max = Infinity,
        } = part(value, 'message') as Record<string, number>;
        const inside = Number.isFinite(range) && range >= min && range <= max;
        const radius = Math.max(range * Math.tan(fov / 2), 1e-4);
        cone.visible = inside;
        if (inside) cone.scale.set(range, radius, radius);
        site.status(
          'Range',
          inside ? 'ok' : 'warn',
          inside ? `${range.toFixed(3)} m` : `Nothing within ${min} to ${max} m`,
        );
      },
      changed() {
        cone.material.color.setRGB(...site.props.colour('Color'));
        cone.material.opacity = site.props.num('Alpha');
      },
      clear: () => {
        cone.visible = false;
      },
      counts: () => ({ cones: Number(cone.visible) }),
    };
  },
};

/** RViz's WrenchStamped: an arrow of the force, and one with a ring of the torque. */
export const WRENCH: Drawing = {
  properties: [
    colour('Force Color', '204; 51; 51', 'Colour of the force.'),
    colour('Torque Color', '204; 204; 51', 'Colour of the torque.'),
    num('Alpha', 1, 'How opaque the arrows are, 0 to 1.', { min: 0, max: 1 }),
    num('Force Arrow Scale', 0.1, 'Metres of arrow per newton.'),
    num('Torque Arrow Scale', 0.1, 'Metres of arrow per newton metre.'),
    num('Arrow Width', 0.5, 'Width of the arrows.', { min: 0.01 }),
  ],
  make(site) {
    const force = thinArrow();
    const torque = thinArrow();
    const ring = new THREE.Mesh(
      shared('wrench ring', () =>
        new THREE.TorusGeometry(0.3, 0.025, 8, 40, 1.6 * Math.PI).rotateY(Math.PI / 2),
      ),
      torque.material,
    );
    torque.add(ring);
    site.root.add(force, torque);
    force.visible = torque.visible = false;
    return {
      take(value) {
        const wrench = part(value, 'message', 'wrench');
        aim(
          force,
          vector(wrench.force),
          site.props.num('Force Arrow Scale'),
          site.props.num('Arrow Width'),
        );
        aim(
          torque,
          vector(wrench.torque),
          site.props.num('Torque Arrow Scale'),
          site.props.num('Arrow Width'),
        );
      },
      changed() {
        tint(force, site.props.colour('Force Color'), site.props.num('Alpha'));
        tint(torque, site.props.colour('Torque Color'), site.props.num('Alpha'));
      },
      clear: () => {
        force.visible = false;
        torque.visible = false;
      },
      counts: () => ({ arrows: Number(force.visible) + Number(torque.visible) }),
    };
  },
};

/** RViz's GridCells. */
export const GRID_CELLS: Drawing = {
  properties: [
    colour('Color', '25; 255; 0', 'Colour of the cells.'),
    num('Alpha', 1, 'How opaque the cells are, 0 to 1.', { min: 0, max: 1 }),
  ],
  make(site) {
    const paint = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide });
    const pool = new InstancePool(site.root, new THREE.PlaneGeometry(1, 1), paint);
    const matrix = new THREE.Matrix4();
    return {
      take(value) {
        const message = part(value, 'message');
        const [width, height] = [Number(message.cell_width), Number(message.cell_height)];
        pool.begin();
        for (const { x, y, z } of list<Point>(message, 'cells'))
          pool.put(matrix.makeScale(width, height, 1).setPosition(x, y, z));
        pool.end();
        if (!(width > 0 && height > 0))
          site.status('Cells', 'error', `Cells of ${width} x ${height} m cannot be drawn`);
      },
      changed() {
        paint.color.setRGB(...site.props.colour('Color'));
        paint.opacity = site.props.num('Alpha');
        paint.transparent = paint.opacity < 1;
      },
      clear() {
        pool.begin();
        pool.end();
      },
      dispose: () => pool.dispose(),
      counts: () => ({ cells: pool.count }),
    };
  },
};

/** An arrow along +x, one metre long. */
export function thinArrow(): THREE.Mesh<THREE.BufferGeometry, THREE.MeshPhongMaterial> {
  return new THREE.Mesh(
    shared('thin arrow', () => arrowGeometry(0.77, 0.04, 0.23, 0.09)),
    new THREE.MeshPhongMaterial(),
  );
}

/** Point an arrow along a vector, so many metres per unit of it; nothing for nothing. */
export function aim(arrow: THREE.Object3D, along: THREE.Vector3, scale: number, width = 0.5): void {
  const length = along.length() * Math.abs(scale);
  arrow.visible = Number.isFinite(length) && length > 1e-6;
  if (!arrow.visible) return;
  arrow.quaternion.setFromUnitVectors(X, along.clone().normalize());
  const thick = Math.min(length, 1) * width * 2;
  arrow.scale.set(length, thick, thick);
}

/** Colour an arrow. */
export function tint(
  arrow: THREE.Mesh<THREE.BufferGeometry, THREE.MeshPhongMaterial>,
  rgb: [number, number, number],
  alpha: number,
): void {
  arrow.material.color.setRGB(...rgb);
  arrow.material.opacity = alpha;
  arrow.material.transparent = alpha < 1;
}
