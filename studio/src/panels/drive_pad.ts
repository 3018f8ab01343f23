/** A joystick: up is forward, left is turning left, the middle stands still. */

import { h } from '../widgets/dom';

/** The pad of the drive panels. */
export class DrivePad {
  private readonly knob = h('span', { class: 'pad-knob' });
  readonly element = h(
    'div',
    { class: 'pad', role: 'img', 'aria-label': 'Joystick: drag to drive' },
    this.knob,
  );
  private pointer: number | null = null;

  constructor(private readonly moved: (forward: number, turn: number) => void) {
    this.element.addEventListener('pointerdown', (event) => this.begin(event));
    this.element.addEventListener('pointermove', (event) => {
      if (event.pointerId === this.pointer) this.follow(event);
    });
    for (const name of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
      this.element.addEventListener(name, () => {
        if (this.pointer !== null) this.end();
      });
    }
  }

  /** Puts the knob into the middle without telling. */
  release(): void {
    this.pointer = null;
    this.place(0, 0);
  }

  private begin(event: PointerEvent): void {
    this.pointer = event.pointerId;
    this.element.setPointerCapture(event.pointerId);
    this.follow(event);
  }

  private follow(event: PointerEvent): void {
    const box = this.element.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * 2 - 1;
    const y = ((event.clientY - box.top) / box.height) * 2 - 1;
    const length = Math.max(1, Math.hypot(x, y));
    this.place(x / length, y / length);
    this.moved(-y / length, -x / length);
  }

  private end(): void {
    this.release();
    this.moved(0, 0);
  }

  private place(x: number, y: number): void {
    this.knob.style.left = `${50 + x * 50}%`;
    this.knob.style.top = `${50 + y * 50}%`;
  }
}
