/** Pointer, wheel and keys of a view: to the tool first, then to the camera. */
import type { Tool } from '../tools/tool';
import { Navigation, type MouseStyle } from './navigation';
import type { View } from './view';

const CLICK_PX = 5;

/** What the panel wants to hear of. */
export interface PointerHost {
  tool(): Tool;
  /** The right button was pressed and released at one place. */
  menu(event: PointerEvent): void;
  /** A key that neither tool nor camera took. */
  key(event: KeyboardEvent): boolean;
}

/** Listens on a view's canvas. */
export class Pointer {
  private readonly navigation: Navigation;
  private from: { x: number; y: number; button: number } | null = null;
  private taken = false;
  private dragged = false;

  constructor(
    private readonly view: View,
    style: MouseStyle,
    private readonly host: PointerHost,
  ) {
    this.navigation = new Navigation(view, style);
    const { canvas } = view;
    canvas.tabIndex = 0;
    canvas.addEventListener('pointerdown', (event) => this.down(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', (event) => this.up(event));
    canvas.addEventListener('pointercancel', (event) => this.up(event));
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    canvas.addEventListener('keydown', (event) => this.key(event, true));
    canvas.addEventListener('keyup', (event) => this.key(event, false));
    canvas.addEventListener('blur', () => this.navigation.release());
  }

  private down(event: PointerEvent): void {
    const { canvas } = this.view;
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    this.from = { x: event.clientX, y: event.clientY, button: event.button };
    this.dragged = false;
    this.taken = Boolean(this.host.tool().down?.(event));
    if (!this.taken) this.navigation.down(event);
  }

  private move(event: PointerEvent): void {
    if (
      this.from &&
      Math.hypot(event.clientX - this.from.x, event.clientY - this.from.y) > CLICK_PX
    )
      this.dragged = true;
    const taken = this.host.tool().move?.(event);
    if (!this.taken && !taken && this.dragged) this.navigation.move(event);
  }

  private up(event: PointerEvent): void {
    const { from } = this;
    this.from = null;
    this.navigation.up();
    const taken = this.host.tool().up?.(event) || this.taken;
    this.taken = false;
    if (!from || this.dragged || taken || event.type === 'pointercancel') return;
    if (from.button === 0) this.host.tool().click?.(event);
    else if (from.button === 2) this.host.menu(event);
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    this.navigation.wheel(event);
  }

  private key(event: KeyboardEvent, down: boolean): void {
    if (event.ctrlKey && event.key !== 'Control') return;
    const taken =
      (down && this.host.tool().keyDown?.(event)) ||
      this.navigation.key(event, down) ||
      (down && this.host.key(event));
    if (taken) event.preventDefault();
  }
}
