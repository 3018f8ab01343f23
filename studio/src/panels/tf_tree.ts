/** TF Tree: frames, who broadcasts them, how often and how old they are. */

import type { FrameRow } from '../generated/messages';
import type { Json } from '../json';
import { button, h, notice, setText, spacer, toolbar } from '../widgets/dom';
import { download } from '../widgets/download';
import { rate } from '../widgets/format';
import { GraphDrawing, type Drawing } from '../widgets/graph_drawing';
import { BasePanel } from './base';

const OLD_S = 1;

/** rqt_tf_tree. */
export class TfTree extends BasePanel {
  readonly title = 'TF Tree';
  private readonly drawing = new GraphDrawing('TF tree', 'TB');
  private readonly summary = h('span', { class: 'dim' });
  private readonly empty = notice('Nobody publishes on /tf or /tf_static yet.');

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.element.classList.add('graph');
    this.element.append(
      toolbar(
        'TF Tree',
        this.summary,
        spacer(),
        button('', () => this.drawing.view.zoom(1.25), { icon: 'plus', title: 'Zoom in' }),
        button('', () => this.drawing.view.zoom(0.8), { icon: 'minus', title: 'Zoom out' }),
        button('', () => this.drawing.view.fit(), { icon: 'fit', title: 'Fit in view' }),
        button('SVG', () => download('frames.svg', this.drawing.svgText(), 'image/svg+xml'), {
          icon: 'save',
          title: 'Save as SVG',
        }),
        button('DOT', () => download('frames.gv', this.drawing.dotText(), 'text/vnd.graphviz'), {
          icon: 'save',
          title: 'Save as DOT',
        }),
      ),
      h('div', { class: 'drawing-area' }, this.drawing.view.element, this.empty),
    );
    this.stream('tf.tree', {}, { onData: (value) => this.take(value) });
  }

  private take(value: Json): void {
    if (!Array.isArray(value)) return;
    const rows = value as unknown as FrameRow[];
    this.empty.hidden = rows.length > 0;
    const parents = new Set(rows.map((row) => row.parent));
    const roots = [...parents].filter((name) => !rows.some((row) => row.frame === name));
    setText(this.summary, summary(rows, roots));
    this.drawing.show(drawing(rows, roots));
  }
}

function summary(rows: FrameRow[], roots: string[]): string {
  const trees =
    roots.length > 1 ? `; ${roots.length} trees that nothing connects: ${roots.join(', ')}` : '';
  return rows.length > 0 ? `${rows.length + roots.length} frames${trees}` : '';
}

function drawing(rows: FrameRow[], roots: string[]): Drawing {
  return {
    nodes: [...roots, ...rows.map((row) => row.frame)].map((name) => ({
      id: name,
      label: name,
      shape: 'node' as const,
    })),
    edges: rows.map((row) => ({
      from: row.parent,
      to: row.frame,
      label: `${row.broadcaster || '?'}\n${motion(row)}`,
    })),
  };
}

function motion(row: FrameRow): string {
  if (row.static) return 'static';
  const age =
    row.age_s === null
      ? ''
      : row.age_s > OLD_S
        ? ` · ${row.age_s.toFixed(1)} s old!`
        : ` · ${row.age_s.toFixed(2)} s old`;
  return `${rate(row.rate_hz) || '?'} Hz${age}`;
}
