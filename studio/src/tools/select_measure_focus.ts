/** Move Camera, Select, Focus Camera, Measure and Publish Point. */
import * as THREE from 'three';
import { freeLabel, label } from '../scene/labels';
import { groundPoint, pick } from '../scene/picking';
import { stampedHeader, typeFor } from './message_types';
import type { Bench, Tool } from './tool';

/** Moves the camera; a click selects. */
export function moveCamera(bench: Bench): Tool {
  return {
    name: 'Move Camera',
    key: 'm',
    about: 'Move the camera with the mouse. A click selects.',
    click: (event) => select(bench, event),
  };
}

/** Selects what is clicked; a second click on the same model selects its link. */
export function selectTool(bench: Bench): Tool {
  return {
    name: 'Select',
    key: 's',
    about: 'Select a model; click again for its link.',
    cursor: 'pointer',
    click: (event) => select(bench, event),
  };
}

function select(bench: Bench, event: PointerEvent): void {
  const hit = pick(bench.view, event.clientX, event.clientY);
  const before = bench.world.selection;
  const again =
    hit?.entity && before?.model === hit.entity.model && before.link !== hit.entity.link;
  bench.world.selectEntity(hit?.entity ?? null, Boolean(again));
  const at = hit ? ` at ${format(hit.point)}` : '';
  bench.say(hit?.entity ? `${hit.entity.body}${at}` : '');
}

/** Looks at what is clicked. */
export function focusCamera(bench: Bench): Tool {
  return {
    name: 'Focus Camera',
    key: 'c',
    about: 'Click what the camera shall look at.',
    cursor: 'crosshair',
    click(event) {
      const hit = pick(bench.view, event.clientX, event.clientY);
      const point = hit?.point ?? groundPoint(bench.view, event.clientX, event.clientY);
      if (point) bench.view.rig.glideTo({ focal: [point.x, point.y, point.z] });
      bench.done();
    },
  };
}

/** Measures between two points. */
export function measure(bench: Bench): Tool {
  const line = new THREE.Line(
    new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ color: 0xffd84a, depthTest: false }),
  );
  line.renderOrder = 30;
  line.frustumCulled = false;
  let from: THREE.Vector3 | null = null;
  let text: THREE.Sprite | null = null;
  const clear = (): void => {
    line.removeFromParent();
    if (text) {
      text.removeFromParent();
      freeLabel(text);
    }
    text = null;
  };
  const show = (to: THREE.Vector3): void => {
    if (!from) return;
    line.geometry.setFromPoints([from, to]);
    bench.view.hands.add(line);
    bench.say(`Length: ${from.distanceTo(to).toFixed(3)} m`);
    bench.view.invalidate(true);
  };
  return {
    name: 'Measure',
    key: 'n',
    about: 'Click two points to measure between them.',
    cursor: 'crosshair',
    begin: () => bench.say('Click on two points to measure their distance.'),
    end() {
      clear();
      from = null;
      bench.view.invalidate(true);
    },
    move(event) {
      const to = from && spot(bench, event);
      if (to) show(to);
      return false;
    },
    click(event) {
      const point = spot(bench, event);
      if (!point) return;
      if (!from) {
        clear();
        from = point;
        return;
      }
      show(point);
      text = label(`${from.distanceTo(point).toFixed(3)} m`, {
        height: 26,
        pixels: true,
        onTop: true,
        colour: [1, 0.85, 0.3],
      });
      text.position.copy(from).lerp(point, 0.5);
      bench.view.hands.add(text);
      from = null;
    },
  };
}

/** Publishes the clicked point on /clicked_point. */
export function publishPoint(bench: Bench): Tool {
  return {
    name: 'Publish Point',
    key: 'u',
    about: 'Click a point; it is published on /clicked_point.',
    cursor: 'crosshair',
    begin: () => bench.say('Click on a point to publish it on /clicked_point.'),
    move(event) {
      const point = spot(bench, event);
      if (point) bench.say(format(point));
      return false;
    },
    click(event) {
      const point = spot(bench, event);
      if (!point) return;
      const message = {
        header: stampedHeader(bench.displays.fixedFrame),
        point: { x: point.x, y: point.y, z: point.z },
      };
      const type = typeFor(bench.graph, 'geometry_msgs/PointStamped');
      bench.connection
        .call('topic.publish', { topic: '/clicked_point', type, message })
        .catch(bench.fail);
      bench.say(`/clicked_point: ${format(point)}`);
      bench.done();
    },
  };
}

function spot(bench: Bench, event: PointerEvent): THREE.Vector3 | null {
  return (
    pick(bench.view, event.clientX, event.clientY)?.point ??
    groundPoint(bench.view, event.clientX, event.clientY)
  );
}

function format({ x, y, z }: THREE.Vector3): string {
  return `[${x.toFixed(3)}, ${y.toFixed(3)}, ${z.toFixed(3)}]`;
}
