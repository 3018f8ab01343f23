/** Insert: shapes, the models of the model paths with pictures, and files. */
import type { Connection } from '../connection';
import { serverPath } from '../server_path';
import type { ModelEntry } from '../generated/messages';
import type { JsonObject } from '../json';
import { BasePanel } from '../panels/base';
import type { PanelHost } from '../panel';
import { activeScene } from '../scene/active_scene';
import { sceneIcon } from '../scene/icons';
import type { ScenePanel } from '../scene/scene_panel';
import { button, h, notice, toolbar } from '../widgets/dom';
import { insert, insertFile, insertPrimitive } from './actions';

/** Gazebo's Insert tab. */
export class InsertPanel extends BasePanel {
  readonly title = 'Insert';
  private models: ModelEntry[] = [];
  private readonly search = h('input', {
    type: 'search',
    placeholder: 'Search models',
    'aria-label': 'Search models',
  });
  private readonly list = h('div', { class: 'model-list', role: 'list', 'aria-label': 'Models' });

  constructor(connection: Connection, host: PanelHost) {
    super(connection, host);
    const file = h('input', { type: 'file', accept: '.urdf,.sdf,.world,.xml', hidden: true });
    file.addEventListener('change', () => {
      const scene = this.scene();
      if (file.files?.[0] && scene) void insertFile(scene, file.files[0]);
      file.value = '';
    });
    const shapes = (['box', 'sphere', 'cylinder'] as const).map((shape) => {
      const made = button(
        shape,
        () => {
          const scene = this.scene();
          if (scene) void insertPrimitive(scene, shape);
        },
        { title: `Insert a ${shape}` },
      );
      made.prepend(sceneIcon(shape));
      return made;
    });
    this.search.addEventListener('input', () => this.draw());
    this.element.classList.add('insert-panel');
    this.element.append(
      toolbar(
        'Insert',
        ...shapes,
        button('File…', () => file.click(), {
          title: 'Insert a URDF or SDF file; files can be dropped on the view too',
        }),
        file,
      ),
      h(
        'div',
        { class: 'toolbar' },
        this.search,
        button('', () => void this.load(), { icon: 'refresh', title: 'Look for models again' }),
      ),
      this.list,
    );
    void this.load();
  }

  private scene(): ScenePanel | null {
    const found = activeScene('gazebo');
    if (!found) this.host.fail(new Error('Open a Gazebo view first.'));
    return found;
  }

  private async load(): Promise<void> {
    this.list.replaceChildren(notice('Looking for models…'));
    const found = await this.connection.call('world.models').catch((problem: unknown) => {
      this.host.fail(problem, 'Insert');
      return [];
    });
    this.models = found as unknown as ModelEntry[];
    this.draw();
  }

  private draw(): void {
    const words = this.search.value.trim().toLowerCase();
    const fitting = this.models.filter((model) =>
      `${model.name} ${model.title} ${model.description}`.toLowerCase().includes(words),
    );
    this.list.replaceChildren(...fitting.map((model) => this.card(model)));
    if (!fitting.length)
      this.list.append(
        notice(
          words
            ? 'No model has these words.'
            : 'No models found: GAZEBO_MODEL_PATH names where they are.',
        ),
      );
  }

  private card(model: ModelEntry): HTMLElement {
    const source: JsonObject = { model: model.name };
    const picture = h('img', {
      class: 'model-picture',
      alt: '',
      loading: 'lazy',
      src: serverPath(model.thumbnail),
      draggable: 'false',
    });
    picture.addEventListener('error', () => picture.classList.add('missing'));
    const card = h(
      'button',
      {
        type: 'button',
        class: 'model-card',
        draggable: 'true',
        title: [model.description, model.path].filter(Boolean).join('\n'),
      },
      picture,
      h('span', { class: 'only-read' }, 'Insert '),
      h('span', { class: 'model-name' }, model.title),
      ' ',
      h('span', { class: 'model-path' }, model.name),
    );
    card.addEventListener('click', () => {
      const scene = this.scene();
      if (scene) void insert(scene, source, model.name);
    });
    card.addEventListener('dragstart', (event) => {
      event.dataTransfer?.setData(
        'application/x-gazelle-source',
        JSON.stringify({ source, name: model.name, height: 0 }),
      );
    });
    return h('div', { role: 'listitem' }, card);
  }
}
