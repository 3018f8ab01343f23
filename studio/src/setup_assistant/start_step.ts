/** Step Start: which robot, for which ROS, or a config package that is there. */
import type { AssistantStart, AssistantValue } from '../generated/messages';
import type { JsonObject } from '../json';
import { button, h, notice, select, type Child } from '../widgets/dom';
import { nameInput } from '../widgets/name_input';
import { Step, field, textInput } from './step';

/** Loads a robot. */
export class StartStep extends Step {
  readonly name = 'Start';
  readonly about = 'A robot that has only a URDF or xacro, or a config package to be changed.';
  override readonly needsRobot = false;
  private choices: AssistantStart | null = null;
  private file = '';
  private args = '';
  private version = '0';
  private loading = false;

  /** Ask once what there is. */
  async begin(params: JsonObject): Promise<void> {
    const answer = await this.host.session.ask('setup_assistant.start');
    this.choices = answer as unknown as AssistantStart | null;
    if (typeof params.file === 'string') this.file = params.file;
    this.refresh();
    if (typeof params.package === 'string') await this.load({ package: params.package });
    else if (this.file) await this.loadFile();
  }

  protected content(value: AssistantValue | null): (Child & Node)[] {
    const robots = this.choices?.robots ?? [];
    const packages = this.choices?.packages ?? [];
    const file = nameInput({
      label: 'Robot file',
      placeholder: 'package://…/robot.urdf.xacro',
      value: this.file,
      names: () => robots,
      chosen: (name) => {
        this.file = name;
      },
    });
    const parts: (Child & Node)[] = [
      h('h3', {}, 'A new config package'),
      field('Robot file', h('span', { class: 'assistant-wide' }, file)),
      field(
        'Arguments of xacro',
        textInput('Arguments of xacro', this.args, (text) => {
          this.args = text;
        }),
      ),
      field(
        'ROS',
        select(
          'ROS version',
          [
            ['0', "That of the robot's package"],
            ['1', 'ROS 1'],
            ['2', 'ROS 2'],
          ],
          this.version,
          (version) => {
            this.version = version;
          },
        ),
      ),
      h(
        'div',
        { class: 'assistant-actions' },
        button('Load', () => void this.loadFile(), { class: 'primary' }),
      ),
    ];
    if (packages.length)
      parts.push(
        h('h3', {}, 'A config package that is there'),
        h(
          'div',
          { class: 'assistant-actions' },
          ...packages.map((name) => button(name, () => void this.load({ package: name }))),
        ),
      );
    if (this.choices && !robots.length)
      parts.push(
        notice(
          `No package below ${this.choices.folder} has a robot's file; type a path, or start the page in a workspace.`,
        ),
      );
    if (this.loading) parts.push(h('p', { role: 'status' }, 'Reading the robot …'));
    else if (value)
      parts.push(
        h(
          'p',
          { role: 'status', class: 'assistant-loaded' },
          `${value.robot.name}: ${value.links.length} links, ${value.robot.joints.length} joints that move, ${value.groups.length} planning groups proposed. The steps at the left show everything that is proposed.`,
        ),
      );
    return parts;
  }

  private async loadFile(): Promise<void> {
    const input = this.element.querySelector<HTMLInputElement>("[aria-label='Robot file']");
    this.file = input?.value.trim() || this.file;
    await this.load({
      file: this.file,
      xacro_args: this.args,
      ros_version: Number(this.version),
    });
  }

  private async load(params: JsonObject): Promise<void> {
    this.loading = true;
    this.refresh();
    await this.host.session.load(params);
    this.loading = false;
    this.refresh();
  }
}
