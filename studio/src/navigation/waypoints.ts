/** The list of waypoints: shown, ordered by keys and buttons, kept as Nav2's file. */
import type { JsonObject } from '../json';
import { part } from '../displays/message_fields';
import { button, h, notice } from '../widgets/dom';

/** A place to drive to: metres and radians in a frame. */
export interface Waypoint {
  frame: string;
  x: number;
  y: number;
  yaw: number;
}

/** Of a `geometry_msgs/PoseStamped`. */
export function waypointOf(pose: JsonObject): Waypoint {
  const { x = 0, y = 0 } = part(pose, 'pose', 'position') as Record<string, number>;
  const { z = 0, w = 1 } = part(pose, 'pose', 'orientation') as Record<string, number>;
  return { frame: String(part(pose, 'header').frame_id ?? ''), x, y, yaw: 2 * Math.atan2(z, w) };
}

/** As a `geometry_msgs/PoseStamped`; the server fills in the time. */
export function poseOf({ frame, x, y, yaw }: Waypoint): JsonObject {
  const orientation = { x: 0, y: 0, z: Math.sin(yaw / 2), w: Math.cos(yaw / 2) };
  return { header: { frame_id: frame }, pose: { position: { x, y, z: 0 }, orientation } };
}

/** The file that Nav2's panel saves; orientations are w, x, y, z there. */
export function asYaml(waypoints: readonly Waypoint[]): string {
  const rows = waypoints.map(
    ({ x, y, yaw }, index) =>
      `  waypoint${index}:\n    pose: [${x}, ${y}, 0]\n    orientation: [${Math.cos(yaw / 2)}, 0, 0, ${Math.sin(yaw / 2)}]\n`,
  );
  return `waypoints:\n${rows.join('')}`;
}

/** The list in the panel. */
export class WaypointList {
  readonly element = h('ol', {
    class: 'waypoints',
    role: 'listbox',
    tabindex: 0,
    'aria-label': 'Waypoints',
  });
  readonly items: Waypoint[] = [];
  /** What the list says where it is empty. */
  hint = '';
  private chosen = -1;
  private states: readonly string[] = [];

  constructor(private readonly changed: () => void) {
    this.element.addEventListener('keydown', (event) => this.key(event));
  }

  add(waypoint: Waypoint): void {
    this.items.push(waypoint);
    this.chosen = this.items.length - 1;
    this.tell();
  }

  replace(waypoints: readonly Waypoint[]): void {
    this.items.splice(0, this.items.length, ...waypoints);
    this.chosen = -1;
    this.tell();
  }

  /** What of each is said behind it: reached, missed. */
  mark(states: readonly string[]): void {
    this.states = states;
    this.draw();
  }

  draw(): void {
    const rows = this.items.map((item, index) => this.row(item, index));
    this.element.replaceChildren(...(rows.length ? rows : [notice(this.hint)]));
    if (this.chosen >= 0) this.element.setAttribute('aria-activedescendant', rowId(this.chosen));
    else this.element.removeAttribute('aria-activedescendant');
  }

  private row(item: Waypoint, index: number): HTMLElement {
    const state = this.states[index] ?? '';
    const text = `${item.x.toFixed(2)}, ${item.y.toFixed(2)} m · ${((item.yaw * 180) / Math.PI).toFixed(0)}°`;
    const away = button(
      '',
      (event) => {
        event.stopPropagation();
        this.remove(index);
      },
      { icon: 'trash', class: 'ghost', title: `Delete waypoint ${index + 1}` },
    );
    away.tabIndex = -1;
    return h(
      'li',
      {
        id: rowId(index),
        role: 'option',
        class: 'waypoint',
        'aria-selected': String(index === this.chosen),
        'data-state': state,
        on: {
          click: () => {
            this.chosen = index;
            this.draw();
          },
        },
      },
      h('b', {}, String(index + 1)),
      h('span', { class: 'mono' }, text),
      h('span', { class: 'dim' }, state),
      away,
    );
  }

  private key(event: KeyboardEvent): void {
    const step = event.key === 'ArrowDown' ? 1 : event.key === 'ArrowUp' ? -1 : 0;
    if (event.key === 'Delete' && this.chosen >= 0) this.remove(this.chosen);
    else if (step && event.altKey) this.move(step);
    else if (step) this.chosen = Math.max(0, Math.min(this.items.length - 1, this.chosen + step));
    else return;
    event.preventDefault();
    this.draw();
  }

  private move(step: number): void {
    const to = this.chosen + step;
    if (this.chosen < 0 || to < 0 || to >= this.items.length) return;
    this.items.splice(to, 0, ...this.items.splice(this.chosen, 1));
    this.chosen = to;
    this.tell();
  }

  private remove(index: number): void {
    this.items.splice(index, 1);
    this.chosen = Math.min(this.chosen, this.items.length - 1);
    this.tell();
  }

  private tell(): void {
    this.states = [];
    this.draw();
    this.changed();
  }
}

function rowId(index: number): string {
  return `waypoint-${index + 1}`;
}
