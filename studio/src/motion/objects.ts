/** Objects of the planning scene as messages: made, moved, removed, held. */
import type * as THREE from 'three';
import { list, part } from '../displays/message_fields';
import type { MotionMesh } from '../generated/messages';
import type { JsonObject } from '../json';
import { poseMessage } from './messages';
import { groupOf, tipOf } from './robot';
import type { MotionStore } from './store';

export const SHAPES = ['Box', 'Sphere', 'Cylinder', 'Cone'] as const;
export type ShapeName = (typeof SHAPES)[number];

const ADD = 0,
  REMOVE = 1,
  MOVE = 3;
const TYPES: Record<ShapeName, number> = { Box: 1, Sphere: 2, Cylinder: 3, Cone: 4 };

const AT_ORIGIN = { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };

/** A solid of sizes in metres: x y z of a box, radius of a sphere, radius and length of the others. */
export function solid(
  id: string,
  frame: string,
  shape: ShapeName,
  sizes: number[],
  pose: THREE.Matrix4,
): JsonObject {
  const [a, b] = sizes;
  const dimensions = shape === 'Box' ? sizes.slice(0, 3) : shape === 'Sphere' ? [a] : [b, a];
  return {
    ...head(id, frame, pose),
    primitives: [{ type: TYPES[shape], dimensions }],
    primitive_poses: [AT_ORIGIN],
  };
}

/** An object of a mesh. */
export function meshObject(
  id: string,
  frame: string,
  mesh: MotionMesh,
  scale: number,
  pose: THREE.Matrix4,
): JsonObject {
  const vertices = mesh.vertices.map(([x, y, z]) => ({ x: x * scale, y: y * scale, z: z * scale }));
  const triangles = mesh.triangles.map((corners) => ({ vertex_indices: corners }));
  return { ...head(id, frame, pose), meshes: [{ vertices, triangles }], mesh_poses: [AT_ORIGIN] };
}

function head(id: string, frame: string, pose: THREE.Matrix4): JsonObject {
  return { id, header: { frame_id: frame }, pose: poseMessage(pose), operation: ADD };
}

/** Moves an object to a pose of its frame. */
export function moveOf(item: JsonObject, pose: THREE.Matrix4): JsonObject {
  return {
    id: item.id,
    header: { frame_id: part(item, 'header').frame_id ?? '' },
    pose: poseMessage(pose),
    operation: MOVE,
  };
}

/** Removes an object. */
export function removalOf(id: string): JsonObject {
  return { id, operation: REMOVE };
}

/** Apply collision objects to move_group's scene. */
export async function changeObjects(store: MotionStore, objects: JsonObject[]): Promise<void> {
  await apply(store, { world: { collision_objects: objects }, robot_state: { is_diff: true } });
}

/** Let the group's tip hold an object, which its gripper may touch, or let go of it. */
export async function attach(store: MotionStore, id: string, on: boolean): Promise<void> {
  const group = store.robot && groupOf(store.robot, store.group);
  const held = store.attached.find((body) => part(body, 'object').id === id);
  const link = held ? String(held.link_name) : tipOf(group ?? undefined);
  const fingers = group?.effectors.find((one) => one.link === link)?.links ?? [];
  const body = {
    link_name: link,
    object: { id, operation: on ? ADD : REMOVE },
    touch_links: on ? [link, ...fingers] : [],
  };
  await apply(store, { robot_state: { is_diff: true, attached_collision_objects: [body] } });
}

async function apply(store: MotionStore, scene: JsonObject): Promise<void> {
  const answer = await store.service('apply_planning_scene', 'ApplyPlanningScene', {
    scene: { is_diff: true, ...scene },
  });
  if (answer.success !== true)
    throw new Error('move_group did not take the change of its scene; its log says why');
}

/** All names that are taken. */
export function objectNames(store: MotionStore): string[] {
  return [
    ...store.objects.map((item) => String(item.id)),
    ...store.attached.map((body) => String(part(body, 'object').id)),
  ];
}

/** A name that nothing has. */
export function freeName(store: MotionStore, base: string): string {
  const taken = new Set(objectNames(store));
  let name = base;
  for (let count = 1; taken.has(name); count++) name = `${base}_${count}`;
  return name;
}

/** What an object is made of, in a word. */
export function kindOf(item: JsonObject): string {
  const solids = list<JsonObject>(item, 'primitives').map(
    (one) => SHAPES[Number(one.type) - 1] ?? 'shape',
  );
  const meshes = list<JsonObject>(item, 'meshes').map(() => 'Mesh');
  return [...solids, ...meshes].join(', ');
}
