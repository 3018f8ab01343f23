/** Setup Assistant: MoveIt config packages, step by step as in MoveIt's own. */
import type { JsonObject } from '../json';
import { BasePanel } from '../panels/base';
import { h } from '../widgets/dom';
import '../styles/setup_assistant.css';
import { CollisionsStep } from './collisions_step';
import { GroupsStep } from './groups_step';
import { PosesStep } from './poses_step';
import { Preview } from './preview';
import {
  AuthorStep,
  ControllersStep,
  HardwareStep,
  PassiveStep,
  endEffectors,
  virtualJoints,
} from './row_steps';
import { Session } from './session';
import { StartStep } from './start_step';
import type { Step, StepHost } from './step';
import { WriteStep } from './write_step';

/** The panel. */
export class SetupAssistantPanel extends BasePanel {
  readonly title = 'Setup Assistant';
  private readonly session: Session;
  private readonly preview = new Preview();
  private readonly steps: readonly Step[];
  private readonly start: StartStep;
  private readonly buttons: HTMLButtonElement[];
  private chosen = 0;

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.session = new Session(this.connection, (problem) => this.host.fail(problem, this.title));
    const host: StepHost = {
      session: this.session,
      preview: this.preview,
      go: (name) => this.choose(this.steps.findIndex((step) => step.name === name)),
      say: (text) => this.host.tell(text),
    };
    this.start = new StartStep(host);
    this.steps = [
      this.start,
      new CollisionsStep(host),
      virtualJoints(host),
      new GroupsStep(host),
      new PosesStep(host),
      endEffectors(host),
      new PassiveStep(host),
      new HardwareStep(host),
      new ControllersStep(host),
      new AuthorStep(host),
      new WriteStep(host),
    ];
    this.buttons = this.steps.map((step, at) =>
      h(
        'button',
        {
          type: 'button',
          class: 'button assistant-step',
          role: 'tab',
          on: { click: () => this.choose(at), keydown: (event) => this.key(event) },
        },
        step.name,
      ),
    );
    const list = h(
      'div',
      {
        class: 'assistant-steps',
        role: 'tablist',
        'aria-orientation': 'vertical',
        'aria-label': 'Steps of the Setup Assistant',
      },
      ...this.buttons,
    );
    this.element.classList.add('assistant');
    this.element.append(
      list,
      h('div', { class: 'assistant-pages' }, ...this.steps.map((step) => step.element)),
      this.preview.element,
    );
    this.session.watch(() => this.changed());
    this.atEnd(() => this.preview.dispose());
    this.choose(0);
  }

  override open(params: JsonObject): void {
    void this.start.begin(params);
  }

  override state(): JsonObject {
    const { value } = this.session;
    return value ? { file: value.file } : {};
  }

  override shown(visible: boolean): void {
    super.shown(visible);
    this.preview.show(visible);
  }

  private changed(): void {
    const { value } = this.session;
    this.preview.element.hidden = !value;
    if (value) this.preview.setRobot(value.robot);
    this.steps[this.chosen].refresh();
    this.host.touched();
  }

  private choose(at: number): void {
    if (at < 0) return;
    if (at !== this.chosen) this.steps[this.chosen].left();
    this.chosen = at;
    this.steps.forEach((step, index) => {
      step.element.hidden = index !== at;
      this.buttons[index].setAttribute('aria-selected', String(index === at));
      this.buttons[index].tabIndex = index === at ? 0 : -1;
    });
    this.preview.element.hidden = !this.session.value;
    this.steps[at].refresh();
  }

  private key(event: KeyboardEvent): void {
    const last = this.steps.length - 1;
    const next = {
      ArrowDown: Math.min(last, this.chosen + 1),
      ArrowUp: Math.max(0, this.chosen - 1),
      Home: 0,
      End: last,
    }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    this.choose(next);
    this.buttons[next].focus();
  }
}
