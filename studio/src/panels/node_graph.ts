/** Node Graph: who publishes to whom, with rqt_graph's filters. */

import type { JsonObject } from '../json';
import {
  button,
  checkbox,
  h,
  notice,
  perFrame,
  select,
  setText,
  spacer,
  toolbar,
} from '../widgets/dom';
import { download } from '../widgets/download';
import { GraphDrawing } from '../widgets/graph_drawing';
import { BasePanel } from './base';
import { drawingOf, FIRST_CHOICE, type GraphChoice, type GraphMode } from './graph_filter';

const MODES = [
  ['nodes', 'Nodes only'],
  ['active', 'Nodes/Topics (active)'],
  ['all', 'Nodes/Topics (all)'],
] as const;
const HIDES = [
  ['deadSinks', 'Dead sinks', 'Topics that nobody subscribes to'],
  ['leafTopics', 'Leaf topics', 'Topics with one tie alone'],
  ['debug', 'Debug', 'rosout, diagnostics, clock and tools'],
  ['tf', 'tf', '/tf and /tf_static'],
  ['unreachable', 'Unreachable', 'Nodes without a tie'],
  ['images', 'Images', 'Topics of images'],
  ['params', 'Params', 'Topics of parameters'],
] as const;

/** rqt_graph. */
export class NodeGraph extends BasePanel {
  readonly title = 'Node Graph';
  private choice: GraphChoice = { ...FIRST_CHOICE };
  private readonly drawing = new GraphDrawing('Node graph', 'LR', (id) => this.describe(id));
  private readonly controls = h('div', {});
  private readonly details = h('div', { class: 'details', 'aria-live': 'polite' });
  private readonly empty = notice('No node matches.');
  private readonly redraw = perFrame(() => this.draw());

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.element.classList.add('graph');
    this.element.append(
      this.controls,
      h('div', { class: 'drawing-area' }, this.drawing.view.element, this.empty),
      this.details,
    );
    this.showControls();
    this.atEnd(this.host.graph.watch(this.redraw));
  }

  override open(params: JsonObject): void {
    const choice = params.choice;
    if (typeof choice === 'object' && choice !== null)
      this.choice = { ...FIRST_CHOICE, ...(choice as Partial<GraphChoice>) };
    this.showControls();
    this.redraw();
  }

  override state(): JsonObject {
    return { choice: { ...this.choice } };
  }

  override shown(visible: boolean): void {
    super.shown(visible);
    this.redraw();
  }

  private showControls(): void {
    const text = (name: 'nodes' | 'topics', label: string) => {
      const input = h('input', {
        type: 'text',
        value: this.choice[name],
        'aria-label': label,
        placeholder: label,
        title: 'Parts of names, comma separated; -name hides',
        class: 'name',
      });
      input.addEventListener('input', () => this.set({ [name]: input.value }));
      return input;
    };
    this.controls.replaceChildren(
      toolbar(
        'Node graph',
        select('What is shown', MODES, this.choice.mode, (mode) =>
          this.set({ mode: mode as GraphMode }),
        ),
        text('nodes', 'Nodes'),
        text('topics', 'Topics'),
        spacer(),
        button('', () => this.drawing.view.zoom(1.25), { icon: 'plus', title: 'Zoom in' }),
        button('', () => this.drawing.view.zoom(0.8), { icon: 'minus', title: 'Zoom out' }),
        button('', () => this.drawing.view.fit(), { icon: 'fit', title: 'Fit in view' }),
        button('SVG', () => download('graph.svg', this.drawing.svgText(), 'image/svg+xml'), {
          icon: 'save',
          title: 'Save as SVG',
        }),
        button('DOT', () => download('graph.dot', this.drawing.dotText(), 'text/vnd.graphviz'), {
          icon: 'save',
          title: 'Save as DOT',
        }),
      ),
      toolbar(
        'Hide',
        h('span', { class: 'dim' }, 'Hide'),
        ...HIDES.map(([name, label, title]) =>
          checkbox(label, this.choice[name], (on) => this.set({ [name]: on }), title),
        ),
      ),
    );
  }

  private set(change: Partial<GraphChoice>): void {
    this.choice = { ...this.choice, ...change };
    this.host.touched();
    this.redraw();
  }

  private draw(): void {
    if (!this.visible) return;
    const drawing = drawingOf(this.host.graph.value, this.choice);
    this.empty.hidden = drawing.nodes.length > 0;
    this.drawing.show(drawing);
  }

  private describe(id: string | null): void {
    const name = id?.slice(2) ?? '';
    const node = id?.startsWith('n:')
      ? this.host.graph.value.nodes.find((each) => each.name === name)
      : undefined;
    const topic = id?.startsWith('t:')
      ? this.host.graph.value.topics.find((each) => each.name === name)
      : undefined;
    const text = node
      ? `${name}  publishes ${node.publishes.length}, subscribes to ${node.subscribes.length}, serves ${node.serves.length}`
      : topic
        ? `${name}  ${topic.type}  ${topic.publishers.length} publishers, ${topic.subscribers.length} subscribers`
        : '';
    setText(this.details, text);
  }
}
