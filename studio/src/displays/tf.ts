/** TF: axes, names and arrows of all frames. */
import * as THREE from 'three';
import { axesGeometry } from '../model/geometry';
import { freeLabel, label } from '../scene/labels';
import type { Drawing, Drawer, Site } from './display';
import { flag, num } from './properties';
import { InstancePool } from './instanced_shapes';

const ARROW_COLOUR = 0xdccf5a;

/** RViz's TF. */
export const TF: Drawing = {
  properties: [
    flag('Show Names', true, 'Whether the names of the frames are drawn.'),
    flag('Show Axes', true, 'Whether axes are drawn at the frames.'),
    flag('Show Arrows', true, 'Whether lines go from each frame to its parent.'),
    num('Marker Scale', 1, 'Size of axes and names; 1 is 0.3 m long.', { min: 0.01 }),
    num('Marker Alpha', 1, 'How opaque axes and names are.', { min: 0, max: 1 }),
    flag('Frames/All Enabled', true, 'All frames on or off.'),
  ],
  make: (site) => new TfDrawer(site),
};

class TfDrawer implements Drawer {
  private readonly paint = new THREE.MeshPhongMaterial({ vertexColors: true });
  private readonly axes: InstancePool;
  private readonly lines: THREE.LineSegments;
  private readonly names = new Map<string, THREE.Sprite>();
  private readonly stops: (() => void)[];
  private readonly matrix = new THREE.Matrix4();
  private readonly place = new THREE.Vector3();
  private readonly turn = new THREE.Quaternion();
  private readonly size = new THREE.Vector3();
  private visible = true;

  constructor(private readonly site: Site) {
    this.axes = new InstancePool(site.root, axesGeometry(1, 0.07), this.paint);
    const material = new THREE.LineBasicMaterial({ color: ARROW_COLOUR });
    this.lines = new THREE.LineSegments(new THREE.BufferGeometry(), material);
    this.lines.frustumCulled = false;
    site.root.add(this.lines);
    this.stops = [
      site.frames.onMoved(() => this.update()),
      site.frames.onRenamed(() => this.rename()),
    ];
    this.rename();
  }

  changed(path: string): void {
    if (path === 'Frames/All Enabled') {
      const on = this.site.props.flag(path);
      this.site.frames.infos.forEach((info) => this.site.props.set(`Frames/${info.name}`, on));
    }
    if (path === 'Marker Scale' || path === 'Marker Alpha' || path === '') this.rename();
    this.paint.opacity = this.site.props.num('Marker Alpha');
    this.paint.transparent = this.paint.opacity < 1;
    this.update();
  }

  shown(visible: boolean): void {
    this.visible = visible;
    this.update();
  }

  clear(): void {
    this.update();
  }

  dispose(): void {
    this.stops.forEach((stop) => stop());
    this.names.forEach(freeLabel);
    this.axes.dispose();
    this.lines.geometry.dispose();
  }

  counts(): Record<string, number> {
    const names = [...this.names.values()].filter((name) => name.visible).length;
    return {
      frames: this.axes.count,
      names,
      arrows: (this.lines.geometry.drawRange.count || 0) / 2,
    };
  }

  private rename(): void {
    const { frames, props, root } = this.site;
    this.names.forEach((sprite) => {
      root.remove(sprite);
      freeLabel(sprite);
    });
    this.names.clear();
    const height = 0.1 * props.num('Marker Scale');
    for (const { name } of frames.infos) {
      this.site.offer(
        flag(`Frames/${name}`, props.flag('Frames/All Enabled'), `Whether ${name} is drawn.`),
      );
      const sprite = label(name, { height, alpha: props.num('Marker Alpha'), onTop: true });
      sprite.visible = false;
      this.names.set(name, sprite);
      root.add(sprite);
    }
    const positions = new THREE.BufferAttribute(new Float32Array(frames.infos.length * 6), 3);
    this.lines.geometry.dispose();
    this.lines.geometry = new THREE.BufferGeometry();
    this.lines.geometry.setAttribute('position', positions.setUsage(THREE.DynamicDrawUsage));
    this.lines.geometry.setDrawRange(0, 0);
  }

  private update(): void {
    if (!this.visible) return;
    const { frames, props, view } = this.site;
    const showAxes = props.flag('Show Axes');
    const showNames = props.flag('Show Names');
    const scale = 0.3 * props.num('Marker Scale');
    this.axes.begin();
    for (const info of frames.infos) {
      const at = props.flag(`Frames/${info.name}`) ? frames.at(info.name) : -1;
      const name = this.names.get(info.name);
      if (name) name.visible = showNames && at >= 0;
      if (at < 0) continue;
      this.place.fromArray(frames.poses, at);
      this.turn.fromArray(frames.poses, at + 3);
      if (showAxes)
        this.axes.put(this.matrix.compose(this.place, this.turn, this.size.setScalar(scale)));
      name?.position.set(this.place.x, this.place.y, this.place.z + 0.22 * scale);
    }
    this.axes.end();
    this.arrows();
    const count = frames.infos.filter((info) => frames.at(info.name) >= 0).length;
    const lost = frames.infos.length - count;
    if (lost)
      this.site.status(
        'Frames',
        'warn',
        `${lost} of ${frames.infos.length} frames have no way to [${frames.fixed}]`,
      );
    else if (count) this.site.status('Frames', 'ok', `${count} frames`);
    else this.site.status('Frames', 'warn', 'No tf data received');
    view.invalidate();
  }

  private arrows(): void {
    const { frames, props } = this.site;
    const attribute = this.lines.geometry.getAttribute('position') as
      | THREE.BufferAttribute
      | undefined;
    if (!attribute) return;
    let at = 0;
    for (const info of props.flag('Show Arrows') ? frames.infos : []) {
      const child = frames.at(info.name);
      const parent = info.parent ? frames.at(info.parent) : -1;
      if (child < 0 || parent < 0 || !props.flag(`Frames/${info.name}`)) continue;
      const array = attribute.array as Float32Array;
      for (let i = 0; i < 3; i++) {
        array[at + i] = frames.poses[child + i];
        array[at + 3 + i] = frames.poses[parent + i];
      }
      at += 6;
    }
    attribute.needsUpdate = true;
    this.lines.geometry.setDrawRange(0, at / 3);
  }
}
