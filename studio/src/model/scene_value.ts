/** The scene value of docs/studio_protocol.md: one form for the world and for a robot_description. */

/** x, y, z, qx, qy, qz, qw; metres. */
export type Pose = [number, number, number, number, number, number, number];
export type Vector = [number, number, number];

export interface MaterialValue {
  diffuse: number[];
  ambient?: number[];
  specular?: number[];
  emissive?: number[];
  shininess?: number;
  texture?: string | null;
  texture_scale?: [number, number];
}

export interface MeshPart {
  key: string;
  material: MaterialValue | null;
}

export type GeometryValue =
  | { type: 'box'; size: Vector }
  | { type: 'sphere'; radius: number }
  | { type: 'cylinder' | 'capsule' | 'cone'; radius: number; length: number }
  | { type: 'ellipsoid'; radii: Vector }
  | { type: 'plane'; normal: Vector; size: [number, number] }
  | { type: 'mesh'; parts: MeshPart[]; scale: Vector }
  | { type: 'missing'; uri: string; reason: string };

export interface ShapeValue {
  name: string;
  pose: Pose;
  geometry: GeometryValue;
  material: MaterialValue | null;
  cast_shadows: boolean;
  transparency: number;
}

export interface InertialValue {
  mass_kg: number;
  pose: Pose;
  diagonal: Vector;
  /** Size of the box of equal mass and inertia, and where it is; null where no box has them. */
  box: Vector | null;
  box_pose?: Pose | null;
}

export interface BodyValue {
  name: string;
  model: number;
  link: string;
  pose: Pose;
  inertial: InertialValue | null;
  visuals: ShapeValue[];
  collisions: ShapeValue[];
  sensors: { name: string; type: string; pose: Pose }[];
}

export interface JointValue {
  name: string;
  type: string;
  parent: number;
  child: number;
  pose: Pose;
  axis: Vector;
  lower: number | null;
  upper: number | null;
  effort: number | null;
  velocity: number | null;
  mimic: { joint: string; multiplier: number; offset: number } | null;
}

export interface ModelValue {
  name: string;
  static: boolean;
  bodies: number[];
  joints: number[];
  pose: Pose;
}

export interface LightValue {
  name: string;
  type: string;
  pose: Pose;
  direction: Vector;
  diffuse: number[];
  specular: number[];
  range_m: number;
  cast_shadows: boolean;
}

export interface SceneValue {
  name: string;
  version: number;
  kind: 'world' | 'robot';
  models: ModelValue[];
  bodies: BodyValue[];
  joints: JointValue[];
  lights: LightValue[];
  sky: boolean;
  ambient: number[];
  background: number[];
  shadows: boolean;
  grid: boolean;
  /** Where the world file has the window's camera: it looks along +x, z up. */
  view: Pose | null;
}
