/** Interact: drags, presses and opens the menus of interactive markers. */
import type * as THREE from 'three';
import { FEEDBACK, type Handle } from '../displays/interactive_markers';
import { BUTTON, isDragged, MENU, type ControlDrag } from '../displays/interactive_marker_controls';
import { pick } from '../scene/picking';
import { openMenuAt } from '../world/menu';
import type { Bench, Tool } from './tool';

const SEND_MS = 33;

/** RViz's Interact. */
export function interact(bench: Bench): Tool {
  let held: { handle: Handle; drag: ControlDrag } | null = null;
  let last = 0;
  const drop = (): void => {
    held?.handle.send(FEEDBACK.MOUSE_UP);
    held = null;
  };
  return {
    name: 'Interact',
    key: 'i',
    about: 'Drag the handles of interactive markers.',
    end: drop,
    down(event) {
      const found = handleAt(bench, event);
      if (!found) return false;
      const mode = found.handle.control.interaction_mode;
      if (event.button === 2 || mode === MENU) {
        menu(event, found.handle, found.point);
        return true;
      }
      found.handle.send(FEEDBACK.MOUSE_DOWN, 0, found.point);
      if (isDragged(mode))
        held = {
          handle: found.handle,
          drag: found.handle.begin(bench.view.ray(event.clientX, event.clientY)),
        };
      else if (mode === BUTTON) {
        found.handle.send(FEEDBACK.MOUSE_UP, 0, found.point);
        found.handle.send(FEEDBACK.BUTTON_CLICK, 0, found.point);
      }
      return true;
    },
    move(event) {
      if (!held) return false;
      const pose = held.drag.pose(bench.view.ray(event.clientX, event.clientY));
      if (pose) held.handle.moveTo(pose);
      if (pose && performance.now() - last > SEND_MS) {
        last = performance.now();
        held.handle.send(FEEDBACK.POSE_UPDATE);
      }
      return true;
    },
    up() {
      if (!held) return false;
      held.handle.send(FEEDBACK.POSE_UPDATE);
      drop();
      return true;
    },
    click(event) {
      if (!handleAt(bench, event))
        bench.world.selectEntity(pick(bench.view, event.clientX, event.clientY)?.entity ?? null);
    },
  };
}

function handleAt(
  bench: Bench,
  event: PointerEvent,
): { handle: Handle; point: THREE.Vector3 } | null {
  const hit = pick(bench.view, event.clientX, event.clientY);
  for (let at: THREE.Object3D | null = hit?.object ?? null; at && hit; at = at.parent) {
    if (at.userData.interact) return { handle: at.userData.interact as Handle, point: hit.point };
  }
  return null;
}

function menu(event: PointerEvent, handle: Handle, point: THREE.Vector3): void {
  const entries = handle.marker.menu_entries ?? [];
  const depth = (id: number): number => {
    const parent = entries.find((entry) => entry.id === id)?.parent_id ?? 0;
    return parent ? 1 + depth(parent) : 0;
  };
  const parents = new Set(entries.map((entry) => entry.parent_id));
  openMenuAt(
    event.clientX,
    event.clientY,
    handle.marker.name,
    entries.map((entry) => ({
      text: `${'  '.repeat(depth(entry.id))}${entry.title}`,
      heading: parents.has(entry.id),
      run: () => handle.send(FEEDBACK.MENU_SELECT, entry.id, point),
    })),
  );
}
