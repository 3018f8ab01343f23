/** The toolbar of a scene panel: tools, View menu, camera, screenshot and video. */
import { ABOUT, MODES, type Mode } from '../model/view_modes';
import { button, h, select, spacer, toggle, toolbar } from '../widgets/dom';
import { openMenu, type MenuItem } from '../widgets/menu';
import { insertPrimitive } from '../world/actions';
import { download, fileName, screenshot } from './capture';
import { VIEW_KINDS, type ViewKind, type ViewState } from './cameras';
import { sceneIcon, type SceneIcon } from './icons';
import type { ScenePanel } from './scene_panel';

const HALF_TURN = Math.PI;
/** Gazebo's View Angle: yaw and pitch of the eye. */
const ANGLES: Record<string, Partial<ViewState>> = {
  Top: { yaw: -HALF_TURN / 2, pitch: HALF_TURN / 2 - 1e-3 },
  Front: { yaw: 0, pitch: 0.02 },
  Back: { yaw: HALF_TURN, pitch: 0.02 },
  Left: { yaw: HALF_TURN / 2, pitch: 0.02 },
  Right: { yaw: -HALF_TURN / 2, pitch: 0.02 },
  Home: { yaw: -0.9, pitch: 0.5, focal: [0, 0, 0.3], distance: 8 },
};

/** Tools that have a picture of their own; the others show their names. */
const PICTURES: Record<string, SceneIcon> = {
  'Move Camera': 'camera',
  Select: 'select',
  Translate: 'translate',
  Rotate: 'rotate',
  Measure: 'measure',
  Interact: 'interact',
  'Focus Camera': 'focus',
};

/** The row of buttons above a view. */
export class SceneToolbar {
  readonly element: HTMLElement;
  private readonly buttons = new Map<string, HTMLButtonElement>();
  private readonly camera: HTMLSelectElement;
  private readonly record: HTMLButtonElement;

  constructor(private readonly panel: ScenePanel) {
    const kinds = Object.entries(VIEW_KINDS);
    this.camera = select('View type', kinds, panel.view.rig.state.kind, (kind) =>
      panel.view.rig.setKind(kind as ViewKind),
    );
    this.record = toggle('', false, () => void this.film(), { title: 'Record a video' });
    this.record.append(sceneIcon('video'));
    this.element = toolbar(
      `${panel.title} tools`,
      ...this.tools(),
      h('span', { class: 'rule' }),
      ...this.inserts(),
      spacer(),
      ...this.right(),
    );
    this.element.classList.add('scene-toolbar');
    this.refresh();
  }

  /** Show which tool and camera are in use. */
  refresh(): void {
    this.buttons.forEach((each, name) =>
      each.setAttribute('aria-pressed', String(name === this.panel.tool.name)),
    );
    this.camera.value = this.panel.view.rig.state.kind;
  }

  private tools(): HTMLElement[] {
    return this.panel.tools.map((tool) => {
      const picture = PICTURES[tool.name];
      const key = tool.key ? ` (${tool.key.toUpperCase()})` : '';
      const made = button(picture ? '' : tool.name, () => this.panel.choose(tool.name), {
        title: `${tool.name}${key}: ${tool.about}`,
        pressed: false,
      });
      made.setAttribute('aria-label', tool.name);
      if (picture) made.prepend(sceneIcon(picture));
      this.buttons.set(tool.name, made);
      return made;
    });
  }

  private inserts(): HTMLElement[] {
    if (this.panel.kind !== 'gazebo') return [];
    return (['box', 'sphere', 'cylinder'] as const).map((shape) => {
      const made = button('', () => void insertPrimitive(this.panel, shape), {
        title: `Insert a ${shape}`,
      });
      made.append(sceneIcon(shape));
      return made;
    });
  }

  private right(): HTMLElement[] {
    const view = button('View', () => openMenu(view, this.viewMenu(), 'View'), {
      icon: 'down',
      title: 'What is shown',
    });
    const angle = button('', () => openMenu(angle, this.angleMenu(), 'View Angle'), {
      title: 'View angle',
    });
    angle.append(sceneIcon('angle'));
    const picture = button('', () => void this.picture(), { title: 'Screenshot' });
    picture.append(sceneIcon('picture'));
    for (const each of [view, angle]) each.setAttribute('aria-haspopup', 'menu');
    return [view, angle, this.camera, picture, this.record];
  }

  private viewMenu(): MenuItem[] {
    const { panel } = this;
    const modes: MenuItem[] =
      panel.kind === 'gazebo'
        ? (Object.keys(MODES) as Mode[]).map((mode) => ({
            text: MODES[mode],
            title: ABOUT[mode],
            checked: panel.assembly.modes.isOn(mode),
            run: () => panel.setMode(mode, !panel.assembly.modes.isOn(mode)),
          }))
        : [];
    const contacts: MenuItem[] =
      panel.kind === 'gazebo'
        ? [
            {
              text: 'Contacts',
              checked: panel.contacts.on,
              run: () => panel.contacts.set(!panel.contacts.on),
            },
          ]
        : [];
    return [
      ...modes,
      ...contacts,
      { text: 'Grid', checked: panel.gridShown, run: () => panel.setGrid(!panel.gridShown) },
      { text: 'Stop following', run: () => panel.view.rig.follow(null) },
    ];
  }

  private angleMenu(): MenuItem[] {
    return Object.entries(ANGLES).map(([text, change]) => ({
      text,
      run: () => this.panel.view.rig.glideTo(change),
    }));
  }

  private async picture(): Promise<void> {
    try {
      download(await screenshot(this.panel.view), fileName('png'));
    } catch (problem) {
      this.panel.fail(problem);
    }
  }

  private async film(): Promise<void> {
    const { film } = this.panel;
    this.record.classList.toggle('recording', !film.running);
    try {
      if (!film.running) film.start();
      else download(await film.stop(), fileName('webm'));
    } catch (problem) {
      this.panel.fail(problem);
    }
  }
}
