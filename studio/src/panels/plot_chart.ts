/** uPlot with the page's colours, wheel zoom and a window that moves along. */

import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { colour } from '../shell/theme';
import { short } from '../widgets/format';
import { thin, type Samples } from './plot_data';

/** One curve as it is drawn. */
export interface Curve {
  name: string;
  colour: string;
  samples: Samples;
  shown: boolean;
}

const POINTS_PER_PIXEL = 2;

/** The chart of the Plot panel. */
export class PlotChart {
  private chart: uPlot | null = null;
  private range: [number, number] | null = null;
  private signature = '';

  constructor(
    private readonly root: HTMLElement,
    private readonly zoomed: (zoomed: boolean) => void,
  ) {
    root.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    root.addEventListener('dblclick', () => this.reset());
  }

  /** Draws the curves from `from` to `to` seconds, or the part that was zoomed into. */
  draw(curves: readonly Curve[], from: number, to: number, width: number, height: number): void {
    if (width < 60 || height < 50) return;
    this.ensure(curves, width, height);
    const [low, high] = this.range ?? [from, to];
    const shown = curves.filter((curve) => curve.shown && curve.samples.length > 0);
    const tables = curves.map((curve): uPlot.AlignedData => {
      if (!shown.includes(curve)) return [[], []];
      return thin(curve.samples, low, high, width * POINTS_PER_PIXEL);
    });
    const data =
      tables.length > 0
        ? uPlot.join(
            tables,
            tables.map(() => [1]),
          )
        : ([[]] as uPlot.AlignedData);
    this.chart?.setData(data, false);
    this.chart?.setScale('x', { min: low, max: high });
  }

  /** Shows everything of the window again. */
  reset(): void {
    this.range = null;
    this.zoomed(false);
  }

  /** Whether the person looks at a part. */
  get isZoomed(): boolean {
    return this.range !== null;
  }

  /** New colours. */
  restyle(): void {
    this.signature = '';
  }

  destroy(): void {
    this.chart?.destroy();
  }

  private ensure(curves: readonly Curve[], width: number, height: number): void {
    const signature = JSON.stringify(
      curves.map((curve) => [curve.name, curve.colour, curve.shown]),
    );
    if (this.chart && signature === this.signature) {
      if (this.chart.width !== width || this.chart.height !== height)
        this.chart.setSize({ width, height });
      return;
    }
    this.signature = signature;
    this.chart?.destroy();
    this.chart = new uPlot(
      this.options(curves, width, height),
      [[], ...curves.map(() => [])],
      this.root,
    );
  }

  private options(curves: readonly Curve[], width: number, height: number): uPlot.Options {
    const axis = {
      stroke: colour('dim'),
      grid: { stroke: colour('line'), width: 1 },
      ticks: { stroke: colour('line'), width: 1 },
      font: '11px system-ui',
    };
    return {
      width,
      height,
      legend: { show: false },
      cursor: { drag: { x: true, y: false, setScale: false }, points: { size: 5 } },
      scales: { x: { time: false }, y: { range: (_chart, low, high) => padded(low, high) } },
      axes: [
        { ...axis, size: 34, space: 90, values: (_chart, ticks) => ticks.map(timeText) },
        {
          ...axis,
          size: (_chart, texts) => widthOf(texts),
          values: (_chart, ticks) => ticks.map(valueText),
        },
      ],
      series: [
        {},
        ...curves.map((curve) => ({
          label: curve.name,
          stroke: curve.colour,
          width: 1.5,
          show: curve.shown,
          spanGaps: true,
          points: { show: false },
        })),
      ],
      hooks: { setSelect: [(chart) => this.select(chart)] },
    };
  }

  private select(chart: uPlot): void {
    if (chart.select.width < 5) return;
    this.zoomTo(
      chart.posToVal(chart.select.left, 'x'),
      chart.posToVal(chart.select.left + chart.select.width, 'x'),
    );
    chart.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  }

  private wheel(event: WheelEvent): void {
    const { min, max } = this.chart?.scales.x ?? {};
    if (!this.chart || typeof min !== 'number' || typeof max !== 'number') return;
    event.preventDefault();
    const at = this.chart.posToVal(
      event.clientX - this.chart.over.getBoundingClientRect().left,
      'x',
    );
    const factor = Math.exp(event.deltaY * 0.0012);
    this.zoomTo(at - (at - min) * factor, at + (max - at) * factor);
  }

  private zoomTo(low: number, high: number): void {
    if (high - low < 1e-6) return;
    this.range = [low, high];
    this.zoomed(true);
  }
}

const WALL_S = 1e8;

/** Simulated seconds as they are, wall time as a clock shows it. */
function timeText(time_s: number): string {
  if (time_s < WALL_S) return short(time_s, 8);
  const time = new Date(time_s * 1000);
  const two = (value: number) => String(value).padStart(2, '0');
  const rest =
    time.getMilliseconds() > 0
      ? `.${String(time.getMilliseconds()).padStart(3, '0').replace(/0+$/, '')}`
      : '';
  return `${two(time.getHours())}:${two(time.getMinutes())}:${two(time.getSeconds())}${rest}`;
}

/** Room for the numbers beside an axis, pixels; the first round has none yet. */
function widthOf(texts: readonly string[] | null): number {
  const longest = Math.max(0, ...(texts ?? []).map((each) => each.length));
  return Math.max(58, 22 + 7 * longest);
}

/** A few characters, however large the values are. */
function valueText(value: number): string {
  const size = Math.abs(value);
  return size >= 1e6 || (size > 0 && size < 1e-4)
    ? value.toExponential(2).replace(/\.?0+e/, 'e')
    : short(value, 5);
}

function padded(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high))
    return [-1, 1];
  if (high - low < 1e-9)
    return [low - Math.max(0.1, Math.abs(low) * 0.1), high + Math.max(0.1, Math.abs(high) * 0.1)];
  const margin = (high - low) * 0.08;
  return [low - margin, high + margin];
}
