/** Displays: RViz's panel with the list of what is shown. */
import type { Connection } from '../connection';
import { shortType } from '../graph_store';
import type { JsonObject } from '../json';
import { BasePanel } from '../panels/base';
import type { PanelHost } from '../panel';
import { activeScene, onActiveScene } from '../scene/active_scene';
import type { ScenePanel } from '../scene/scene_panel';
import { button, h, notice, toolbar } from '../widgets/dom';
import { openMenu } from '../widgets/menu';
import { insertFile } from '../world/actions';
import { askText } from '../shell/dialog';
import { askDisplay } from './add_dialog';
import type { Display, StatusLine } from './display';
import { DisplayRow } from './display_row';
import { editor, type Known } from './property_row';
import { displayKind } from './registry';
import { ViewsBox } from './views_box';

/** The list of displays of the view that was used last (RViz's where there is one). */
export class DisplaysPanel extends BasePanel {
  readonly title = 'Displays';
  private scene: ScenePanel | null = null;
  private rows: DisplayRow[] = [];
  private chosen: Display | null = null;
  private views: ViewsBox | null = null;
  private unwatch: () => void = () => undefined;
  private readonly tree = h('div', {
    class: 'display-tree',
    role: 'tree',
    'aria-label': 'Displays',
  });
  private readonly globals = h('div', { class: 'display-body' });
  private readonly viewsPlace = h('details', { class: 'views' }, h('summary', {}, 'Views'));

  constructor(connection: Connection, host: PanelHost) {
    super(connection, host);
    const file = h('input', { type: 'file', accept: '.rviz', hidden: true });
    file.addEventListener('change', () => {
      if (file.files?.[0] && this.scene) void insertFile(this.scene, file.files[0]);
      file.value = '';
    });
    const more = button(
      'More',
      () =>
        openMenu(
          more,
          [
            { text: 'Duplicate', run: () => this.duplicate() },
            { text: 'Rename…', run: () => void this.rename() },
            { text: 'Open a .rviz file…', run: () => file.click() },
          ],
          'More',
        ),
      { icon: 'down', title: 'Duplicate, rename, open a .rviz file' },
    );
    more.setAttribute('aria-haspopup', 'menu');
    this.element.classList.add('displays-panel');
    this.element.append(
      toolbar(
        'Displays',
        button('Add', () => void this.add(), { icon: 'plus', title: 'Add a display' }),
        button('Remove', () => this.remove()),
        more,
        file,
      ),
      h('div', { class: 'displays-scroll' }, this.globals, this.tree),
      this.viewsPlace,
    );
    this.tree.addEventListener('keydown', (event) => this.key(event));
    this.atEnd(onActiveScene(() => this.attach()));
    this.atEnd(() => this.unwatch());
    this.atEnd(() => this.views?.dispose());
  }

  override open(_params: JsonObject): void {
    this.attach();
  }

  private get known(): Known {
    return {
      topics: (types) =>
        this.host.graph.value.topics
          .filter((topic) => !types.length || types.includes(shortType(topic.type)))
          .map((topic) => topic.name),
      frames: () => [
        '<Fixed Frame>',
        ...(this.scene?.displays.stage.frames.infos ?? []).map((info) => info.name),
      ],
    };
  }

  private attach(): void {
    const scene = activeScene('rviz');
    if (scene === this.scene) return;
    this.unwatch();
    this.scene = scene;
    this.chosen = null;
    this.views?.dispose();
    this.views = scene ? new ViewsBox(scene.view, scene.displays.stage.frames) : null;
    this.viewsPlace.replaceChildren(
      h('summary', {}, 'Views'),
      this.views?.element ?? notice('No view is open.'),
    );
    if (scene) {
      this.unwatch = scene.displays.watch((what, display) => {
        if (what === 'list') this.rebuild();
        const row = this.rows.find((each) => each.display === display);
        if (what === 'status') row?.refreshStatus();
        if (what === 'properties') row?.refreshProperties();
      });
    }
    this.rebuild();
  }

  private rebuild(): void {
    const expanded = new Set(this.rows.filter((row) => row.expanded).map((row) => row.display));
    const displays = this.scene?.displays.displays ?? [];
    this.fillGlobals();
    const old = new Map(this.rows.map((row) => [row.display, row]));
    this.rows = displays.map(
      (display) =>
        old.get(display) ??
        new DisplayRow(
          display,
          {
            known: this.known,
            chosen: (each) => this.choose(each),
            touched: () => this.host.touched(),
          },
          expanded.has(display),
        ),
    );
    this.tree.replaceChildren(...this.rows.map((row) => row.element));
    if (!displays.length)
      this.tree.append(
        notice(this.scene ? 'Add shows what topics carry.' : 'Open an RViz or Gazebo view first.'),
      );
    if (!this.chosen || !displays.includes(this.chosen)) this.choose(displays[0] ?? null);
  }

  private fillGlobals(): void {
    const { scene } = this;
    if (!scene) return this.globals.replaceChildren();
    if (this.globals.contains(document.activeElement)) return;
    const frame = {
      path: 'Fixed Frame',
      kind: 'frame' as const,
      value: '',
      about: 'The frame in which everything is drawn.',
    };
    const back = {
      path: 'Background Color',
      kind: 'colour' as const,
      value: '',
      about: 'Colour of the background.',
    };
    const frames: Known = {
      topics: () => [],
      frames: () => scene.displays.stage.frames.infos.map((info) => info.name),
    };
    const rows: [string, HTMLElement][] = [
      [
        'Fixed Frame',
        editor(frame, scene.displays.fixedFrame, frames, (value) => {
          scene.displays.chosen = true;
          scene.displays.setFixedFrame(String(value));
          this.host.touched();
        }),
      ],
    ];
    if (scene.kind === 'rviz')
      rows.push([
        'Background Color',
        editor(back, scene.displays.backgroundColour, frames, (value) =>
          scene.displays.setBackground(String(value)),
        ),
      ]);
    const problem = frameProblem(scene);
    this.globals.replaceChildren(
      h(
        'div',
        { class: 'display-head' },
        h('span', { class: 'display-light', 'data-level': problem?.level ?? 'ok' }),
        h('span', { class: 'display-name' }, 'Global Options'),
      ),
      ...rows.map(([name, control]) =>
        h(
          'div',
          { class: 'property-row' },
          h('span', { class: 'property-name' }, name),
          h('span', { class: 'property-value' }, control),
        ),
      ),
    );
    if (!problem) return;
    this.globals.append(
      h(
        'div',
        { class: `display-status status-${problem.level}` },
        h('span', { class: 'status-what' }, 'Fixed Frame'),
        h('span', {}, problem.text),
      ),
    );
  }

  private choose(display: Display | null): void {
    this.chosen = display;
    this.rows.forEach((row) => row.select(row.display === display));
  }

  private key(event: KeyboardEvent): void {
    const at = this.rows.findIndex((row) => row.display === this.chosen);
    const inRow =
      event.target instanceof HTMLElement && event.target.getAttribute('role') === 'treeitem';
    if (!inRow || at < 0) return;
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step) {
      const next = this.rows[Math.max(0, Math.min(this.rows.length - 1, at + step))];
      this.choose(next.display);
      next.element.focus();
    } else if (event.key === 'ArrowRight') this.rows[at].expand(true);
    else if (event.key === 'ArrowLeft') this.rows[at].expand(false);
    else if (event.key === 'Delete') this.remove();
    else return;
    event.preventDefault();
  }

  private async add(): Promise<void> {
    if (!this.scene) return;
    const choice = await askDisplay(this.host.graph, this.connection);
    if (!choice) return;
    const display = this.scene.displays.add(
      choice.className,
      choice.topic ? { Topic: choice.topic } : this.onlyTopic(choice.className),
    );
    this.choose(display);
    this.rows.find((row) => row.display === display)?.expand(true);
    this.host.touched();
  }

  /** Where one topic has the type, it is meant. */
  private onlyTopic(className: string): JsonObject {
    const types = this.scene && className !== 'DepthCloud' ? typesOf(className) : [];
    const fitting = this.host.graph.topicsOf(types).filter((topic) => !topic.hidden);
    return fitting.length === 1 ? { Topic: fitting[0].name } : {};
  }

  private duplicate(): void {
    if (!this.scene || !this.chosen) return;
    this.scene.displays.add(this.chosen.kind.name, this.chosen.props.toObject());
    this.host.touched();
  }

  private remove(): void {
    if (!this.scene || !this.chosen) return;
    this.scene.displays.remove(this.chosen);
    this.host.touched();
  }

  private async rename(): Promise<void> {
    if (!this.chosen) return;
    const display = this.chosen;
    const name = await askText('Rename the display', 'Name', display.name);
    if (!name) return;
    display.name = name;
    this.rows = this.rows.filter((row) => row.display !== display);
    this.rebuild();
    this.host.touched();
  }
}

function typesOf(className: string): readonly string[] {
  return displayKind(className)?.types ?? [];
}

const MOST_NAMES = 4;

/** What keeps the fixed frame from being one, and how sure that is. */
function frameProblem(scene: ScenePanel): StatusLine | null {
  const { displays } = scene;
  const { infos, settled } = displays.stage.frames;
  const { fixedFrame } = displays;
  // Gazebo's view stands in the world, with tf or without.
  if (infos.length === 0 || (scene.kind === 'gazebo' && displays.displays.length === 0))
    return null;
  if (infos.some((info) => info.name === fixedFrame || info.parent === fixedFrame)) return null;
  if (!settled) return { level: 'warn', text: `Waiting for the frame ${fixedFrame}` };
  const names = infos.map((info) => info.name);
  const more = names.length > MOST_NAMES ? ` and ${names.length - MOST_NAMES} more` : '';
  return {
    level: 'error',
    text: `Unknown frame ${fixedFrame}. tf has ${names.slice(0, MOST_NAMES).join(', ')}${more}: choose one of them above, or start who broadcasts ${fixedFrame}.`,
  };
}
