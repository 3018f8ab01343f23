/** Where one looks from: RViz's view controllers and their properties, z up. */
import * as THREE from 'three';

export type ViewKind = 'Orbit' | 'TopDownOrtho' | 'FPS' | 'ThirdPersonFollower';

/** The view controllers, with what the menu says. */
export const VIEW_KINDS: Record<ViewKind, string> = {
  Orbit: 'Orbit',
  TopDownOrtho: 'TopDownOrtho',
  FPS: 'FPS',
  ThirdPersonFollower: 'ThirdPersonFollower',
};

const SMALLEST_DISTANCE_M = 0.02;
const MOST_PITCH = Math.PI / 2 - 1e-3;
const GLIDE_MS = 220;

/** The state of a view: what RViz's Views panel shows and saves. */
export interface ViewState {
  kind: ViewKind;
  distance: number;
  yaw: number;
  pitch: number;
  focal: [number, number, number];
  /** Pixels per metre of TopDownOrtho. */
  scale: number;
  angle: number;
}

/** A perspective and an orthographic camera, driven by one state. */
export class CameraRig {
  readonly perspective = new THREE.PerspectiveCamera(50, 1, 0.01, 1000);
  readonly ortho = new THREE.OrthographicCamera(-1, 1, 1, -1, -500, 1000);
  state: ViewState = {
    kind: 'Orbit',
    distance: 8,
    yaw: -0.9,
    pitch: 0.5,
    focal: [0, 0, 0.3],
    scale: 60,
    angle: 0,
  };
  /** Whether anybody has moved the camera. */
  touched = false;
  private width = 1;
  private height = 1;
  private glide: { from: ViewState; to: ViewState; began: number } | null = null;
  private leader: (() => THREE.Matrix4 | null) | null = null;
  private lead: { place: THREE.Vector3; yaw: number } | null = null;

  constructor(private readonly changed: () => void) {
    this.perspective.up.set(0, 0, 1);
    this.ortho.up.set(0, 1, 0);
    this.apply();
  }

  get camera(): THREE.PerspectiveCamera | THREE.OrthographicCamera {
    return this.state.kind === 'TopDownOrtho' ? this.ortho : this.perspective;
  }

  /** Width by height of the picture. */
  get aspect(): number {
    return this.width / this.height;
  }

  /** Take new values of the state at once. */
  set(change: Partial<ViewState>): void {
    this.glide = null;
    this.touched = true;
    const kind =
      change.kind && change.kind in VIEW_KINDS
        ? change.kind
        : change.kind
          ? 'Orbit'
          : this.state.kind;
    this.state = { ...this.state, ...change, kind };
    this.apply();
  }

  /** Change the controller and keep looking at the same place. */
  setKind(kind: ViewKind): void {
    const before = this.state;
    if (kind === before.kind) return;
    const change: Partial<ViewState> = { kind };
    if (kind === 'TopDownOrtho') {
      change.scale =
        this.height / (2 * before.distance * Math.tan((this.perspective.fov * Math.PI) / 360));
      change.angle = before.yaw + Math.PI / 2;
    } else if (before.kind === 'TopDownOrtho') {
      change.distance =
        this.height / (2 * before.scale * Math.tan((this.perspective.fov * Math.PI) / 360));
    }
    this.set(change);
  }

  /** Follow something (its pose in the scene), or nothing. */
  follow(leader: (() => THREE.Matrix4 | null) | null): void {
    this.leader = leader;
    this.lead = null;
    this.changed();
  }

  get following(): boolean {
    return this.leader !== null;
  }

  /** Glide to where a box fills the view. */
  moveTo(box: THREE.Box3): void {
    if (box.isEmpty()) return;
    const centre = box.getCenter(new THREE.Vector3());
    const radius = Math.max(box.getSize(new THREE.Vector3()).length() / 2, 0.05);
    const distance = (radius * 1.25) / Math.sin((this.perspective.fov * Math.PI) / 360);
    const scale = Math.min(this.width, this.height) / (2.4 * radius);
    this.glideTo({ focal: [centre.x, centre.y, centre.z], distance, scale });
  }

  /** Glide to other values of the state. */
  glideTo(change: Partial<ViewState>): void {
    const to = { ...this.state, ...change };
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) return this.set(change);
    this.glide = { from: this.state, to, began: performance.now() };
    this.touched = true;
    this.changed();
  }

  /** Called before every drawn frame; true while it wants another one. */
  tick(now: number): boolean {
    if (this.leader) this.track();
    const glide = this.glide;
    if (!glide) return false;
    const part = Math.min(1, (now - glide.began) / GLIDE_MS);
    this.state = mixed(glide.from, glide.to, part * part * (3 - 2 * part));
    if (part >= 1) this.glide = null;
    this.apply();
    return part < 1;
  }

  resize(width: number, height: number): void {
    this.width = width;
    this.height = height;
    this.apply();
  }

  /** Turn by pixels. */
  rotate(dx: number, dy: number): void {
    const { kind, yaw, pitch, angle } = this.state;
    if (kind === 'TopDownOrtho') return this.set({ angle: angle - dx * 0.005 });
    const sign = kind === 'FPS' ? -1 : 1;
    const next = Math.max(-MOST_PITCH, Math.min(MOST_PITCH, pitch + dy * 0.005 * sign));
    this.set({ yaw: yaw - dx * 0.005 * sign, pitch: next });
    if (kind === 'FPS') this.keepEye(yaw, pitch);
  }

  /** Move along the picture by pixels. */
  pan(dx: number, dy: number): void {
    const { kind, distance, scale, focal } = this.state;
    const perPixel =
      kind === 'TopDownOrtho'
        ? 1 / scale
        : (2 * distance * Math.tan((this.perspective.fov * Math.PI) / 360)) / this.height;
    const right = new THREE.Vector3().setFromMatrixColumn(this.camera.matrix, 0);
    const up = new THREE.Vector3().setFromMatrixColumn(this.camera.matrix, 1);
    const next = new THREE.Vector3(...focal)
      .addScaledVector(right, -dx * perPixel)
      .addScaledVector(up, dy * perPixel);
    this.set({ focal: [next.x, next.y, next.z] });
  }

  /** Come nearer (factor < 1) or go away. */
  zoom(factor: number): void {
    const { kind, distance, scale } = this.state;
    if (kind === 'TopDownOrtho') this.set({ scale: Math.max(0.5, scale / factor) });
    else if (kind === 'FPS') this.fly(0, 0, (1 - factor) * Math.max(distance, 1));
    else this.set({ distance: Math.max(SMALLEST_DISTANCE_M, distance * factor) });
  }

  /** Move the eye and what it looks at: right, up, forward in metres. */
  fly(right: number, up: number, forward: number): void {
    const move = new THREE.Vector3();
    const axis = new THREE.Vector3();
    move.addScaledVector(axis.setFromMatrixColumn(this.perspective.matrix, 0), right);
    move.addScaledVector(axis.setFromMatrixColumn(this.perspective.matrix, 2), -forward);
    move.z += up;
    const [x, y, z] = this.state.focal;
    this.set({ focal: [x + move.x, y + move.y, z + move.z] });
  }

  /** In first person the eye stays and what is looked at moves. */
  private keepEye(yaw: number, pitch: number): void {
    const { distance, focal } = this.state;
    const before = new THREE.Vector3(...focal).addScaledVector(direction(yaw, pitch), distance);
    const next = before.addScaledVector(direction(this.state.yaw, this.state.pitch), -distance);
    this.set({ focal: [next.x, next.y, next.z] });
  }

  private track(): void {
    const pose = this.leader?.();
    if (!pose) return;
    const place = new THREE.Vector3().setFromMatrixPosition(pose);
    const ahead = new THREE.Vector3().setFromMatrixColumn(pose, 0);
    const yaw = Math.atan2(ahead.y, ahead.x);
    if (this.lead && this.state.kind !== 'FPS') {
      const move = place.clone().sub(this.lead.place);
      const [x, y, z] = this.state.focal;
      this.state = { ...this.state, focal: [x + move.x, y + move.y, z + move.z] };
      if (this.state.kind === 'ThirdPersonFollower') this.state.yaw += yaw - this.lead.yaw;
      this.apply(false);
    }
    this.lead = { place, yaw };
  }

  private apply(tell = true): void {
    const { kind, distance, yaw, pitch, focal, scale, angle } = this.state;
    if (kind === 'TopDownOrtho') {
      const [w, h] = [this.width / scale / 2, this.height / scale / 2];
      Object.assign(this.ortho, { left: -w, right: w, top: h, bottom: -h });
      this.ortho.position.set(focal[0], focal[1], 100);
      this.ortho.up.set(-Math.sin(angle), Math.cos(angle), 0);
      this.ortho.lookAt(focal[0], focal[1], 0);
    } else {
      const centre = new THREE.Vector3(...focal);
      this.perspective.position.copy(centre).addScaledVector(direction(yaw, pitch), distance);
      this.perspective.lookAt(centre);
      this.perspective.near = Math.max(0.004, Math.min(0.1, distance / 200));
      this.perspective.far = Math.max(500, distance * 20);
      this.perspective.aspect = this.width / this.height;
    }
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrix();
    this.camera.updateMatrixWorld();
    if (tell) this.changed();
  }
}

/** From what is looked at to the eye. */
function direction(yaw: number, pitch: number): THREE.Vector3 {
  return new THREE.Vector3(
    Math.cos(yaw) * Math.cos(pitch),
    Math.sin(yaw) * Math.cos(pitch),
    Math.sin(pitch),
  );
}

/** The view of a camera at a pose (x, y, z, quaternion) that looks along +x, z up. */
export function stateAt(pose: readonly number[]): Partial<ViewState> {
  const [x, y, z, qx, qy, qz, qw] = pose;
  const turn = new THREE.Quaternion(qx, qy, qz, qw);
  const ahead = new THREE.Vector3(1, 0, 0).applyQuaternion(turn);
  const up = new THREE.Vector3(0, 0, 1).applyQuaternion(turn);
  // Straight up or down, what is up in the picture says which way it is turned.
  const heading = Math.abs(ahead.z) > 0.999 ? up.multiplyScalar(-Math.sign(ahead.z)) : ahead;
  const distance = ahead.z < -0.05 && z > 0 ? Math.min(100, z / -ahead.z) : 5;
  const pitch = Math.max(
    -MOST_PITCH,
    Math.min(MOST_PITCH, Math.asin(Math.max(-1, Math.min(1, -ahead.z)))),
  );
  const focal: [number, number, number] = [
    x + ahead.x * distance,
    y + ahead.y * distance,
    z + ahead.z * distance,
  ];
  return { kind: 'Orbit', distance, yaw: Math.atan2(-heading.y, -heading.x), pitch, focal };
}

function mixed(from: ViewState, to: ViewState, part: number): ViewState {
  const mix = (a: number, b: number): number => a + (b - a) * part;
  const focal = from.focal.map((value, axis) => mix(value, to.focal[axis])) as [
    number,
    number,
    number,
  ];
  return {
    kind: to.kind,
    focal,
    distance: mix(from.distance, to.distance),
    yaw: mix(from.yaw, to.yaw),
    pitch: mix(from.pitch, to.pitch),
    scale: mix(from.scale, to.scale),
    angle: mix(from.angle, to.angle),
  };
}
