/** Start: where a person begins while nothing runs: demos, the last launches, a robot file. */

import type { DemoCard, DemosValue, RecentLaunch } from '../generated/messages';
import { isObject } from '../json';
import { BasePanel } from '../panels/base';
import { button, h, notice, setText } from '../widgets/dom';
import { findingsStore, stateOf } from './findings_store';
import { acceptDrops, RobotDrop } from './robot_drop';

const LOOK_AGAIN_MS = 4000;

/** The start page. */
export class StartPanel extends BasePanel {
  readonly title = 'Start';
  private readonly gallery = h('ul', { class: 'demo-cards' });
  private readonly recent = h('ul', { class: 'recent-launches' });
  private readonly lead = h('p', { class: 'start-lead', role: 'status' });
  private shownText = '';
  private timer = 0;

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    const drop = new RobotDrop(this.connection, this.host);
    this.element.classList.add('start');
    this.element.append(
      h(
        'div',
        { class: 'scroll start-body', tabindex: 0, 'aria-label': 'Start page' },
        h('h2', {}, 'Welcome to Gazelle'),
        this.lead,
        part('Demos', this.gallery),
        h(
          'div',
          { class: 'start-halves' },
          part('Last launches', this.recent),
          part('A robot file', drop.element),
        ),
      ),
    );
    acceptDrops(this.element, (files) => drop.take(files));
    this.atEnd(findingsStore(this.connection).watch(() => void this.refresh()));
    this.atEnd(this.host.graph.watch(() => this.lookAround()));
    this.atEnd(() => clearTimeout(this.timer));
  }

  override shown(visible: boolean): void {
    super.shown(visible);
    if (visible) void this.refresh();
  }

  private lookAround(): void {
    const nodes = this.host.graph.value.nodes.filter((node) => node.name !== '/rosout');
    setText(
      this.lead,
      nodes.length === 0
        ? 'Nothing runs yet. Start a demo, launch something in a terminal, or look at a robot file.'
        : `${nodes.length === 1 ? 'A node runs' : `${nodes.length} nodes run`}. The menus Panels and Layout show what they do.`,
    );
  }

  private async refresh(): Promise<void> {
    clearTimeout(this.timer);
    if (!this.visible) return;
    const [demos, recent] = await Promise.all([
      this.connection.call('demo.list').catch(() => null),
      this.connection.call('launch.recent').catch(() => null),
    ]);
    this.timer = window.setTimeout(() => void this.refresh(), LOOK_AGAIN_MS);
    const text = JSON.stringify([demos, recent]);
    // What has the focus keeps it.
    if (text === this.shownText) return;
    this.shownText = text;
    const value = isObject(demos) ? (demos as unknown as DemosValue) : null;
    this.showDemos(value);
    this.showRecent(Array.isArray(recent) ? (recent as unknown as RecentLaunch[]) : [], value);
  }

  private showDemos(value: DemosValue | null): void {
    const cards = (value?.demos ?? []).map((demo) => this.card(demo, value as DemosValue));
    this.gallery.replaceChildren(...cards);
    if (cards.length === 0)
      this.gallery.append(h('li', {}, notice('The server has no demos to offer.')));
  }

  private card(demo: DemoCard, value: DemosValue): HTMLElement {
    const runs = value.running === demo.name;
    const start = runs
      ? button('Stop', () => void this.ask('demo.stop').then(() => this.refresh()), {
          icon: 'stop',
          title: `Stop the demo ${demo.title}`,
        })
      : button('Start', () => void this.start(demo), {
          icon: 'play',
          class: 'primary',
          title: `Start the demo: ${demo.title}`,
        });
    start.setAttribute('aria-label', `${runs ? 'Stop' : 'Start'}: ${demo.title}`);
    start.disabled = value.running !== '' && !runs;
    const picture = demo.picture
      ? h('img', { src: demo.picture, alt: '', width: 480, height: 270, loading: 'lazy' })
      : h('div', { class: 'no-picture', 'aria-hidden': 'true' }, demo.name);
    return h(
      'li',
      { class: 'demo-card', 'data-demo': demo.name },
      picture,
      h(
        'div',
        { class: 'demo-text' },
        h('h4', {}, demo.title),
        h('p', {}, `${demo.summary} (ROS ${demo.ros_version})`),
        runs ? this.steps(demo) : null,
        this.command(demo.command),
        value.may_start ? h('div', { class: 'demo-buttons' }, start) : null,
      ),
    );
  }

  private steps(demo: DemoCard): HTMLElement {
    return h(
      'div',
      { class: 'demo-steps' },
      h('p', {}, demo.seen),
      h('p', {}, h('strong', {}, 'Try next, in a terminal:')),
      ...demo.steps.flatMap((step) => [h('p', {}, step.what), this.command(step.command)]),
    );
  }

  private command(text: string, copied = text): HTMLElement {
    return h(
      'div',
      { class: 'command' },
      h('code', { class: 'mono' }, text),
      button('', () => void this.copy(copied), {
        icon: 'copy',
        title: `Copy: ${text}`,
        class: 'ghost',
      }),
    );
  }

  private showRecent(launches: readonly RecentLaunch[], demos: DemosValue | null): void {
    this.recent.replaceChildren(...launches.map((launch) => this.launch(launch, demos)));
    if (launches.length === 0)
      this.recent.append(
        h('li', { class: 'dim' }, 'What you launch in a terminal is listed here, to be copied.'),
      );
  }

  private launch(launch: RecentLaunch, demos: DemosValue | null): HTMLElement {
    const when = new Date(launch.started_s * 1000);
    const today = when.toDateString() === new Date().toDateString();
    const time = today ? when.toLocaleTimeString() : when.toLocaleDateString();
    const wrong = launch.errors ? `, ${launch.errors} error${launch.errors > 1 ? 's' : ''}` : '';
    const demo = demos?.demos.find((each) => each.name === launch.demo);
    const mayStart = demo && demos?.may_start && demos.running === '';
    return h(
      'li',
      { class: 'recent-launch' },
      this.command(launch.command, launch.copied),
      h(
        'div',
        { class: 'recent-about' },
        h('span', { class: 'dim' }, `${launch.folder}, ${time}, ${stateOf(launch)}${wrong}`),
        mayStart
          ? button('Start again', () => void this.start(demo), { icon: 'play', class: 'small' })
          : null,
      ),
    );
  }

  private async copy(text: string): Promise<void> {
    try {
      await navigator.clipboard.writeText(text);
      this.host.tell('The command is copied: paste it into a terminal.');
    } catch {
      // Browsers give no clipboard to pages of other machines without a certificate.
      this.host.fail(new Error('The browser does not let this page copy; select the command.'));
    }
  }

  private async start(demo: DemoCard): Promise<void> {
    const started = await this.ask('demo.start', { name: demo.name });
    if (started === null) return;
    this.host.tell(`${demo.title} is starting. What to try next is on the start page.`);
    await this.refresh();
  }
}

function part(title: string, content: HTMLElement): HTMLElement {
  return h('section', { class: 'start-part', 'aria-label': title }, h('h3', {}, title), content);
}
