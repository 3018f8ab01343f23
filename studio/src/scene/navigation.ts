/** The mouse and the keys on the camera: Gazebo's buttons in its view, RViz's in RViz's. */
import type { View } from './view';

export type MouseStyle = 'gazebo' | 'rviz';
type Action = 'rotate' | 'pan' | 'zoom';

const FLY_KEYS: Record<string, [number, number, number]> = {
  w: [0, 0, 1],
  s: [0, 0, -1],
  a: [-1, 0, 0],
  d: [1, 0, 0],
  q: [0, -1, 0],
  e: [0, 1, 0],
};
const ARROWS: Record<string, [number, number]> = {
  ArrowLeft: [-24, 0],
  ArrowRight: [24, 0],
  ArrowUp: [0, -24],
  ArrowDown: [0, 24],
};

/** Moves the camera of a view. A tool gets the pointer first and may keep it. */
export class Navigation {
  private action: Action | null = null;
  private at = { x: 0, y: 0 };
  private readonly held = new Set<string>();

  constructor(
    private readonly view: View,
    private readonly style: MouseStyle,
  ) {}

  down(event: PointerEvent): void {
    this.action = this.actionOf(event);
    this.at = { x: event.clientX, y: event.clientY };
  }

  move(event: PointerEvent): void {
    if (!this.action) return;
    const dx = event.clientX - this.at.x;
    const dy = event.clientY - this.at.y;
    this.at = { x: event.clientX, y: event.clientY };
    if (this.action === 'rotate') this.view.rig.rotate(dx, dy);
    else if (this.action === 'pan') this.view.rig.pan(dx, dy);
    else this.view.rig.zoom(Math.exp(dy * 0.008));
  }

  up(): void {
    this.action = null;
  }

  wheel(event: WheelEvent): void {
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
    this.view.rig.zoom(Math.exp(Math.max(-200, Math.min(200, event.deltaY * lines)) * 0.0012));
  }

  /** A key: fly in first person, arrows turn, + and - zoom. True if it was one of ours. */
  key(event: KeyboardEvent, down: boolean): boolean {
    const { rig } = this.view;
    const name = event.key.toLowerCase();
    if (rig.state.kind === 'FPS' && name in FLY_KEYS) {
      if (down && !this.held.size) this.fly();
      if (down) this.held.add(name);
      else this.held.delete(name);
      return true;
    }
    if (!down) return false;
    if (event.key in ARROWS) rig[event.shiftKey ? 'pan' : 'rotate'](...ARROWS[event.key]);
    else if (event.key === '+' || event.key === '=') rig.zoom(0.85);
    else if (event.key === '-') rig.zoom(1 / 0.85);
    else return false;
    return true;
  }

  /** No key is held any more: the view lost the keyboard. */
  release(): void {
    this.held.clear();
  }

  private fly(): void {
    let last = performance.now();
    const step = (now: number): void => {
      if (!this.held.size) return;
      const metres = ((now - last) / 1000) * 2.5;
      last = now;
      for (const name of this.held) {
        const [right, up, forward] = FLY_KEYS[name];
        this.view.rig.fly(right * metres, up * metres, forward * metres);
      }
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  private actionOf(event: PointerEvent): Action {
    const { button, shiftKey, ctrlKey } = event;
    if (button === 1) return this.style === 'gazebo' ? 'rotate' : shiftKey ? 'zoom' : 'pan';
    if (button === 2) return 'zoom';
    if (this.style === 'gazebo' && event.pointerType === 'mouse')
      return shiftKey ? 'rotate' : 'pan';
    return ctrlKey ? 'zoom' : shiftKey ? 'pan' : 'rotate';
  }
}
