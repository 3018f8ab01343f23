/** Whether Nav2's nodes are active, and what a lifecycle manager can be told. */
import type { Connection } from '../connection';
import type { GraphStore } from '../graph_store';
import { isObject, textOf, type JsonObject } from '../json';
import { button, h, setText } from '../widgets/dom';

const ASK_MS = 2000;
const TIMEOUT_S = 30;
const MANAGE = /\/manage_nodes$/;

/** `nav2_msgs/srv/ManageLifecycleNodes`. */
const COMMANDS = [
  ['Startup', 0],
  ['Pause', 1],
  ['Resume', 2],
  ['Reset', 3],
  ['Shutdown', 4],
] as const;

/** A service without a request: button, its name below the robot's namespace, type. */
const SERVICES = [
  ['Clear costmaps', 'move_base/clear_costmaps'],
  ['Clear global costmap', 'global_costmap/clear_entirely_global_costmap'],
  ['Clear local costmap', 'local_costmap/clear_entirely_local_costmap'],
  ['Global localization', 'global_localization'],
  ['Global localization', 'reinitialize_global_localization'],
] as const;

/** The rows of the managers and the services of one robot. */
export class Lifecycle {
  readonly element = h('div', { class: 'lifecycle', role: 'group', 'aria-label': 'Nodes' });
  private robot = '';
  private managers: string[] = [];
  private shown = '';
  private readonly states = new Map<string, HTMLElement>();
  private readonly timer: number;

  constructor(
    private readonly connection: Connection,
    private readonly graph: GraphStore,
    private readonly host: {
      visible(): boolean;
      fail(problem: unknown): void;
      told(text: string): void;
    },
  ) {
    this.timer = window.setInterval(() => void this.ask(), ASK_MS);
  }

  dispose(): void {
    clearInterval(this.timer);
  }

  /** Show what there is for a robot. */
  use(robot: string): void {
    this.robot = robot;
    const names = this.graph.value.services.map((each) => each.name);
    this.managers = names
      .filter((name) => MANAGE.test(name) && name.startsWith(`${robot}/`))
      .map((name) => name.replace(MANAGE, ''))
      .sort();
    const services = SERVICES.filter(([, name]) => names.includes(`${robot}/${name}`));
    const now = JSON.stringify([robot, this.managers, services]);
    if (now === this.shown) return;
    this.shown = now;
    this.states.clear();
    this.element.replaceChildren(
      ...this.managers.map((name) => this.row(name)),
      h(
        'div',
        { class: 'button-row' },
        ...services.map(([text, name]) =>
          button(text, () => void this.call(`${this.robot}/${name}`, {}, text)),
        ),
      ),
    );
    void this.ask();
  }

  private row(manager: string): HTMLElement {
    const state = h(
      'output',
      { class: 'lifecycle-state', 'aria-label': `State of ${manager}` },
      'asking…',
    );
    this.states.set(manager, state);
    const title = manager.split('/').pop()?.replace('lifecycle_manager_', '') ?? manager;
    return h(
      'div',
      { class: 'button-row', role: 'group', 'aria-label': manager },
      h('b', { title: manager }, title),
      state,
      ...COMMANDS.map(([text, command]) =>
        button(
          text,
          () => void this.call(`${manager}/manage_nodes`, { command }, `${text} ${title}`),
        ),
      ),
    );
  }

  private async call(service: string, request: JsonObject, about: string): Promise<void> {
    try {
      const answer = await this.connection.call('service.call', {
        service,
        request,
        timeout_s: TIMEOUT_S,
      });
      const refused = isObject(answer) && answer.success === false;
      if (refused)
        this.host.fail(
          new Error(`${about}: ${service} says no. The console tells which node did not follow.`),
        );
      else this.host.told(`${about}: done`);
    } catch (problem) {
      this.host.fail(problem);
    }
    await this.ask();
  }

  private async ask(): Promise<void> {
    if (!this.host.visible()) return;
    for (const [manager, element] of this.states) {
      const service = `${manager}/is_active`;
      const answer = await this.connection
        .call('service.call', { service, request: {}, timeout_s: ASK_MS / 1000 })
        .catch(() => null);
      const active = isObject(answer) ? answer.success === true : null;
      setText(
        element,
        active === null
          ? 'no answer'
          : active
            ? 'active'
            : textOf(answer as JsonObject, 'message') || 'inactive',
      );
      element.dataset.state = active ? 'active' : 'inactive';
    }
  }
}
