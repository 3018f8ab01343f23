/** MotionPlanning: RViz's panel of MoveIt. */
import { DISPLAY_ROWS } from '../generated/displays';
import type { JsonObject } from '../json';
import { BasePanel } from '../panels/base';
import { onActiveScene, scenePanels } from '../scene/active_scene';
import type { ScenePanel } from '../scene/scene_panel';
import { button, h, setText } from '../widgets/dom';
import '../styles/motion.css';
import { JointsTab } from './joints_tab';
import { ObjectsTab } from './objects_tab';
import type { Report } from './planning';
import { PlanningTab } from './planning_tab';
import { motionStore, type Change, type MotionStore } from './store';
import { Tabs } from './tabs';

/** Plans and executes, beside RViz's view. */
export class MotionPlanningPanel extends BasePanel {
  readonly title = 'MotionPlanning';
  private readonly store: MotionStore;
  private readonly planning: PlanningTab;
  private readonly joints: JointsTab;
  private readonly objects: ObjectsTab;
  private readonly tabs: Tabs;
  private readonly result = h('div', {
    class: 'motion-result',
    role: 'status',
    'aria-live': 'polite',
    'data-level': 'ok',
  });
  private readonly inverse = h('div', {
    class: 'motion-result',
    role: 'status',
    'aria-live': 'polite',
    'aria-label': 'Inverse kinematics',
    'data-level': 'warn',
    hidden: true,
  });
  private readonly collisions = h('div', {
    class: 'motion-result',
    role: 'status',
    'aria-live': 'polite',
    'aria-label': 'Collisions',
    'data-level': 'error',
    hidden: true,
  });
  private readonly view = h(
    'div',
    { class: 'motion-result', hidden: true },
    "What is planned is seen in RViz's view. ",
  );
  private leave: (() => void) | null = null;
  /** Whether RViz's view shall get the display as soon as there is one. */
  private unseen = false;

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    const { connection, host } = this;
    this.store = motionStore(connection);
    const report = (said: Report): void => this.say(said);
    this.planning = new PlanningTab(this.store, {
      connection,
      graph: host.graph,
      touched: () => host.touched(),
      report,
    });
    this.joints = new JointsTab(this.store);
    this.objects = new ObjectsTab(this.store, connection, report);
    this.tabs = new Tabs(
      'Motion planning',
      [
        { name: 'Planning', element: this.planning.element },
        { name: 'Joints', element: this.joints.element },
        {
          name: 'Scene Objects',
          element: this.objects.element,
          shown: (visible) => this.objects.shown(visible),
        },
      ],
      () => host.touched(),
    );
    this.element.classList.add('motion');
    this.result.setAttribute('aria-label', 'Result');
    this.view.append(
      button('Open RViz', () => host.show('rviz', {}, 'motion_planning'), {
        title: 'Open RViz below this panel',
      }),
    );
    this.element.append(this.tabs.element, this.view, this.inverse, this.collisions, this.result);
    this.atEnd(this.store.watch((what) => this.heard(what)));
    this.atEnd(host.graph.watch((graph) => this.store.follow(graph)));
    this.atEnd(() => this.leave?.());
    // A view that was just made has no displays of its own yet.
    this.atEnd(onActiveScene(() => this.lookSoon()));
    this.heard('robot');
  }

  override open(params: JsonObject): void {
    this.planning.open(params);
    if (typeof params.tab === 'string') this.tabs.show(params.tab);
    this.unseen = true;
    this.lookSoon();
  }

  override state(): JsonObject {
    return { ...this.planning.state(), tab: this.tabs.name };
  }

  override shown(visible: boolean): void {
    super.shown(visible);
    this.leave?.();
    this.leave = visible ? this.store.use() : null;
  }

  private lookSoon(): void {
    window.setTimeout(() => this.look(), 0);
  }

  /** What is planned is seen in RViz's view. */
  private look(): void {
    const scene = rvizView();
    this.view.hidden = scene !== null;
    if (!scene || !this.unseen) return;
    this.unseen = false;
    if (
      scene.displays.displays.some(
        (display) => display.kind.name === DISPLAY_ROWS.MotionPlanning.name,
      )
    )
      return;
    scene.displays.add('moveit_rviz_plugin/MotionPlanning');
    scene.choose('Interact');
  }

  private say({ level, text }: Report): void {
    this.result.dataset.level = level;
    setText(this.result, text);
  }

  private heard(what: Change): void {
    const { problem, ikProblem } = this.store;
    if (what === 'robot') {
      this.planning.refresh();
      this.say(
        problem
          ? { level: this.store.isWaiting ? 'warn' : 'error', text: problem }
          : { level: 'ok', text: this.store.robot ? '' : 'Looking for move_group …' },
      );
    }
    if (what === 'query' || what === 'look') this.planning.refreshQuery();
    if (what === 'query' || what === 'robot' || what === 'current') this.joints.refresh();
    if (what === 'scene' || what === 'robot') this.objects.refresh();
    if (what === 'play' || what === 'path') this.planning.refreshPath();
    note(this.inverse, ikProblem && `IK: ${ikProblem}`);
    note(this.collisions, this.collisionText());
  }

  private collisionText(): string {
    const { store } = this;
    const found = (['start', 'goal'] as const).filter(
      (query) => store.robot && store[query].shown && store[query].collisions,
    );
    return found
      .map((query) => `${query === 'goal' ? 'Goal' : 'Start'}: ${store[query].collisions}`)
      .join('; ');
  }
}

/** A line that is there only while it says something. */
function note(line: HTMLElement, text: string): void {
  line.hidden = !text;
  setText(line, text);
}

function rvizView(): ScenePanel | null {
  return scenePanels().findLast((panel) => panel.kind === 'rviz') ?? null;
}
