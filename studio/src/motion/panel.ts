/** MotionPlanning: RViz's panel of MoveIt. */
import { isObject, type JsonObject } from '../json';
import { BasePanel } from '../panels/base';
import { activeScene } from '../scene/active';
import { h, setText } from '../widgets/dom';
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
  private readonly result = h('div', { class: 'motion-result', role: 'status', 'aria-live': 'polite', 'data-level': 'ok' });
  private readonly inverse = h('div', { class: 'motion-result motion-inverse', role: 'status', 'aria-live': 'polite', 'aria-label': 'Inverse kinematics', 'data-level': 'warn', hidden: true });
  private leave: (() => void) | null = null;

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    const { connection, host } = this;
    this.store = motionStore(connection);
    const report = (said: Report): void => this.say(said);
    this.planning = new PlanningTab(this.store, { connection, graph: host.graph, touched: () => host.touched(), report });
    this.joints = new JointsTab(this.store);
    this.objects = new ObjectsTab(this.store, connection, report);
    this.tabs = new Tabs('Motion planning', [
      { name: 'Planning', element: this.planning.element },
      { name: 'Joints', element: this.joints.element },
      { name: 'Scene Objects', element: this.objects.element, shown: (visible) => this.objects.shown(visible) },
    ], () => host.touched());
    this.element.classList.add('motion');
    this.result.setAttribute('aria-label', 'Result');
    this.element.append(this.tabs.element, this.inverse, this.result);
    this.atEnd(this.store.watch((what) => this.heard(what)));
    this.atEnd(() => this.leave?.());
    this.heard('robot');
  }

  override open(params: JsonObject): void {
    this.planning.open(params);
    if (typeof params['tab'] === 'string') this.tabs.show(params['tab']);
    if (isObject(params) && !this.hasDisplay()) this.addDisplay();
  }

  override state(): JsonObject {
    return { ...this.planning.state(), tab: this.tabs.name };
  }

  override shown(visible: boolean): void {
    super.shown(visible);
    this.leave?.();
    this.leave = visible ? this.store.use() : null;
  }

  private hasDisplay(): boolean {
    return Boolean(activeScene('rviz')?.displays.displays.some((display) => display.kind.name === 'MotionPlanning'));
  }

  /** What is planned is seen in RViz's view. */
  private addDisplay(): void {
    const scene = activeScene('rviz');
    if (scene?.kind !== 'rviz') return;
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
      this.say(problem ? { level: 'error', text: problem } : { level: 'ok', text: this.store.robot ? '' : 'Looking for move_group …' });
    }
    if (what === 'query') this.planning.refreshQuery();
    if (what === 'query' || what === 'robot' || what === 'current') this.joints.refresh();
    if (what === 'scene' || what === 'robot') this.objects.refresh();
    if (what === 'play' || what === 'path') this.planning.refreshPath();
    this.inverse.hidden = !ikProblem;
    setText(this.inverse, ikProblem ? `IK: ${ikProblem}` : '');
  }
}
