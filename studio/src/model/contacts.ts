/** Contacts of the world: a ball at each point, an arrow along its normal. */
import * as THREE from 'three';
import type { Channel } from '../channel';
import type { Connection } from '../connection';
import { InstancePool } from '../displays/instanced_shapes';
import { floats } from '../binary_frame';
import type { View } from '../scene/view';
import { arrowGeometry, unit } from './geometry';
import { flat } from './materials';

const CONTACT_LENGTH = 7;
const BALL_M = 0.012;
const ARROW_M = 0.1;
const BLUE = [0.15, 0.35, 1.0];

/** Draws the stream `world.contacts` while it is on. */
export class Contacts {
  private readonly root = new THREE.Group();
  private readonly balls: InstancePool;
  private readonly arrows: InstancePool;
  private channel: Channel | null = null;

  constructor(
    private readonly view: View,
    private readonly connection: Connection,
  ) {
    this.root.name = 'hands';
    this.balls = new InstancePool(this.root, unit.ball(), flat(BLUE, 1, false));
    this.arrows = new InstancePool(
      this.root,
      arrowGeometry(0.8, 0.02, 0.2, 0.06),
      flat([0.2, 0.85, 0.3], 1, false),
    );
    view.scene.add(this.root);
  }

  get on(): boolean {
    return this.channel !== null;
  }

  get count(): number {
    return this.balls.count;
  }

  set(on: boolean): void {
    if (on === this.on) return;
    this.channel?.close();
    this.channel = on
      ? this.connection.open(
          'world.contacts',
          {},
          { onFrame: (frame) => this.draw(floats(frame, frame.count * CONTACT_LENGTH)) },
        )
      : null;
    if (!on) this.draw(new Float32Array(0));
  }

  hold(held: boolean): void {
    this.channel?.hold(held);
  }

  private draw(values: Float32Array): void {
    this.balls.begin();
    this.arrows.begin();
    const matrix = new THREE.Matrix4();
    const place = new THREE.Vector3();
    const turn = new THREE.Quaternion();
    const normal = new THREE.Vector3();
    for (let at = 0; at + CONTACT_LENGTH <= values.length; at += CONTACT_LENGTH) {
      place.fromArray(values, at);
      turn.setFromUnitVectors(X, normal.fromArray(values, at + 3).normalize());
      this.balls.put(matrix.compose(place, IDENTITY, new THREE.Vector3().setScalar(BALL_M)));
      this.arrows.put(matrix.compose(place, turn, new THREE.Vector3().setScalar(ARROW_M)));
    }
    this.balls.end();
    this.arrows.end();
    this.view.invalidate();
  }
}

const X = new THREE.Vector3(1, 0, 0);
const IDENTITY = new THREE.Quaternion();
