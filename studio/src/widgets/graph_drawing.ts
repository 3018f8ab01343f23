/** Boxes and arrows: laid out by dagre, drawn as SVG, saved as SVG or DOT. */

import { graphlib, layout } from '@dagrejs/dagre';
import { s } from './dom';
import { PanZoom } from './pan_zoom';

export interface DrawnNode {
  id: string;
  label: string;
  shape: 'node' | 'topic';
  title?: string;
}
export interface DrawnEdge {
  from: string;
  to: string;
  label?: string;
  title?: string;
}
export interface Drawing {
  nodes: DrawnNode[];
  edges: DrawnEdge[];
}

interface Point {
  x: number;
  y: number;
}
interface Placed {
  x: number;
  y: number;
  width: number;
  height: number;
}
interface Routed extends Placed {
  points: Point[];
}

const FONT = '12px system-ui, sans-serif';
const LINE = 14;
const HEIGHT = 28;
/** What a line of a node to itself needs, above and below. */
const LOOP = 68;
const STYLE = [
  'node',
  'node-line',
  'topic',
  'topic-line',
  'text',
  'dim',
  'panel',
  'line-strong',
  'accent',
] as const;

/** A drawing of a graph in which a box can be chosen: it and its neighbours stand out. */
export class GraphDrawing {
  readonly view: PanZoom;
  private drawing: Drawing = { nodes: [], edges: [] };
  private key = '';
  private chosen: string | null = null;
  private readonly labels = new Map<string, SVGElement>();

  constructor(
    label: string,
    private readonly direction: 'LR' | 'TB',
    private readonly pick: (id: string | null) => void = () => undefined,
  ) {
    this.view = new PanZoom(label);
    this.view.svg.addEventListener('click', (event) => this.choose(idOf(event.target)));
    this.view.svg.addEventListener('keydown', (event) => {
      if (event.key === 'Enter') this.choose(idOf(event.target));
    });
  }

  /** Draws a graph; labels of edges that alone have changed are written in place. */
  show(drawing: Drawing): void {
    const key = JSON.stringify([
      drawing.nodes.map((node) => [node.id, node.label]),
      drawing.edges.map((edge) => [edge.from, edge.to, lines(edge.label).length]),
    ]);
    this.drawing = drawing;
    if (key === this.key) {
      for (const edge of drawing.edges) this.relabel(edge);
      return;
    }
    this.key = key;
    this.draw();
  }

  /** The drawing as an SVG file with its colours. */
  svgText(): string {
    const copy = this.view.svg.cloneNode(true) as SVGSVGElement;
    const box = this.view.group.getBBox();
    const style = getComputedStyle(document.documentElement);
    const root = STYLE.map((name) => `--${name}: ${style.getPropertyValue(`--${name}`)};`).join(
      ' ',
    );
    const rules = [...document.styleSheets]
      .flatMap((sheet) => [...sheet.cssRules])
      .map((rule) => rule.cssText)
      .filter((text) => text.startsWith('.drawing'));
    copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
    copy.setAttribute(
      'viewBox',
      `${box.x - 10} ${box.y - 10} ${box.width + 20} ${box.height + 20}`,
    );
    copy.setAttribute('width', String(box.width + 20));
    copy.setAttribute('height', String(box.height + 20));
    copy.querySelector('g')?.removeAttribute('transform');
    copy.prepend(
      s('style', {}, `svg { ${root} background: var(--panel); font: ${FONT}; } ${rules.join(' ')}`),
    );
    return new XMLSerializer().serializeToString(copy);
  }

  /** The graph in Graphviz's language. */
  dotText(): string {
    const nodes = this.drawing.nodes.map(
      (node) =>
        `  ${quoted(node.id)} [label=${quoted(node.label)}, shape=${node.shape === 'node' ? 'ellipse' : 'box'}];`,
    );
    const edges = this.drawing.edges.map(
      (edge) =>
        `  ${quoted(edge.from)} -> ${quoted(edge.to)}${edge.label ? ` [label=${quoted(edge.label)}]` : ''};`,
    );
    return ['digraph graph_ {', `  rankdir=${this.direction};`, ...nodes, ...edges, '}', ''].join(
      '\n',
    );
  }

  private draw(): void {
    const graph = laidOut(this.drawing, this.direction);
    this.labels.clear();
    const at = (id: string) => graph.node(id) as unknown as Placed;
    const edges = this.drawing.edges.map((edge) =>
      this.edge(
        edge,
        edge.from === edge.to
          ? loop(at(edge.from))
          : (graph.edge(edge.from, edge.to) as unknown as Routed),
      ),
    );
    const nodes = this.drawing.nodes.map((node) => box(node, at(node.id)));
    this.view.group.replaceChildren(arrowhead(), ...edges, ...nodes);
    // Labels lie above all lines, which would cross them out otherwise.
    for (const label of [...this.view.group.querySelectorAll('.edge-label')])
      this.view.group.append(label);
    const size = graph.graph() as { width?: number; height?: number };
    this.view.setSize(Math.max(0, size.width ?? 0), Math.max(0, size.height ?? 0));
    this.highlight();
  }

  private edge(edge: DrawnEdge, routed: Routed): SVGElement {
    const group = s(
      'g',
      { class: 'edge', 'data-from': edge.from, 'data-to': edge.to },
      s('path', { d: curve(routed.points), 'marker-end': 'url(#arrowhead)' }),
    );
    if (edge.title) group.append(s('title', {}, edge.title));
    if (edge.label) {
      const texts = lines(edge.label);
      const text = textLines(texts, routed.x, routed.y, '');
      this.labels.set(`${edge.from}\n${edge.to}`, text);
      group.append(
        s(
          'g',
          { class: 'edge-label', 'data-from': edge.from, 'data-to': edge.to },
          backing(texts, routed),
          text,
        ),
      );
    }
    return group;
  }

  private relabel(edge: DrawnEdge): void {
    const spans = this.labels.get(`${edge.from}\n${edge.to}`)?.children ?? [];
    lines(edge.label).forEach((line, index) => {
      const span = spans[index];
      if (span && span.textContent !== line) span.textContent = line;
    });
  }

  private choose(id: string | null): void {
    this.chosen = id === this.chosen ? null : id;
    this.highlight();
    this.pick(this.chosen);
  }

  private highlight(): void {
    const near = new Set<string>();
    for (const edge of this.drawing.edges) {
      if (edge.from === this.chosen || edge.to === this.chosen) near.add(edge.from).add(edge.to);
    }
    if (this.chosen) near.add(this.chosen);
    for (const element of this.view.group.querySelectorAll<SVGElement>(
      '.edge, .edge-label, .box',
    )) {
      const { id, from, to } = element.dataset;
      const on = id ? near.has(id) : from === this.chosen || to === this.chosen;
      element.classList.toggle('faded', this.chosen !== null && !on);
      element.classList.toggle('chosen', this.chosen !== null && (id ? id === this.chosen : on));
    }
  }
}

function idOf(target: EventTarget | null): string | null {
  return target instanceof Element
    ? (target.closest<SVGElement>('.box')?.dataset.id ?? null)
    : null;
}

function laidOut(drawing: Drawing, direction: string) {
  const graph = new graphlib.Graph({ directed: true });
  graph.setGraph({
    rankdir: direction,
    nodesep: 18,
    ranksep: direction === 'LR' ? 46 : 34,
    marginx: 4,
    marginy: 4,
  });
  const looped = new Set(
    drawing.edges.filter((edge) => edge.from === edge.to).map((edge) => edge.from),
  );
  for (const node of drawing.nodes)
    graph.setNode(node.id, {
      width: textWidth(node.label) + 26,
      height: HEIGHT + (looped.has(node.id) ? LOOP : 0),
    });
  for (const edge of drawing.edges.filter((each) => each.from !== each.to)) {
    const label = lines(edge.label);
    const width = Math.max(0, ...label.map(textWidth));
    graph.setEdge(edge.from, edge.to, {
      width: width + (label.length > 0 ? 8 : 0),
      height: label.length * LINE,
      labelpos: 'c',
    });
  }
  layout(graph);
  return graph;
}

/** The line of a node that hears itself: above its box. */
function loop(at: Placed): Routed {
  const top = at.y - HEIGHT / 2;
  const points = [
    { x: at.x - 18, y: top },
    { x: at.x - 30, y: top - 26 },
    { x: at.x + 30, y: top - 26 },
    { x: at.x + 18, y: top },
  ];
  return { x: at.x, y: top - 24, width: 0, height: 0, points };
}

/** What keeps lines from running through a label. */
function backing(texts: string[], at: Point): SVGElement {
  const width = Math.max(...texts.map(textWidth)) * 0.93 + 6;
  const height = texts.length * LINE;
  return s('rect', { x: at.x - width / 2, y: at.y - height / 2, width, height, rx: 3 });
}

function box(node: DrawnNode, at: Placed): SVGElement {
  const group = s(
    'g',
    {
      class: `box ${node.shape}`,
      'data-id': node.id,
      tabindex: 0,
      role: 'button',
      'aria-label': node.title ?? node.label,
    },
    s('rect', {
      x: at.x - at.width / 2,
      y: at.y - HEIGHT / 2,
      width: at.width,
      height: HEIGHT,
      rx: node.shape === 'node' ? 14 : 3,
    }),
    textLines([node.label], at.x, at.y, 'box-label'),
  );
  if (node.title) group.append(s('title', {}, node.title));
  return group;
}

function textLines(texts: string[], x: number, y: number, name: string): SVGElement {
  const top = y - ((texts.length - 1) * LINE) / 2 + 4;
  return s(
    'text',
    { class: name || undefined, 'text-anchor': 'middle' },
    ...texts.map((text, index) => s('tspan', { x, y: top + index * LINE }, text)),
  );
}

function arrowhead(): SVGElement {
  return s(
    'defs',
    {},
    s(
      'marker',
      {
        id: 'arrowhead',
        viewBox: '0 0 8 8',
        refX: 7,
        refY: 4,
        markerWidth: 7,
        markerHeight: 7,
        orient: 'auto',
      },
      s('path', { d: 'M0 0.8L7.5 4 0 7.2z', class: 'head' }),
    ),
  );
}

function curve(points: readonly Point[]): string {
  const [first, ...rest] = points;
  let path = `M${first.x} ${first.y}`;
  for (let index = 0; index < rest.length - 1; index += 1) {
    const here = rest[index];
    const next = rest[index + 1];
    const end =
      index === rest.length - 2 ? next : { x: (here.x + next.x) / 2, y: (here.y + next.y) / 2 };
    path += ` Q${here.x} ${here.y} ${end.x} ${end.y}`;
  }
  return rest.length === 1 ? `${path} L${rest[0].x} ${rest[0].y}` : path;
}

let measure: CanvasRenderingContext2D | null = null;

function textWidth(text: string): number {
  measure ??= document.createElement('canvas').getContext('2d');
  if (!measure) return text.length * 7;
  measure.font = FONT;
  return measure.measureText(text).width;
}

function lines(text: string | undefined): string[] {
  return text ? text.split('\n') : [];
}

function quoted(text: string): string {
  return `"${text.replaceAll('\\', '\\\\').replaceAll('"', '\\"').replaceAll('\n', '\\n')}"`;
}
