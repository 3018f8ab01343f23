/** Plots, pictures and tables of a user's panel. */

import { bytes, type Frame } from '../binary_frame';
import { numberOf, textOf, textsOf, type Json, type JsonObject } from '../json';
import { PlotChart, type Curve } from '../panels/plot_chart';
import { Samples } from '../panels/plot_data';
import { colour, onTheme } from '../shell/theme';
import { h, perFrame, setText } from './dom';
import { short } from './format';
import { labelOf, type WidgetView } from './plugin_controls';

const CURVE_COLOURS = 8;
const PLOT_HEIGHT = 150;

/** What views need of their panel. */
export interface ViewHost {
  /** Where the pictures of the panel are: `/plugin/<name>/`. */
  readonly base: string;
  /** Opens a stream of pictures; answers what ends it. */
  pictures(
    topic: string,
    draw: (frame: Frame) => Promise<void>,
    tell: (text: string) => void,
  ): () => void;
}

/** The view of a plot, picture or table; null for what the page does not know. */
export function viewFor(spec: JsonObject, host: ViewHost): WidgetView | null {
  switch (textOf(spec, 'kind')) {
    case 'plot':
      return new PlotView(spec);
    case 'image':
      return textOf(spec, 'topic') ? topicImage(spec, host) : codeImage(spec, host);
    case 'table':
      return table(spec);
    default:
      return null;
  }
}

class PlotView implements WidgetView {
  readonly element: HTMLElement;
  private readonly area = h('div', { class: 'plot-area own-plot', role: 'img' });
  private readonly chart: PlotChart;
  private readonly curves: Curve[];
  private readonly outputs: HTMLOutputElement[] = [];
  private readonly draw = perFrame(() => this.drawNow());
  private readonly observer = new ResizeObserver(() => this.draw());
  private readonly forgetTheme: () => void;

  constructor(private readonly spec: JsonObject) {
    const unit = textOf(spec, 'unit');
    this.curves = textsOf(spec, 'curves').map((name, index) => ({
      name,
      colour: curveColour(index),
      samples: new Samples(),
      shown: true,
    }));
    const legend = this.curves.map((curve) => this.legendRow(curve, unit));
    this.area.setAttribute(
      'aria-label',
      `${labelOf(spec)}: ${this.curves.map((curve) => curve.name).join(', ')}`,
    );
    this.element = h(
      'figure',
      { class: 'own-figure', title: textOf(spec, 'help') || undefined },
      h('figcaption', { class: 'own-label' }, labelOf(spec)),
      this.area,
      h('div', { class: 'own-legend' }, ...legend),
    );
    this.chart = new PlotChart(this.area, () => this.draw());
    this.observer.observe(this.area);
    this.forgetTheme = onTheme(() => this.restyle());
  }

  show(): void {}

  add(points: readonly Json[]): void {
    for (const point of points) {
      if (!Array.isArray(point)) continue;
      this.curves.forEach((curve, index) =>
        curve.samples.add([Number(point[0])], [Number(point[index + 1])]),
      );
    }
    this.draw();
  }

  dispose(): void {
    this.observer.disconnect();
    this.forgetTheme();
    this.chart.destroy();
  }

  private drawNow(): void {
    this.curves.forEach((curve, index) =>
      setText(
        this.outputs[index],
        Number.isNaN(curve.samples.last()) ? '–' : short(curve.samples.last(), 4),
      ),
    );
    const end = Math.max(...this.curves.map((curve) => curve.samples.end()));
    if (!Number.isFinite(end) || !this.area.isConnected) return;
    this.chart.draw(
      this.curves,
      end - numberOf(this.spec, 'window_s', 30),
      end,
      this.area.clientWidth,
      PLOT_HEIGHT,
    );
  }

  private legendRow(curve: Curve, unit: string): HTMLElement {
    const output = h('output', { 'aria-label': curve.name });
    this.outputs.push(output);
    const swatch = h('span', { class: 'own-swatch' });
    swatch.style.background = curve.colour;
    return h(
      'span',
      { class: 'own-inline' },
      swatch,
      curve.name,
      output,
      unit ? h('span', { class: 'dim' }, unit) : null,
    );
  }

  private restyle(): void {
    this.curves.forEach((curve, index) => {
      curve.colour = curveColour(index);
    });
    this.element.querySelectorAll<HTMLElement>('.own-swatch').forEach((swatch, index) => {
      swatch.style.background = curveColour(index);
    });
    this.chart.restyle();
    this.draw();
  }
}

function curveColour(index: number): string {
  return colour(`curve-${(index % CURVE_COLOURS) + 1}`);
}

function figure(spec: JsonObject, ...children: HTMLElement[]): HTMLElement {
  return h(
    'figure',
    { class: 'own-figure', title: textOf(spec, 'help') || undefined },
    h('figcaption', { class: 'own-label' }, labelOf(spec)),
    ...children,
  );
}

/** A picture of the panel's code: its value is a number that grows; the next is fetched when the last is there. */
function codeImage(spec: JsonObject, host: ViewHost): WidgetView {
  const picture = h('img', { class: 'own-picture', alt: labelOf(spec) });
  let wanted = 0;
  let shown = 0;
  let loading = false;
  const fetchNewest = () => {
    if (loading || wanted === shown) return;
    loading = true;
    shown = wanted;
    picture.src = `${host.base}${encodeURIComponent(textOf(spec, 'name'))}?v=${wanted}`;
  };
  const done = () => {
    loading = false;
    fetchNewest();
  };
  picture.addEventListener('load', done);
  picture.addEventListener('error', done);
  return {
    element: figure(spec, picture),
    show: (value) => {
      wanted = typeof value === 'number' ? value : 0;
      fetchNewest();
    },
  };
}

function topicImage(spec: JsonObject, host: ViewHost): WidgetView {
  const canvas = h('canvas', {
    class: 'own-picture',
    role: 'img',
    'aria-label': labelOf(spec),
    width: 0,
    height: 0,
  });
  const status = h('div', { class: 'dim' }, `Waiting for ${textOf(spec, 'topic')}`);
  const draw = async (frame: Frame): Promise<void> => {
    const picture = await createImageBitmap(new Blob([bytes(frame)]));
    canvas.width = picture.width;
    canvas.height = picture.height;
    canvas.getContext('2d')?.drawImage(picture, 0, 0);
    picture.close();
    status.hidden = true;
  };
  const end = host.pictures(textOf(spec, 'topic'), draw, (text) => {
    status.hidden = !text;
    setText(status, text);
  });
  return { element: figure(spec, canvas, status), show: () => undefined, dispose: end };
}

function table(spec: JsonObject): WidgetView {
  const body = h('tbody');
  const heads = textsOf(spec, 'columns').map((column) => h('th', { scope: 'col' }, column));
  const element = figure(
    spec,
    h(
      'table',
      { class: 'own-table', 'aria-label': labelOf(spec) },
      h('thead', {}, h('tr', {}, ...heads)),
      body,
    ),
  );
  const cell = (value: Json) =>
    typeof value === 'number'
      ? h('td', { class: 'number' }, short(value))
      : h('td', {}, String(value));
  return {
    element,
    show: (value) => {
      const rows = Array.isArray(value)
        ? value.filter((row): row is Json[] => Array.isArray(row))
        : [];
      body.replaceChildren(...rows.map((row) => h('tr', {}, ...row.map(cell))));
    },
  };
}
