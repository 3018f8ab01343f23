/** InteractiveMarkers: markers of programs that people drag, press and open menus of. */
import * as THREE from 'three';
import type {
  InteractiveFrame,
  InteractiveMarker,
  InteractiveMarkerControl,
} from '../generated/messages';
import type { JsonObject } from '../json';
import { poseOf } from '../model/assembly';
import { freeLabel, label } from '../scene/labels';
import type { Drawing, Drawer, Site } from './display';
import { ControlDrag, controlAxis, defaultHandle } from './interactive_marker_controls';
import { MarkerSet } from './marker_set';
import { arrayMatrix, poseMatrix } from './message_fields';
import { flag } from './properties';

/** Event types of InteractiveMarkerFeedback. */
export const FEEDBACK = {
  KEEP_ALIVE: 0,
  POSE_UPDATE: 1,
  MENU_SELECT: 2,
  BUTTON_CLICK: 3,
  MOUSE_DOWN: 4,
  MOUSE_UP: 5,
};

/** RViz's InteractiveMarkers. */
export const INTERACTIVE_MARKERS: Drawing = {
  ownPose: true,
  properties: [
    flag('Show Descriptions', true, 'Whether the descriptions are drawn.'),
    flag('Show Axes', false, 'Whether axes are drawn at the markers.'),
    flag('Show Visual Aids', false, 'Whether helping lines are drawn while dragging.'),
    flag('Enable Transparency', true, 'Whether handles are see-through.'),
  ],
  make: (site) => new InteractiveDrawer(site),
};

/** What the tool Interact finds at an object: `userData.interact`. */
export interface Handle {
  marker: Pick<InteractiveMarker, 'name' | 'menu_entries'>;
  control: InteractiveMarkerControl;
  begin(ray: THREE.Ray): ControlDrag;
  moveTo(pose: THREE.Matrix4): void;
  send(event: number, menu?: number, point?: THREE.Vector3): void;
}

interface Shown {
  marker: InteractiveMarker;
  base: THREE.Matrix4;
  node: THREE.Group;
  sets: MarkerSet[];
  held: boolean;
}

class InteractiveDrawer implements Drawer {
  private readonly markers = new Map<string, Shown>();

  constructor(private readonly site: Site) {}

  take(value: JsonObject): void {
    const { message, poses: bases } = value as unknown as InteractiveFrame;
    const { status, frames } = this.site;
    for (const name of message.erases) this.erase(name);
    let lost = '';
    message.markers.forEach((marker, index) => {
      const base = arrayMatrix(bases[index]);
      if (base) this.build(marker, base);
      else lost = marker.header.frame_id;
    });
    for (const update of message.poses) {
      const found = this.markers.get(update.name);
      if (found && !found.held)
        setPose(found, found.base.clone().multiply(poseMatrix(update.pose)));
    }
    if (lost) status('Transform', 'error', `No transform from [${lost}] to [${frames.fixed}]`);
    else status('Transform', 'ok', 'Transform OK');
  }

  changed(): void {
    const all = [...this.markers.values()];
    all.forEach(({ marker, base }) => this.build(marker, base));
  }

  clear(): void {
    [...this.markers.keys()].forEach((name) => this.erase(name));
  }

  counts(): Record<string, number> {
    const controls = [...this.markers.values()].reduce(
      (sum, each) => sum + each.marker.controls.length,
      0,
    );
    return { markers: this.markers.size, controls };
  }

  private erase(name: string): void {
    const found = this.markers.get(name);
    if (!found) return;
    found.sets.forEach((set) => set.dispose());
    found.node.traverse((child) => child instanceof THREE.Sprite && freeLabel(child));
    this.site.root.remove(found.node);
    this.markers.delete(name);
  }

  private build(marker: InteractiveMarker, base: THREE.Matrix4): void {
    const old = this.markers.get(marker.name);
    if (old?.held) return;
    this.erase(marker.name);
    const node = new THREE.Group();
    node.name = marker.name;
    const shown: Shown = { marker, base, node, sets: [], held: false };
    setPose(shown, base.clone().multiply(poseMatrix(marker.pose)));
    const size = marker.scale || 1;
    if (marker.description && this.site.props.flag('Show Descriptions')) {
      const words = label(marker.description, { height: 0.12 * size, onTop: true });
      words.position.z = size * 0.65;
      node.add(words);
    }
    if (this.site.props.flag('Show Axes')) node.add(new THREE.AxesHelper(size * 0.5));
    for (const control of marker.controls) node.add(this.control(shown, control, size));
    this.site.root.add(node);
    this.markers.set(marker.name, shown);
  }

  private control(shown: Shown, control: InteractiveMarkerControl, size: number): THREE.Object3D {
    const group = new THREE.Group();
    group.name = control.name || 'control';
    if (control.interaction_mode > 0) group.userData.interact = this.handle(shown, control);
    const own = control.markers;
    if (!own.length) {
      const mesh = defaultHandle(control, size);
      if (mesh) group.add(mesh);
      return group;
    }
    const set = new MarkerSet(group, () => this.site.view.invalidate());
    own.forEach((marker, index) =>
      set.take({ ...marker, ns: 'control', id: index, action: 0 }, IDENTITY),
    );
    set.tick();
    shown.sets.push(set);
    return group;
  }

  private handle(shown: Shown, control: InteractiveMarkerControl): Handle {
    return {
      marker: shown.marker,
      control,
      begin: (ray) => {
        shown.held = true;
        shown.node.updateMatrix();
        const axis = controlAxis(control);
        if (control.orientation_mode !== 1) axis.applyQuaternion(shown.node.quaternion);
        return new ControlDrag(control.interaction_mode, shown.node.matrix.clone(), axis, ray);
      },
      moveTo: (pose) => {
        setPose(shown, pose);
        this.site.view.invalidate(true);
      },
      send: (event, menu = 0, point) => {
        if (event === FEEDBACK.MOUSE_UP) shown.held = false;
        this.feedback(shown, control, event, menu, point);
      },
    };
  }

  private feedback(
    shown: Shown,
    control: InteractiveMarkerControl,
    event: number,
    menu: number,
    point?: THREE.Vector3,
  ): void {
    const { connection, graph, frames } = this.site;
    shown.node.updateMatrix();
    const pose = poseOf(shown.node.matrix);
    const space = this.site.props
      .text('Topic')
      .replace(/\/update(_full)?$/, '')
      .replace(/\/$/, '');
    const type = graph.typeOf(`${space}/update`)?.includes('/msg/')
      ? 'visualization_msgs/msg/InteractiveMarkerFeedback'
      : 'visualization_msgs/InteractiveMarkerFeedback';
    const message = {
      header: { frame_id: frames.fixed },
      client_id: 'rviz',
      marker_name: shown.marker.name,
      control_name: control.name,
      event_type: event,
      menu_entry_id: menu,
      mouse_point_valid: Boolean(point),
      pose: {
        position: { x: pose[0], y: pose[1], z: pose[2] },
        orientation: { x: pose[3], y: pose[4], z: pose[5], w: pose[6] },
      },
      mouse_point: { x: point?.x ?? 0, y: point?.y ?? 0, z: point?.z ?? 0 },
    };
    connection
      .call('topic.publish', { topic: `${space}/feedback`, type, message })
      .catch((problem: Error) => this.site.status('Feedback', 'error', problem.message));
  }
}

const IDENTITY = new THREE.Matrix4();

function setPose(shown: Shown, pose: THREE.Matrix4): void {
  pose.decompose(shown.node.position, shown.node.quaternion, shown.node.scale);
}
