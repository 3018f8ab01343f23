/** Plot: numbers of topics over time, added by their names or dragged from the Topic Monitor. */

import type { Channel } from '../channel';
import type { PlotCurves, PlotPoints } from '../generated/messages';
import { numberOf, textsOf, type Json, type JsonObject } from '../json';
import { colour, onTheme } from '../shell/theme';
import { button, h, notice, setText, spacer, toggle, toolbar } from '../widgets/dom';
import { download } from '../widgets/download';
import { acceptFields } from '../widgets/field_drag';
import { short } from '../widgets/format';
import { nameInput } from '../widgets/name_input';
import { BasePanel } from './base';
import { PlotChart, type Curve } from './plot_chart';
import { asCsv, Samples } from './plot_data';

interface Entry {
  text: string;
  channel: Channel;
  curves: Curve[];
  missing: boolean;
}

const COLOURS = 8;
const DRAW_EVERY_MS = 50;
/** A drawing that takes long is drawn less often: a twentieth of the time shall go into it. */
const IDLE_PER_DRAW = 20;
const LONGEST_REST_MS = 500;
const WINDOW_S = 20;

/** The Plot panel of rqt. */
export class Plot extends BasePanel {
  readonly title = 'Plot';
  private readonly entries: Entry[] = [];
  private readonly hidden = new Set<string>();
  private paused = false;
  private autoscroll = true;
  private window_s = WINDOW_S;
  private pausedAt = 0;
  private dirty = false;
  private nextDraw = 0;
  private coloursUsed = 0;
  private readonly area = h('div', { class: 'plot-area', role: 'img', 'aria-label': 'Plot' });
  private readonly legend = h('div', {
    class: 'plot-legend',
    role: 'list',
    'aria-label': 'Curves',
  });
  private readonly empty = notice(
    'Add a topic field such as /odom/twist/twist/linear/x, a whole topic such as /turtle1/pose/, or drag a value here.',
  );
  private readonly fitButton = button('', () => this.chart.reset(), {
    icon: 'fit',
    title: 'Show the whole window (double click)',
  });
  private readonly pauseButton = toggle('Pause', false, (on) => this.pause(on), {
    icon: 'pause',
    title: 'Pause',
  });
  private readonly follow = toggle(
    'Autoscroll',
    true,
    (on) => {
      this.autoscroll = on;
      this.mark();
    },
    { title: 'Follow the newest values' },
  );
  private readonly chart = new PlotChart(this.area, () => this.mark());
  private readonly input: HTMLInputElement;
  private readonly width = h('input', {
    type: 'number',
    class: 'small',
    min: 1,
    value: WINDOW_S,
    'aria-label': 'Window in seconds',
    title: 'Window in seconds',
  });
  private frame = 0;

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.element.classList.add('plot');
    this.input = nameInput({
      label: 'Topic field',
      placeholder: '/topic/field',
      names: () =>
        this.host.graph.value.topics.filter((each) => !each.hidden).map((each) => each.name),
      chosen: () => undefined,
    });
    this.input.addEventListener('keydown', (event) => {
      if (event.key === 'Enter') this.addTyped();
    });
    this.width.addEventListener('change', () => {
      this.window_s = Math.max(0.5, Number(this.width.value) || WINDOW_S);
      this.mark();
      this.host.touched();
    });
    this.area.append(this.empty);
    this.element.append(
      toolbar(
        'Plot',
        h('span', {}, this.input),
        button('Add', () => this.addTyped(), { icon: 'plus', title: 'Add the field' }),
        spacer(),
        this.pauseButton,
        this.follow,
        this.width,
        h('span', { class: 'dim' }, 's'),
        this.fitButton,
        button('', () => this.clear(), { icon: 'clear', title: 'Clear the curves' }),
        button('CSV', () => this.save(), { icon: 'save', title: 'Save the samples as CSV' }),
      ),
      this.area,
      this.legend,
    );
    acceptFields(this.element, this.area, (path) => this.add(path));
    this.atEnd(this.host.graph.watch(() => this.retry()));
    this.atEnd(
      onTheme(() => {
        this.recolour();
        this.chart.restyle();
        this.mark();
      }),
    );
    this.atEnd(() => {
      cancelAnimationFrame(this.frame);
      this.chart.destroy();
    });
    const turn = (now: number) => {
      this.drawIfDue(now);
      this.frame = requestAnimationFrame(turn);
    };
    this.frame = requestAnimationFrame(turn);
  }

  override open(params: JsonObject): void {
    for (const name of textsOf(params, 'hidden')) this.hidden.add(name);
    if ('window_s' in params) this.window_s = numberOf(params, 'window_s', WINDOW_S);
    this.width.value = String(this.window_s);
    for (const text of [
      ...textsOf(params, 'curves'),
      ...textsOf(params, 'args'),
      ...textsOf(params, 'topics'),
    ])
      this.add(text);
  }

  override state(): JsonObject {
    return {
      curves: this.entries.map((entry) => entry.text),
      hidden: [...this.hidden],
      window_s: this.window_s,
    };
  }

  override shown(visible: boolean): void {
    super.shown(visible);
    this.mark();
  }

  resized(): void {
    this.mark();
  }

  private addTyped(): void {
    for (const text of this.input.value.split(/[\s,]+/).filter(Boolean)) this.add(text);
    this.input.value = '';
  }

  private add(text: string): void {
    if (this.entries.some((entry) => entry.text === text)) return;
    const entry: Entry = {
      text,
      curves: [],
      missing: false,
      channel: this.stream(
        'topic.plot',
        { curves: [text] },
        {
          onOpened: (info) => this.name(entry, info),
          onData: (value) => this.take(entry, value),
          onFailed: (problem) => this.miss(entry, problem),
        },
      ),
    };
    this.entries.push(entry);
    this.host.touched();
  }

  /** A field that is not there is waited for: a plot is often opened before its node. */
  private miss(entry: Entry, problem: unknown): void {
    if (!entry.missing) this.host.fail(problem);
    entry.missing = true;
    this.showLegend();
  }

  private retry(): void {
    for (const entry of this.entries)
      if (entry.missing) entry.channel.change({ curves: [entry.text] });
  }

  private name(entry: Entry, info: Json): void {
    entry.missing = false;
    const { curves } = info as unknown as PlotCurves;
    entry.curves = curves.map(
      (name) =>
        entry.curves.find((curve) => curve.name === name) ?? {
          name,
          colour: this.nextColour(),
          samples: new Samples(),
          shown: !this.hidden.has(name),
        },
    );
    this.showLegend();
  }

  private take(entry: Entry, value: Json): void {
    for (const { curve, t, v } of value as unknown as PlotPoints[])
      entry.curves[curve]?.samples.add(t, v);
    if (!this.paused) this.mark();
  }

  private remove(entry: Entry): void {
    this.endStream(entry.channel);
    this.entries.splice(this.entries.indexOf(entry), 1);
    this.showLegend();
    this.host.touched();
  }

  private curves(): Curve[] {
    return this.entries.flatMap((entry) => entry.curves);
  }

  private mark(): void {
    this.dirty = true;
  }

  private drawIfDue(now: number): void {
    if (!this.dirty || !this.visible || now < this.nextDraw) return;
    this.dirty = false;
    const curves = this.curves();
    this.empty.hidden = curves.length > 0;
    const newest = Math.max(...curves.map((curve) => curve.samples.end()));
    const oldest = Math.min(
      ...curves.filter((curve) => curve.samples.length > 0).map((curve) => curve.samples.t[0]),
    );
    const end = this.paused ? this.pausedAt : newest;
    if (Number.isFinite(end)) {
      const from = this.autoscroll ? end - this.window_s : oldest;
      this.chart.draw(
        curves,
        from,
        Math.max(end, from + 1e-3),
        this.area.clientWidth,
        this.area.clientHeight,
      );
    }
    this.fitButton.disabled = !this.chart.isZoomed;
    this.showValues();
    const rest_ms = (performance.now() - now) * IDLE_PER_DRAW;
    this.nextDraw = now + Math.min(LONGEST_REST_MS, Math.max(DRAW_EVERY_MS, rest_ms));
  }

  private pause(on: boolean): void {
    this.paused = on;
    this.pausedAt = Math.max(...this.curves().map((curve) => curve.samples.end()));
    this.mark();
  }

  private clear(): void {
    for (const curve of this.curves()) curve.samples.clear();
    this.chart.reset();
    this.mark();
  }

  private save(): void {
    const curves = this.curves();
    if (curves.length === 0) this.host.fail(new Error('There are no curves to save.'));
    else
      download('plot.csv', asCsv(curves.map((curve) => [curve.name, curve.samples])), 'text/csv');
  }

  private nextColour(): string {
    this.coloursUsed += 1;
    return colour(`curve-${((this.coloursUsed - 1) % COLOURS) + 1}`);
  }

  private recolour(): void {
    this.coloursUsed = 0;
    for (const curve of this.curves()) curve.colour = this.nextColour();
    this.showLegend();
  }

  private showLegend(): void {
    this.legend.replaceChildren(
      ...this.entries.flatMap((entry) =>
        entry.missing
          ? [this.missingRow(entry)]
          : entry.curves.map((curve, index) => this.legendRow(entry, curve, index)),
      ),
    );
    this.mark();
  }

  private missingRow(entry: Entry): HTMLElement {
    return h(
      'div',
      { class: 'legend-row missing', role: 'listitem' },
      h('span', { class: 'ellipsis', title: entry.text }, entry.text),
      h('span', { class: 'dim' }, 'no values yet'),
      button('', () => this.remove(entry), {
        icon: 'close',
        title: `Remove ${entry.text}`,
        class: 'ghost',
      }),
    );
  }

  private legendRow(entry: Entry, curve: Curve, index: number): HTMLElement {
    const swatch = h('button', {
      type: 'button',
      class: 'swatch',
      role: 'switch',
      'aria-checked': String(curve.shown),
      title: 'Show or hide',
      'aria-label': `Show ${curve.name}`,
    });
    swatch.style.setProperty('--swatch', curve.colour);
    swatch.addEventListener('click', () => {
      curve.shown = !curve.shown;
      if (curve.shown) this.hidden.delete(curve.name);
      else this.hidden.add(curve.name);
      this.host.touched();
      this.showLegend();
    });
    const remove =
      index === 0
        ? button('', () => this.remove(entry), {
            icon: 'close',
            title: `Remove ${entry.text}`,
            class: 'ghost',
          })
        : null;
    return h(
      'div',
      { class: 'legend-row', role: 'listitem' },
      swatch,
      h('span', { class: 'ellipsis', title: curve.name }, curve.name),
      h('output', {}),
      remove,
    );
  }

  private showValues(): void {
    const outputs = this.legend.querySelectorAll('output');
    this.entries
      .filter((entry) => !entry.missing)
      .flatMap((entry) => entry.curves)
      .forEach((curve, index) => {
        const output = outputs[index];
        if (output)
          setText(output, curve.samples.length > 0 ? short(curve.samples.last(), 5) : '–');
      });
  }
}
