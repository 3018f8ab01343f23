/** One 3D view: renderer, camera, lights, and frames that are drawn only when something changed. */
import * as THREE from 'three';
import { CameraRig } from './cameras';
import { Lighting } from './lighting';
import { firstLevel, Governor, wantedQuality, type Level } from './quality';

THREE.ColorManagement.enabled = false;

/** Data alone draws no more often than this; the hand on the camera does. */
const DATA_FRAME_MS = 32;

/** A canvas and all that is in it. */
export class View {
  readonly scene = new THREE.Scene();
  readonly rig = new CameraRig(() => this.invalidate(true));
  readonly renderer: THREE.WebGLRenderer;
  readonly lighting: Lighting;
  /** What overlays of tools are added to. */
  readonly hands = new THREE.Group();
  drawn = 0;
  scriptMs = 0;
  private readonly before = new Set<(now: number) => void>();
  private readonly after = new Set<() => void>();
  private readonly governor: Governor;
  private readonly watcher: ResizeObserver;
  private readonly level: Level;
  private wanted = 0;
  private urgent = false;
  private last = 0;
  private visible = true;
  private timer = 0;

  constructor(readonly host: HTMLElement) {
    const quality = wantedQuality();
    this.level = firstLevel(quality);
    this.renderer = new THREE.WebGLRenderer({ antialias: this.level.antialias, alpha: true });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.canvas.className = 'scene-canvas';
    host.append(this.canvas);
    this.lighting = new Lighting(this.scene);
    this.hands.name = 'hands';
    this.scene.add(this.hands);
    this.governor = new Governor(this.renderer, this.level, quality === 'auto', () =>
      this.useLevel(),
    );
    this.useLevel();
    this.watcher = new ResizeObserver(() => this.resize());
    this.watcher.observe(host);
  }

  get canvas(): HTMLCanvasElement {
    return this.renderer.domElement;
  }

  get camera(): THREE.PerspectiveCamera | THREE.OrthographicCamera {
    return this.rig.camera;
  }

  /** Draw again soon; `urgent` at the next chance of the screen. */
  invalidate(urgent = false): void {
    this.urgent ||= urgent;
    if (!this.wanted && this.visible) this.wanted = requestAnimationFrame((now) => this.frame(now));
  }

  /** Something that throws shadows moved. */
  moved(): void {
    this.renderer.shadowMap.needsUpdate = true;
    this.invalidate();
  }

  /** Draw at a later time: something will have run out by then. */
  wakeIn(ms: number): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.invalidate(), ms);
  }

  /** Be called before every drawn frame. Returns what ends it. */
  beforeDraw(callback: (now: number) => void): () => void {
    this.before.add(callback);
    return () => this.before.delete(callback);
  }

  /** Be called after every drawn frame, while the picture can be read. */
  afterDraw(callback: () => void): () => void {
    this.after.add(callback);
    return () => this.after.delete(callback);
  }

  /** Hidden views draw nothing. */
  show(visible: boolean): void {
    this.visible = visible;
    if (visible) this.invalidate(true);
  }

  /** The ray through a point of the page. */
  ray(clientX: number, clientY: number): THREE.Ray {
    const box = this.canvas.getBoundingClientRect();
    const caster = new THREE.Raycaster();
    const x = ((clientX - box.left) / box.width) * 2 - 1;
    const y = 1 - ((clientY - box.top) / box.height) * 2;
    caster.setFromCamera(new THREE.Vector2(x, y), this.camera);
    return caster.ray;
  }

  /** Where a point of the scene is on the page, in CSS pixels. */
  toPage(point: THREE.Vector3): { x: number; y: number } {
    const box = this.canvas.getBoundingClientRect();
    const at = point.clone().project(this.camera);
    return {
      x: box.left + ((at.x + 1) / 2) * box.width,
      y: box.top + ((1 - at.y) / 2) * box.height,
    };
  }

  /** How many metres a pixel is, at a point. */
  metresPerPixel(point: THREE.Vector3): number {
    const height = this.host.clientHeight || 1;
    if (this.camera instanceof THREE.OrthographicCamera) return 1 / this.rig.state.scale;
    const away = this.camera.position.distanceTo(point);
    return (2 * away * Math.tan((this.camera.fov * Math.PI) / 360)) / height;
  }

  /** Draw now, out of turn. */
  drawNow(): void {
    this.draw(performance.now());
  }

  dispose(): void {
    this.show(false);
    cancelAnimationFrame(this.wanted);
    clearTimeout(this.timer);
    this.watcher.disconnect();
    this.renderer.dispose();
    this.canvas.remove();
  }

  private frame(now: number): void {
    this.wanted = 0;
    if (!this.visible || !this.host.clientWidth) return;
    if (!this.urgent && now - this.last < DATA_FRAME_MS) {
      this.invalidate();
      return;
    }
    this.urgent = false;
    this.last = now;
    this.draw(now);
  }

  private draw(now: number): void {
    const began = performance.now();
    if (this.rig.tick(now)) this.invalidate(true);
    this.before.forEach((callback) => callback(now));
    this.lighting.aim(new THREE.Vector3(...this.rig.state.focal), this.rig.state.distance);
    this.renderer.render(this.scene, this.camera);
    this.after.forEach((callback) => callback());
    this.drawn += 1;
    const took = performance.now() - began;
    this.scriptMs += took;
    this.governor.frame(took);
  }

  private useLevel(): void {
    this.renderer.setPixelRatio(this.level.pixelRatio);
    this.renderer.shadowMap.enabled = this.level.shadows;
    this.lighting.allow(this.level.shadows);
    this.renderer.shadowMap.needsUpdate = true;
    this.invalidate();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!width || !height) return;
    this.renderer.setSize(width, height);
    this.rig.resize(width, height);
    this.drawNow();
  }
}
