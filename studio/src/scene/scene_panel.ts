/** The panel with a 3D view: Gazebo's (the world) or RViz's (the displays). */
import type * as THREE from 'three';
import type { Connection } from '../connection';
import { DisplayList } from '../displays/display_list';
import { learnAdded } from '../displays/registry';
import { CallError, inOneLine } from '../errors';
import { isObject, type JsonObject } from '../json';
import { Assembly } from '../model/assembly';
import { Contacts } from '../model/contacts';
import type { Mode, ModeFlags } from '../model/view_modes';
import type { Panel, PanelHost } from '../panel';
import { toolsFor } from '../tools/toolbox';
import type { Bench, Tool } from '../tools/tool';
import { h, setText } from '../widgets/dom';
import { acceptFiles, entityMenu, openRviz, worldKey } from '../world/actions';
import { worldStore, type WorldStore } from '../world/store';
import { dropScene, useScene } from './active_scene';
import { Film } from './capture';
import { stateAt, type ViewState } from './cameras';
import { Frames } from './frames';
import { FirstLook } from './first_look';
import { gridLines } from './grid';
import { Highlight } from './highlight';
import { surroundings } from './lighting';
import { pick } from './picking';
import { Pointer } from './pointer';
import { SceneToolbar } from './scene_toolbar';
import { publishHandle } from './test_handle';
import { View } from './view';

export type SceneKind = 'gazebo' | 'rviz';

/** One 3D panel. */
export class ScenePanel implements Panel, Bench {
  readonly id: string;
  readonly title: string;
  readonly element: HTMLElement;
  readonly view: View;
  readonly assembly: Assembly;
  readonly displays: DisplayList;
  readonly world: WorldStore;
  readonly graph;
  readonly film: Film;
  readonly contacts: Contacts;
  readonly highlight: Highlight;
  readonly tools: readonly Tool[];
  tool: Tool;
  private previous: Tool;
  private readonly toolbar: SceneToolbar;
  private readonly grid: THREE.Object3D;
  private readonly line = h('div', { class: 'scene-line', role: 'status', 'aria-live': 'polite' });
  private readonly stops: (() => void)[] = [];
  private readonly firstLook: FirstLook;

  constructor(
    readonly kind: SceneKind,
    readonly connection: Connection,
    readonly host: PanelHost,
  ) {
    this.id = host.id;
    this.title = kind === 'gazebo' ? 'Gazebo' : 'RViz';
    this.graph = host.graph;
    const stage = h('div', { class: 'scene-stage' });
    this.element = h('div', { class: 'scene-panel', 'data-kind': kind });
    this.element.append(stage);
    this.view = new View(stage);
    this.view.canvas.setAttribute(
      'aria-label',
      `${this.title}: 3D view. Arrow keys turn, plus and minus zoom.`,
    );
    this.world = worldStore(connection);
    this.assembly = new Assembly((moved) => (moved ? this.view.moved() : this.view.invalidate()));
    this.view.scene.add(this.assembly.root);
    const frames = new Frames(connection);
    this.displays = new DisplayList({ view: this.view, connection, frames, graph: host.graph });
    this.film = new Film(this.view);
    this.contacts = new Contacts(this.view, connection);
    this.highlight = new Highlight(this.view, this.assembly, this.world);
    this.firstLook = new FirstLook(this.view, this.assembly);
    this.grid = gridLines({
      cells: 20,
      size_m: 1,
      colour: [0.45, 0.46, 0.48],
      alpha: 0.55,
      plane: 'XY',
      axes: true,
    });
    // Above the ground, which lies at zero too.
    this.grid.position.z = 0.003;
    this.view.scene.add(this.grid);
    this.tools = toolsFor(kind, this);
    this.tool = this.previous = this.tools[0];
    this.toolbar = new SceneToolbar(this);
    this.element.prepend(this.toolbar.element);
    this.say('');
    stage.append(this.line);
    this.listen();
    useScene(this);
    publishHandle();
  }

  open(params: JsonObject): void {
    if (isObject(params.view)) {
      this.view.rig.set(params.view as unknown as Partial<ViewState>);
      this.firstLook.end();
    }
    if (isObject(params.modes)) {
      for (const [mode, on] of Object.entries(params.modes as ModeFlags))
        this.assembly.setMode(mode as Mode, Boolean(on));
    }
    if (isObject(params.displays)) this.loadDisplays(params.displays as JsonObject);
    else if (!this.displays.displays.length) this.beginDisplays();
    if (typeof params.file === 'string') void openRviz(this, { path: params.file });
    if (typeof params.frame === 'string') {
      this.displays.chosen = true;
      this.displays.setFixedFrame(params.frame);
    }
    this.toolbar.refresh();
  }

  state(): JsonObject {
    return {
      view: this.view.rig.state as unknown as JsonObject,
      modes: this.assembly.modes.value() as JsonObject,
      displays: this.displays.save(),
    };
  }

  /** Take displays of a layout or of a `.rviz` file. */
  loadDisplays(value: JsonObject): void {
    // A layout may hold a frame that nobody chose, of another robot.
    this.displays.chosen = Boolean(value.fixed_frame) && value.frame_chosen !== false;
    if (this.displays.load(value)) void this.addWaiting();
  }

  /** What Gazelle does not have a pip package may have. */
  private async addWaiting(): Promise<void> {
    const problems = await learnAdded(this.connection).catch((problem: unknown) => [
      inOneLine(problem),
    ]);
    const unknown = this.displays.addWaiting();
    if (!unknown.length) return;
    this.host.fail(
      new CallError(
        `These display classes are not known and were left out: ${unknown.join(', ')}`,
        problems.join(' '),
      ),
    );
  }

  shown(visible: boolean): void {
    this.view.show(visible);
    this.displays.hold(!visible);
    this.contacts.hold(!visible);
    if (visible) useScene(this);
  }

  dispose(): void {
    this.stops.forEach((stop) => stop());
    this.firstLook.end();
    this.tool.end?.();
    this.contacts.set(false);
    this.highlight.dispose();
    this.displays.dispose();
    this.view.dispose();
    dropScene(this);
  }

  /** Choose a tool by its name. */
  choose(name: string): void {
    const next = this.tools.find((tool) => tool.name === name);
    if (!next || next === this.tool) return;
    this.tool.end?.();
    this.previous = this.tool;
    this.tool = next;
    this.say('');
    this.view.canvas.style.cursor = next.cursor ?? '';
    next.begin?.();
    this.toolbar.refresh();
  }

  /** The line at the bottom of the view. */
  say(text: string): void {
    setText(this.line, text);
    this.line.hidden = text === '';
  }

  fail = (problem: unknown): void => this.host.fail(problem, this.title);

  done(): void {
    this.choose(this.previous.name);
  }

  setMode(mode: Mode, on: boolean, model?: string): void {
    this.assembly.setMode(mode, on, model);
    this.host.touched();
  }

  setGrid(on: boolean): void {
    this.grid.visible = on;
    this.view.invalidate();
  }

  get gridShown(): boolean {
    return this.grid.visible;
  }

  private listen(): void {
    new Pointer(this.view, this.kind, {
      tool: () => this.tool,
      menu: (event) => this.menu(event),
      key: (event) => this.key(event),
    });
    this.element.addEventListener('pointerdown', () => useScene(this), true);
    acceptFiles(this.element, this);
    this.stops.push(this.graph.watch(() => undefined));
    if (this.kind === 'rviz') {
      this.grid.visible = false;
      this.stops.push(this.displays.watch(() => this.firstLook.atRobots(this.displays.displays)));
      return;
    }
    this.stops.push(this.world.onScene(() => this.takeScene()));
    this.stops.push(this.world.onPoses(() => this.assembly.setPoses(this.world.poses)));
  }

  private takeScene(): void {
    const { scene } = this.world;
    this.assembly.set(scene);
    this.highlight.draw();
    this.element.classList.toggle('scene-empty', scene === null);
    if (!scene) return;
    this.view.lighting.set(surroundings(scene));
    if (scene.view && this.firstLook.take(stateAt(scene.view))) this.grid.visible = scene.grid;
    this.firstLook.atWorld(scene);
    this.view.moved();
  }

  private beginDisplays(): void {
    if (this.kind === 'gazebo') {
      this.displays.stage.frames.setFixed('world');
      return;
    }
    this.displays.stage.frames.setFixed('map');
    this.displays.setBackground('48; 48; 48');
    this.displays.add('rviz/Grid');
    this.displays.add('rviz/RobotModel');
    this.displays.add('rviz/TF')?.setEnabled(false);
  }

  private menu(event: PointerEvent): void {
    const entity = pick(this.view, event.clientX, event.clientY)?.entity;
    if (entity && this.assembly.model(entity.model))
      entityMenu(this, entity, event.clientX, event.clientY);
  }

  private key(event: KeyboardEvent): boolean {
    if (event.altKey || event.metaKey) return false;
    const tool = this.tools.find((each) => each.key === event.key.toLowerCase());
    if (event.key === 'Escape') {
      this.choose(this.tools[0].name);
      return true;
    }
    if (tool) this.choose(tool.name);
    return Boolean(tool) || worldKey(this, event);
  }
}
