/** A robot that is not there: where it would be, in one colour. */
import * as THREE from 'three';
import { BodyNode } from '../model/body';
import type { PageScene } from '../generated/messages';

type Colour = [number, number, number];

const paints = new Map<string, THREE.MeshPhongMaterial>();

/** The one material of a colour. */
export function paint(colour: Colour, opacity: number): THREE.MeshPhongMaterial {
  const key = JSON.stringify([colour, opacity]);
  let found = paints.get(key);
  if (!found) {
    found = new THREE.MeshPhongMaterial({
      color: new THREE.Color(...colour),
      opacity,
      transparent: opacity < 0.999,
      depthWrite: opacity > 0.6,
      shininess: 20,
      side: THREE.DoubleSide,
    });
    paints.set(key, found);
  }
  return found;
}

/** The bodies of a robot's description, placed by poses. */
export class Ghost {
  readonly root = new THREE.Group();
  readonly bodies: BodyNode[];

  /** @param changed is called when a mesh came. */
  constructor(scene: PageScene, name: string, changed: () => void) {
    this.root.name = name;
    this.bodies = scene.bodies.map(
      (body) =>
        new BodyNode(
          body,
          { model: scene.name, link: body.link, body: body.name },
          [],
          false,
          changed,
        ),
    );
    for (const body of this.bodies) {
      body.root.matrixAutoUpdate = false;
      this.root.add(body.root);
    }
  }

  /** Where the bodies are. */
  place(poses: readonly THREE.Matrix4[]): void {
    this.bodies.forEach((body, at) => {
      body.root.matrix.copy(poses[at]);
      body.root.matrixWorldNeedsUpdate = true;
    });
  }

  /** Which links are drawn, and how; null for their own colours. */
  look(links: ReadonlySet<string> | null, material: (link: string) => THREE.Material | null): void {
    for (const body of this.bodies) {
      const { link } = body.entity;
      body.root.visible = links === null || links.has(link);
      body.shapes.forEach((shape) =>
        shape.setLook({ wireframe: false, transparent: false }, material(link)),
      );
    }
  }
}
