/** Image and Camera: pictures, and the scene laid over what a camera sees. */
import * as THREE from 'three';
import type { Frame } from '../binary_frame';
import type { JsonObject } from '../json';
import type { Drawing, Drawer, Site } from './display';
import { arrayMatrix, numbers, part } from './message_fields';
import { PictureBox } from './picture_box';
import { choice, flag, num } from './properties';

/** RViz's Image. */
export const IMAGE: Drawing = {
  properties: [
    num('Max Value', 1, 'White of a depth image, metres.', { server: true }),
    num('Min Value', 0, 'Black of a depth image, metres.', { server: true }),
    flag('Normalize Range', true, 'Take black and white from the picture.', { server: true }),
  ],
  make(site) {
    const box = new PictureBox(site.view, 'Image');
    return {
      async frame(frame) {
        box.show(await box.decode(frame));
        site.status('Image', 'ok', `${frame.count >>> 16} x ${frame.count & 0xffff}`);
      },
      changed: () => box.setTitle(site.props.text('Topic') || 'Image'),
      clear: () => box.hide(true),
      shown: (visible) => box.hide(!visible),
      dispose: () => box.dispose(),
      counts: () => ({ pictures: box.pictures }),
    };
  },
};

/** RViz's Camera. */
export const CAMERA: Drawing = {
  ownPose: true,
  properties: [
    choice(
      'Image Rendering',
      'background and overlay',
      ['background', 'overlay', 'background and overlay'],
      'Where the picture lies.',
    ),
    num('Overlay Alpha', 0.5, 'How opaque the picture is over the scene.', { min: 0, max: 1 }),
    num('Zoom Factor', 1, 'Scale of the picture.', { min: 0.1, max: 20 }),
  ],
  make: (site) => new CameraDrawer(site),
};

/** ROS cameras look along +z with y down; three's along -z with y up. */
const OPTICAL = new THREE.Matrix4().makeRotationX(Math.PI);
const NEAR_M = 0.02;
const FAR_M = 500;

class CameraDrawer implements Drawer {
  private readonly box: PictureBox;
  private readonly camera = new THREE.PerspectiveCamera();
  private readonly stop: () => void;
  private readonly sheet = document.createElement('canvas');
  private info: JsonObject | null = null;
  private pose: THREE.Matrix4 | null = null;

  constructor(private readonly site: Site) {
    this.box = new PictureBox(site.view, 'Camera');
    this.camera.matrixAutoUpdate = false;
    this.stop = site.view.beforeDraw(() => this.overlay());
  }

  take(value: JsonObject): void {
    this.info = part(value, 'camera_info');
    this.pose = arrayMatrix(value.pose);
    const { status, frames } = this.site;
    if (!this.pose)
      return status('Transform', 'error', `No transform from the camera to [${frames.fixed}]`);
    status('Transform', 'ok', 'Transform OK');
    this.camera.matrix.copy(this.pose).multiply(OPTICAL);
    this.camera.matrixWorldNeedsUpdate = true;
    this.lens();
  }

  async frame(frame: Frame): Promise<void> {
    const picture = await this.box.decode(frame);
    this.sheet.width = picture.width;
    this.sheet.height = picture.height;
    this.sheet.getContext('2d')?.drawImage(picture, 0, 0);
    this.box.show(picture);
    this.site.status(
      'Camera Info',
      this.info ? 'ok' : 'warn',
      this.info ? 'OK' : 'No CameraInfo received: only the picture is shown',
    );
    this.site.view.invalidate();
  }

  changed(): void {
    this.box.setTitle(this.site.props.text('Topic') || 'Camera');
    this.lens();
  }

  clear(): void {
    this.box.hide(true);
  }

  shown(visible: boolean): void {
    this.box.hide(!visible);
  }

  dispose(): void {
    this.stop();
    this.box.dispose();
  }

  counts(): Record<string, number> {
    return {
      pictures: this.box.pictures,
      overlaid: Number(this.pose !== null && this.info !== null),
    };
  }

  /** The projection of the camera's P or K. */
  private lens(): void {
    const info = this.info;
    if (!info) return;
    const p = numbers(info.p ?? info.P);
    const k = numbers(info.k ?? info.K);
    const [fx, fy, cx, cy] = p[0] > 0 ? [p[0], p[5], p[2], p[6]] : [k[0], k[4], k[2], k[5]];
    const [width, height] = [Number(info.width), Number(info.height)];
    if (!(fx > 0 && width > 0))
      return this.site.status('Camera Info', 'error', 'CameraInfo holds no focal length');
    const zoom = this.site.props.num('Zoom Factor');
    this.camera.projectionMatrix.makePerspective(
      (-cx / fx / zoom) * NEAR_M,
      ((width - cx) / fx / zoom) * NEAR_M,
      (cy / fy / zoom) * NEAR_M,
      (-(height - cy) / fy / zoom) * NEAR_M,
      NEAR_M,
      FAR_M,
    );
    this.camera.projectionMatrixInverse.copy(this.camera.projectionMatrix).invert();
  }

  /** Draw the scene as this camera sees it into a corner of the view, and copy it over the picture. */
  private overlay(): void {
    if (!this.pose || !this.info || this.box.element.hidden || !this.site.root.visible) return;
    const { x, y, width, height } = this.box.place();
    if (width < 8 || height < 8) return;
    this.renderCorner(x, y, width, height);
    const paint = this.box.canvas.getContext('2d') as CanvasRenderingContext2D;
    const { width: w, height: h } = this.box.canvas;
    const mode = this.site.props.text('Image Rendering');
    const { view } = this.site;
    const ratio = view.renderer.getPixelRatio();
    paint.clearRect(0, 0, w, h);
    if (mode !== 'overlay') paint.drawImage(this.sheet, 0, 0, w, h);
    const top = view.canvas.height - (y + height) * ratio;
    paint.drawImage(view.canvas, x * ratio, top, width * ratio, height * ratio, 0, 0, w, h);
    paint.globalAlpha = mode === 'background' ? 0 : this.site.props.num('Overlay Alpha');
    paint.drawImage(this.sheet, 0, 0, w, h);
    paint.globalAlpha = 1;
  }

  /** The view itself is drawn after this and covers the corner again. */
  private renderCorner(x: number, y: number, width: number, height: number): void {
    const { renderer, scene, host } = this.site.view;
    const hidden = scene.children.filter(
      (child) => child.visible && ['sky', 'hands', 'grid'].includes(child.name),
    );
    const background = scene.background;
    hidden.forEach((child) => (child.visible = false));
    scene.background = null;
    renderer.setClearColor(0x000000, 0);
    renderer.setScissorTest(true);
    renderer.setScissor(x, y, width, height);
    renderer.setViewport(x, y, width, height);
    renderer.render(scene, this.camera);
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, host.clientWidth, host.clientHeight);
    scene.background = background;
    hidden.forEach((child) => (child.visible = true));
  }
}
