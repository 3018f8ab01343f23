/** A drawing that can be moved and made larger: wheel, drag, arrow keys, fit. */

import { h, perFrame, s } from './dom';

const LEAST_SCALE = 0.1;
const MOST_SCALE = 4;
const MARGIN = 24;

/** An SVG whose contents are in a group that is moved and scaled. */
export class PanZoom {
  readonly group = s('g');
  readonly svg = s('svg', { class: 'drawing', tabindex: 0, role: 'group' }, this.group);
  readonly element = h('div', { class: 'pan-zoom' }, this.svg);
  private x = 0;
  private y = 0;
  private scale = 1;
  private size: [number, number] = [0, 0];
  private fitting = true;
  private readonly apply = perFrame(() => this.draw());

  constructor(label: string) {
    this.svg.setAttribute('aria-label', label);
    this.svg.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    this.svg.addEventListener('pointerdown', (event) => this.drag(event));
    this.svg.addEventListener('keydown', (event) => this.key(event));
    new ResizeObserver(() => {
      if (this.fitting) this.fit();
    }).observe(this.element);
  }

  /** Says how large the contents are; the first time they are fitted into sight. */
  setSize(width: number, height: number): void {
    this.size = [width, height];
    if (this.fitting) this.fit();
  }

  /** Brings everything into sight, never larger than it is. */
  fit(): void {
    const { clientWidth, clientHeight } = this.element;
    const [width, height] = this.size;
    if (width === 0 || clientWidth === 0) return;
    const room = Math.min((clientWidth - MARGIN) / width, (clientHeight - MARGIN) / height);
    this.scale = Math.min(1.2, Math.max(LEAST_SCALE, room));
    this.x = (clientWidth - width * this.scale) / 2;
    this.y = (clientHeight - height * this.scale) / 2;
    this.fitting = true;
    this.apply();
  }

  /** Zooms about a point of the element. */
  zoom(factor: number, x = this.element.clientWidth / 2, y = this.element.clientHeight / 2): void {
    const next = Math.min(MOST_SCALE, Math.max(LEAST_SCALE, this.scale * factor));
    this.x = x - ((x - this.x) * next) / this.scale;
    this.y = y - ((y - this.y) * next) / this.scale;
    this.scale = next;
    this.fitting = false;
    this.apply();
  }

  private draw(): void {
    this.group.setAttribute('transform', `translate(${this.x} ${this.y}) scale(${this.scale})`);
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const box = this.svg.getBoundingClientRect();
    this.zoom(Math.exp(-event.deltaY * 0.0015), event.clientX - box.left, event.clientY - box.top);
  }

  private drag(event: PointerEvent): void {
    if (event.button !== 0) return;
    const from = { x: event.clientX - this.x, y: event.clientY - this.y };
    const start = { x: event.clientX, y: event.clientY };
    const move = (now: PointerEvent) => {
      if (this.fitting && Math.hypot(now.clientX - start.x, now.clientY - start.y) < 4) return;
      this.fitting = false;
      this.x = now.clientX - from.x;
      this.y = now.clientY - from.y;
      this.apply();
    };
    const up = () => {
      removeEventListener('pointermove', move);
      removeEventListener('pointerup', up);
    };
    addEventListener('pointermove', move);
    addEventListener('pointerup', up);
  }

  private key(event: KeyboardEvent): void {
    const step = 40;
    const moves: Record<string, () => void> = {
      ArrowLeft: () => {
        this.x += step;
      },
      ArrowRight: () => {
        this.x -= step;
      },
      ArrowUp: () => {
        this.y += step;
      },
      ArrowDown: () => {
        this.y -= step;
      },
      '+': () => this.zoom(1.2),
      '-': () => this.zoom(1 / 1.2),
      '0': () => this.fit(),
    };
    const move = moves[event.key];
    if (!move || event.ctrlKey) return;
    event.preventDefault();
    event.stopPropagation();
    if (event.key.startsWith('Arrow')) this.fitting = false;
    move();
    this.apply();
  }
}
