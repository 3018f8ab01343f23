/** The keys that drive: WASD, arrows, and those of teleop_twist_keyboard. */

/** A direction in parts of the largest velocities: forward, left, up, and turning left. */
export interface Direction {
  x: number;
  y: number;
  z: number;
  turn: number;
}

const KEYS: Readonly<Record<string, Partial<Direction>>> = {
  w: { x: 1 },
  s: { x: -1 },
  a: { turn: 1 },
  d: { turn: -1 },
  arrowup: { x: 1 },
  arrowdown: { x: -1 },
  arrowleft: { turn: 1 },
  arrowright: { turn: -1 },
  i: { x: 1 },
  ',': { x: -1 },
  j: { turn: 1 },
  l: { turn: -1 },
  u: { x: 1, turn: 1 },
  o: { x: 1, turn: -1 },
  m: { x: -1, turn: -1 },
  '.': { x: -1, turn: 1 },
  t: { z: 1 },
  b: { z: -1 },
};
const SIDEWAYS: Readonly<Record<string, Partial<Direction>>> = {
  i: { x: 1 },
  '<': { x: -1 },
  ',': { x: -1 },
  j: { y: 1 },
  l: { y: -1 },
  a: { y: 1 },
  d: { y: -1 },
  u: { x: 1, y: 1 },
  o: { x: 1, y: -1 },
  m: { x: -1, y: 1 },
  '>': { x: -1, y: -1 },
  '.': { x: -1, y: -1 },
  arrowleft: { y: 1 },
  arrowright: { y: -1 },
};
const STEP = 1.1;

/** The sum of what is pressed, each part from -1 to 1. */
export function directionOf(pressed: ReadonlyMap<string, boolean>): Direction {
  const sum: Direction = { x: 0, y: 0, z: 0, turn: 0 };
  for (const [key, shifted] of pressed) {
    const part = (shifted ? SIDEWAYS[key] : undefined) ?? KEYS[key] ?? {};
    for (const axis of ['x', 'y', 'z', 'turn'] as const) sum[axis] += part[axis] ?? 0;
  }
  for (const axis of ['x', 'y', 'z', 'turn'] as const)
    sum[axis] = Math.max(-1, Math.min(1, sum[axis]));
  return sum;
}

/** Follows the keys pressed on an element; all count as let go when it loses the focus. */
export class DriveKeys {
  private readonly pressed = new Map<string, boolean>();

  constructor(
    element: HTMLElement,
    private readonly changed: (pressed: ReadonlyMap<string, boolean>) => void,
    private readonly faster: (factor: number) => void,
  ) {
    element.addEventListener('keydown', (event) => this.down(event));
    element.addEventListener('keyup', (event) => this.up(event));
    element.addEventListener('blur', () => this.letGo());
  }

  /** Forgets what is pressed. */
  release(): void {
    this.pressed.clear();
  }

  private down(event: KeyboardEvent): void {
    const key = event.key.toLowerCase();
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (key === ' ' || key === 'k') this.letGo();
    else if (key === 'q' || key === 'z') this.faster(key === 'q' ? STEP : 1 / STEP);
    else if (key in KEYS || key in SIDEWAYS) this.press(event, key);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  private press(event: KeyboardEvent, key: string): void {
    if (event.repeat) return;
    this.pressed.set(key, event.shiftKey);
    this.changed(this.pressed);
  }

  private up(event: KeyboardEvent): void {
    const key = event.key.toLowerCase();
    const other: Record<string, string> = { '<': ',', ',': '<', '>': '.', '.': '>' };
    const had = this.pressed.delete(key) || this.pressed.delete(other[key] ?? '');
    if (had) this.changed(this.pressed);
  }

  private letGo(): void {
    this.pressed.clear();
    this.changed(this.pressed);
  }
}
