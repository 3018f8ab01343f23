/** World: the tree of models, links, joints and lights, with a search. */
import type { Connection } from '../connection';
import { BasePanel } from '../panels/base';
import type { PanelHost } from '../panel';
import type { ModelValue, PageScene } from '../generated/messages';
import { activeScene } from '../scene/active_scene';
import { button, h, notice, toolbar } from '../widgets/dom';
import { entityMenu, follow, moveTo, remove } from './actions';
import { worldStore, type Selection, type WorldStore } from './store';

interface Row {
  element: HTMLElement;
  selection: Selection;
}

/** Gazebo's World tab. */
export class EntitiesPanel extends BasePanel {
  readonly title = 'World';
  private readonly world: WorldStore;
  private readonly search = h('input', {
    type: 'search',
    placeholder: 'Search',
    'aria-label': 'Search entities',
  });
  private readonly tree = h('div', {
    class: 'entity-tree',
    role: 'tree',
    'aria-label': 'Entities',
  });
  private readonly unfolded = new Set<string>();
  private rows: Row[] = [];
  private drawn = '';

  constructor(connection: Connection, host: PanelHost) {
    super(connection, host);
    this.world = worldStore(connection);
    this.search.addEventListener('input', () => this.draw());
    this.element.append(
      toolbar(
        'World',
        this.search,
        button('Move To', () => this.act((scene, name) => moveTo(scene, name)), {
          title: 'Look at the selected model',
        }),
        button('Follow', () => this.act((scene, name) => follow(scene, name)), {
          title: 'Follow the selected model',
        }),
        button('', () => this.act((scene, name) => void remove(scene, name)), {
          icon: 'trash',
          title: 'Delete the selected model',
        }),
      ),
      this.tree,
    );
    this.element.classList.add('entities-panel');
    this.tree.addEventListener('keydown', (event) => this.key(event));
    this.atEnd(this.world.onScene(() => this.draw()));
    this.atEnd(this.world.onSelection(() => this.mark()));
  }

  private act(
    run: (scene: NonNullable<ReturnType<typeof activeScene>>, model: string) => void,
  ): void {
    const scene = activeScene('gazebo');
    const model = this.world.selection?.model;
    if (!scene || !model) return this.host.fail(new Error('Select a model first.'));
    run(scene, model);
  }

  private draw(): void {
    const { scene } = this.world;
    const words = this.search.value.trim().toLowerCase();
    const key = JSON.stringify([
      scene?.models.map((model) => [model.name, model.bodies.length, model.joints.length]),
      scene?.lights.map((light) => light.name),
      words,
      [...this.unfolded],
    ]);
    if (key === this.drawn) return;
    this.drawn = key;
    this.rows = [];
    if (!scene) {
      this.tree.replaceChildren(notice('No world is running. Start one with roslaunch or gazebo.'));
      return;
    }
    const models = scene.models.flatMap((model) => this.model(scene, model, words));
    const lights = scene.lights
      .filter((light) => light.name.toLowerCase().includes(words))
      .map((light) => this.row(light.name, 'light', 2, { model: '', light: light.name }));
    this.tree.replaceChildren(heading('Models'), ...models, heading('Lights'), ...lights);
    this.mark();
  }

  private model(scene: PageScene, model: ModelValue, words: string): HTMLElement[] {
    const links = model.bodies.map((index) => scene.bodies[index].link);
    const joints = model.joints.map((index) => scene.joints[index]);
    const hits = (name: string): boolean => name.toLowerCase().includes(words);
    const inside = words && (links.some(hits) || joints.some((joint) => hits(joint.name)));
    if (words && !hits(model.name) && !inside) return [];
    const isOpen = this.unfolded.has(model.name) || Boolean(inside);
    const head = this.row(
      model.name,
      model.static ? 'static' : 'model',
      2,
      { model: model.name },
      isOpen,
    );
    if (!isOpen) return [head];
    return [
      head,
      ...links
        .filter((link) => !words || hits(model.name) || hits(link))
        .map((link) => this.row(link, 'link', 3, { model: model.name, link })),
      ...joints
        .filter((joint) => !words || hits(model.name) || hits(joint.name))
        .map((joint) => this.row(joint.name, joint.type, 3, { model: model.name })),
    ];
  }

  private row(
    name: string,
    note: string,
    level: number,
    selection: Selection,
    expanded?: boolean,
  ): HTMLElement {
    const isModel = expanded !== undefined;
    const element = h(
      'div',
      {
        class: 'entity',
        role: 'treeitem',
        tabindex: -1,
        'aria-level': level,
        'aria-expanded': isModel ? String(expanded) : undefined,
        'data-name': name,
        'data-kind': note,
      },
      h(
        'span',
        { class: 'entity-twist', 'aria-hidden': 'true' },
        isModel ? (expanded ? '▾' : '▸') : '',
      ),
      h('span', { class: 'entity-name' }, name),
      ' ',
      h('span', { class: 'entity-note' }, note),
    );
    element.style.paddingLeft = `${(level - 2) * 16 + 6}px`;
    element.addEventListener('click', (event) => {
      const onTwist = (event.target as HTMLElement).classList.contains('entity-twist');
      if (isModel && onTwist) this.toggle(name);
      else this.world.select(selection);
    });
    element.addEventListener('dblclick', () => {
      const scene = activeScene('gazebo');
      if (scene && selection.model) moveTo(scene, selection.model, selection.link);
    });
    element.addEventListener('contextmenu', (event) => {
      event.preventDefault();
      const scene = activeScene('gazebo');
      const entity = scene?.assembly.nodes(selection.model, selection.link)[0]?.entity;
      if (scene && entity) entityMenu(scene, entity, event.clientX, event.clientY);
    });
    this.rows.push({ element, selection });
    return element;
  }

  private toggle(model: string, on = !this.unfolded.has(model)): void {
    if (on) this.unfolded.add(model);
    else this.unfolded.delete(model);
    this.draw();
  }

  private mark(): void {
    const wanted = JSON.stringify(this.world.selection);
    let found = false;
    for (const row of this.rows) {
      const on: boolean = !found && JSON.stringify(row.selection) === wanted;
      found ||= on;
      row.element.setAttribute('aria-selected', String(on));
      row.element.tabIndex = on ? 0 : -1;
      if (on) row.element.scrollIntoView({ block: 'nearest' });
    }
    if (!found && this.rows[0]) this.rows[0].element.tabIndex = 0;
  }

  private key(event: KeyboardEvent): void {
    const at = this.rows.findIndex((row) => row.element === event.target);
    if (at < 0) return;
    const { selection } = this.rows[at];
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step) this.focus(Math.max(0, Math.min(this.rows.length - 1, at + step)));
    else if (event.key === 'ArrowRight') this.unfold(at, true);
    else if (event.key === 'ArrowLeft') this.unfold(at, false);
    else if (event.key === 'Enter') this.world.select(selection);
    else if (event.key === 'Delete') this.act((scene, name) => void remove(scene, name));
    else return;
    event.preventDefault();
  }

  private unfold(at: number, on: boolean): void {
    this.toggle(this.rows[at].selection.model, on);
    this.rows[Math.min(at, this.rows.length - 1)]?.element.focus();
  }

  private focus(at: number): void {
    this.world.select(this.rows[at].selection);
    this.rows[at].element.focus();
  }
}

function heading(text: string): HTMLElement {
  return h('div', { class: 'entity-heading' }, text);
}
