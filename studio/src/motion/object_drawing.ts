/** Objects of the planning scene as they are drawn, and the handles that move the chosen one. */
import * as THREE from 'three';
import { list, part, poseMatrix } from '../displays/message_fields';
import type { Site } from '../displays/display';
import type { Json, JsonObject } from '../json';
import { unit } from '../model/geometry';
import { paint } from './ghost';
import { changeObjects, moveOf } from './objects';
import { SixDof } from './six_dof';
import { poseOfFrame, standing } from './robot_pose';
import type { MotionStore } from './store';

const SEND_MS = 80;

interface Shown {
  frame: string;
  node: THREE.Group;
  attached: boolean;
}

/** Draws what the store has. */
export class SceneObjects {
  readonly root = new THREE.Group();
  private shown: Shown[] = [];
  private marker: SixDof | null = null;
  private last = 0;
  private readonly geometries: THREE.BufferGeometry[] = [];

  constructor(
    private readonly site: Site,
    private readonly store: MotionStore,
  ) {
    this.root.name = 'planning scene';
  }

  get count(): number {
    return this.shown.filter((one) => !one.attached).length;
  }

  get attachedCount(): number {
    return this.shown.length - this.count;
  }

  /** Draw everything anew, unless somebody holds an object. */
  draw(): void {
    if (this.marker?.held) return;
    this.dispose();
    const { props } = this.site;
    if (!props.flag('Scene Geometry/Show Scene Geometry')) return this.site.view.moved();
    const alpha = props.num('Scene Geometry/Scene Alpha');
    const free = paint(props.colour('Scene Geometry/Scene Color'), alpha);
    const carried = paint(props.colour('Scene Robot/Attached Body Color'), alpha);
    for (const item of this.store.objects) this.add(item, free, false);
    for (const body of this.store.attached)
      this.add(part(body, 'object'), carried, true, String(body.link_name));
    this.follow();
    // Handles can be grasped before they are drawn.
    this.root.updateMatrixWorld(true);
    this.site.view.moved();
  }

  /** Frames moved. */
  follow(): void {
    const base = standing(this.site.frames, this.store);
    const { robot, kinematics, current } = this.store;
    for (const one of this.shown) {
      // The planning frame is often the root of tf's tree, of which tf does not speak.
      const own = one.attached ? null : poseOfFrame(this.site.frames, one.frame);
      const link = kinematics?.pose(one.frame, current);
      const pose =
        own ??
        (base && (link ? base.clone().multiply(link) : one.frame === robot?.frame ? base : null));
      one.node.visible = pose !== null;
      pose?.decompose(one.node.position, one.node.quaternion, one.node.scale);
    }
  }

  dispose(): void {
    this.root.clear();
    this.shown = [];
    this.marker = null;
    this.geometries.splice(0).forEach((geometry) => geometry.dispose());
  }

  private add(item: JsonObject, material: THREE.Material, attached: boolean, link = ''): void {
    const frame = link || String(part(item, 'header').frame_id ?? '').replace(/^\//, '');
    const node = new THREE.Group();
    const body = new THREE.Group();
    poseMatrix(item.pose).decompose(body.position, body.quaternion, body.scale);
    for (const mesh of this.meshes(item, material)) body.add(mesh);
    node.add(body);
    node.name = String(item.id);
    this.root.add(node);
    this.shown.push({ frame, node, attached });
    if (!attached && item.id === this.store.chosen) this.addMarker(item, node, body);
  }

  private addMarker(item: JsonObject, node: THREE.Group, body: THREE.Group): void {
    const size = new THREE.Box3().setFromObject(body).getSize(new THREE.Vector3()).length();
    const send = (): void => {
      this.last = performance.now();
      body.updateMatrix();
      changeObjects(this.store, [moveOf(item, body.matrix)]).catch((problem: Error) =>
        this.site.status('Planning Scene', 'error', problem.message),
      );
    };
    this.marker = new SixDof(String(item.id), Math.max(0.15, size * 1.3), {
      moved: (pose) => {
        pose.decompose(body.position, body.quaternion, body.scale);
        if (performance.now() - this.last > SEND_MS) send();
      },
      released: send,
      redraw: () => this.site.view.invalidate(true),
    });
    this.marker.place(poseMatrix(item.pose));
    node.add(this.marker.root);
  }

  private meshes(item: JsonObject, material: THREE.Material): THREE.Mesh[] {
    const found: THREE.Mesh[] = [];
    const add = (geometry: THREE.BufferGeometry, scale: number[], pose: Json | undefined): void => {
      const mesh = new THREE.Mesh(geometry, material);
      poseMatrix(pose).decompose(mesh.position, mesh.quaternion, mesh.scale);
      mesh.scale.set(scale[0], scale[1], scale[2]);
      mesh.castShadow = true;
      found.push(mesh);
    };
    const poses = list<JsonObject>(item, 'primitive_poses');
    list<JsonObject>(item, 'primitives').forEach((solid, at) => {
      const [geometry, scale] = primitive(solid);
      if (geometry) add(geometry, scale, poses[at]);
    });
    const places = list<JsonObject>(item, 'mesh_poses');
    list<JsonObject>(item, 'meshes').forEach((mesh, at) =>
      add(this.keep(triangles(mesh)), [1, 1, 1], places[at]),
    );
    return found;
  }

  private keep(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
    this.geometries.push(geometry);
    return geometry;
  }
}

/** A `shape_msgs/SolidPrimitive`: a solid of unit size, and its scale. */
function primitive(solid: JsonObject): [THREE.BufferGeometry | null, number[]] {
  const sizes = list<number>(solid, 'dimensions');
  switch (Number(solid.type)) {
    case 1:
      return [unit.box(), sizes];
    case 2:
      return [unit.sphere(), [sizes[0], sizes[0], sizes[0]]];
    case 3:
      return [unit.cylinder(), [sizes[1], sizes[1], sizes[0]]];
    case 4:
      return [unit.cone(), [sizes[1], sizes[1], sizes[0]]];
    default:
      return [null, []];
  }
}

function triangles(mesh: JsonObject): THREE.BufferGeometry {
  const corners = list<{ x: number; y: number; z: number }>(mesh, 'vertices');
  const index = list<JsonObject>(mesh, 'triangles').flatMap((one) =>
    list<number>(one, 'vertex_indices'),
  );
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute(
    'position',
    new THREE.Float32BufferAttribute(
      corners.flatMap(({ x, y, z }) => [x, y, z]),
      3,
    ),
  );
  geometry.setIndex(index);
  const flat = geometry.toNonIndexed();
  flat.computeVertexNormals();
  return flat;
}
