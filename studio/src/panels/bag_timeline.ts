/** The time of a bag as a slider: click, drag or arrow keys go to a time. */

import { h } from '../widgets/dom';
import { clock } from '../widgets/format';

const SEEK_EVERY_MS = 80;

/** A timeline that follows the player and seeks while it is dragged. */
export class BagTimeline {
  private readonly slider = h('input', {
    type: 'range',
    class: 'timeline',
    'aria-label': 'Time in the bag',
    step: 'any',
    min: 0,
    max: 1,
  });
  readonly element = h('div', { class: 'bag-timeline' }, this.slider);
  private dragging = false;
  private sent = 0;

  constructor(seek: (time_s: number) => void) {
    this.slider.addEventListener('pointerdown', () => {
      this.dragging = true;
    });
    this.slider.addEventListener('pointerup', () => {
      this.dragging = false;
    });
    this.slider.addEventListener('input', () => {
      const now = performance.now();
      if (now - this.sent < SEEK_EVERY_MS) return;
      this.sent = now;
      seek(Number(this.slider.value));
    });
    this.slider.addEventListener('change', () => {
      this.dragging = false;
      seek(Number(this.slider.value));
    });
  }

  /** Shows where the player is. */
  show(begin_s: number, end_s: number, time_s: number): void {
    this.slider.min = String(begin_s);
    this.slider.max = String(end_s);
    this.slider.setAttribute('aria-valuetext', clock(time_s - begin_s));
    if (!this.dragging) this.slider.value = String(time_s);
  }
}
