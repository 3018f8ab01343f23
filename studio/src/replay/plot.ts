/** Curves of numbers over the time of a recording; a click goes to a time. */
import { colour } from '../shell/theme';
import { short, type Column } from './table';

const LEFT_PX = 52;
const BOTTOM_PX = 18;
const TOP_PX = 8;
const RIGHT_PX = 10;
const CURVES = 8;

/** The name of a curve's colour in the style sheet. */
export const curveColour = (number: number): string => `curve-${(number % CURVES) + 1}`;

/** A canvas with curves. */
export class Plot {
  readonly canvas = document.createElement('canvas');
  columns: Column[] = [];
  private time_s = 0;
  private wanted = 0;

  constructor(
    private readonly duration_s: number,
    seek: (time_s: number) => void,
  ) {
    this.canvas.className = 'replay-plot';
    this.canvas.setAttribute('role', 'img');
    const go = (event: PointerEvent): void => {
      if (!(event.buttons & 1)) return;
      const { left, width } = this.canvas.getBoundingClientRect();
      const share = (event.clientX - left - LEFT_PX) / (width - LEFT_PX - RIGHT_PX);
      seek(share * this.duration_s);
    };
    this.canvas.addEventListener('pointerdown', (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      go(event);
    });
    this.canvas.addEventListener('pointermove', go);
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  /** Draw other curves. */
  set(columns: Column[]): void {
    this.columns = columns;
    const names = columns.map((one) => one.title).join(', ');
    this.canvas.setAttribute('aria-label', names ? `Curves of ${names}` : 'No curve is chosen');
    this.draw();
  }

  /** Move the line that says when. */
  look(time_s: number): void {
    this.time_s = time_s;
    if (!this.wanted)
      this.wanted = requestAnimationFrame(() => {
        this.wanted = 0;
        this.draw();
      });
  }

  draw(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    const ratio = devicePixelRatio || 1;
    if (
      this.canvas.width !== Math.round(width * ratio) ||
      this.canvas.height !== Math.round(height * ratio)
    ) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    const context = this.canvas.getContext('2d');
    if (!context) return;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    context.font = '11px system-ui, sans-serif';
    const [low, high] = this.bounds();
    const right = width - RIGHT_PX;
    const bottom = height - BOTTOM_PX;
    const x = (time_s: number): number =>
      LEFT_PX + (time_s / (this.duration_s || 1)) * (right - LEFT_PX);
    const y = (value: number): number =>
      bottom - ((value - low) / (high - low)) * (bottom - TOP_PX);
    this.axes(context, low, high, x, y, right, bottom);
    context.save();
    context.beginPath();
    context.rect(LEFT_PX, 0, right - LEFT_PX, height);
    context.clip();
    this.columns.forEach((column, number) => {
      context.strokeStyle = colour(curveColour(number));
      context.lineWidth = 1.5;
      this.curve(context, column, x, y, right - LEFT_PX);
    });
    context.restore();
    context.strokeStyle = colour('text');
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(x(this.time_s), TOP_PX);
    context.lineTo(x(this.time_s), bottom);
    context.stroke();
  }

  private bounds(): [number, number] {
    let [low, high] = [Infinity, -Infinity];
    for (const column of this.columns)
      for (const value of column.series()) {
        if (value < low) low = value;
        if (value > high) high = value;
      }
    if (!Number.isFinite(low)) return [0, 1];
    const air = (high - low) * 0.06 || Math.max(1e-6, Math.abs(high) * 0.1) || 1;
    return [low - air, high + air];
  }

  private axes(
    context: CanvasRenderingContext2D,
    low: number,
    high: number,
    x: (time_s: number) => number,
    y: (value: number) => number,
    right: number,
    bottom: number,
  ): void {
    context.strokeStyle = colour('line');
    context.fillStyle = colour('dim');
    context.lineWidth = 1;
    context.textBaseline = 'middle';
    context.textAlign = 'right';
    for (const value of ticks(low, high, 4)) {
      context.beginPath();
      context.moveTo(LEFT_PX, y(value));
      context.lineTo(right, y(value));
      context.stroke();
      context.fillText(short(value), LEFT_PX - 5, y(value));
    }
    context.textBaseline = 'top';
    context.textAlign = 'center';
    for (const time_s of ticks(0, this.duration_s, 6)) {
      context.beginPath();
      context.moveTo(x(time_s), TOP_PX);
      context.lineTo(x(time_s), bottom);
      context.stroke();
      context.fillText(`${short(time_s)} s`, Math.min(x(time_s), right - 10), bottom + 4);
    }
  }

  private curve(
    context: CanvasRenderingContext2D,
    column: Column,
    x: (time_s: number) => number,
    y: (value: number) => number,
    width: number,
  ): void {
    const { times } = column.topic;
    const values = column.series();
    // Two points for each pixel are enough to the eye.
    const every = Math.max(1, Math.floor(times.length / (2 * width)));
    let drawing = false;
    context.beginPath();
    for (let row = 0; row < times.length; row += every) {
      const value = values[row];
      if (!Number.isFinite(value)) drawing = false;
      else if (drawing) context.lineTo(x(times[row]), y(value));
      else {
        context.moveTo(x(times[row]), y(value));
        drawing = true;
      }
    }
    context.stroke();
  }
}

function ticks(low: number, high: number, wanted: number): number[] {
  const raw = (high - low) / wanted;
  if (!(raw > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= raw) ?? raw;
  const found: number[] = [];
  for (let value = Math.ceil(low / step) * step; value <= high + step * 1e-9; value += step)
    found.push(Math.abs(value) < step * 1e-9 ? 0 : value);
  return found;
}
