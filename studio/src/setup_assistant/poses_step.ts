/** Step Robot Poses: named positions of a group, set by sliders and seen in 3D. */
import type { AssistantState, AssistantValue, MotionVariable } from '../generated/messages';
import { groupOf, variablesOf } from '../motion/robot';
import { button, h, notice, select, type Child } from '../widgets/dom';
import { Step, field, textInput } from './step';

const STEPS = 10_000;

/** Changes named poses. */
export class PosesStep extends Step {
  readonly name = 'Robot Poses';
  readonly about = 'Positions of a group that have a name, such as home, or open and close.';
  private chosen = 0;

  protected content(value: AssistantValue): (Child & Node)[] {
    this.chosen = Math.min(this.chosen, Math.max(0, value.states.length - 1));
    const state = value.states.at(this.chosen);
    if (state) this.host.preview.setPositions(state.values);
    const names = value.states.map((one, at) =>
      button(
        `${one.group}: ${one.name}`,
        () => {
          this.chosen = at;
          this.refresh();
        },
        { pressed: at === this.chosen },
      ),
    );
    return [
      h(
        'div',
        { class: 'assistant-actions', role: 'group', 'aria-label': 'Poses' },
        ...names,
        button('Pose', () => this.add(value), { icon: 'plus', title: 'Add a pose' }),
      ),
      ...(state ? this.form(state, value) : [notice('There is no pose yet: add one.')]),
    ];
  }

  private form(state: AssistantState, value: AssistantValue): (Child & Node)[] {
    const groups = value.groups.map((group) => group.name);
    const variables = activeOf(state.group, value);
    return [
      field(
        'Name',
        textInput('Name of the pose', state.name, (name) => this.put({ ...state, name })),
        button('Remove', () => this.remove(), { icon: 'trash', title: `Remove ${state.name}` }),
      ),
      field(
        'Group',
        select('Group of the pose', groups, state.group, (group) =>
          this.put({ ...state, group, values: this.now(group, value) }),
        ),
      ),
      h('div', { class: 'joints' }, ...variables.map((variable) => this.slider(variable, state))),
    ];
  }

  private slider(variable: MotionVariable, state: AssistantState): HTMLElement {
    const { name } = variable;
    const min = variable.lower ?? -Math.PI;
    const max = variable.upper ?? Math.PI;
    const at = state.values[name] ?? 0;
    const slider = h('input', {
      type: 'range',
      min,
      max,
      step: (max - min) / STEPS || 0.001,
      'aria-label': name,
    });
    slider.value = String(at);
    const number = h('input', {
      type: 'number',
      min,
      max,
      step: 'any',
      value: Number(at.toFixed(4)),
      'aria-label': `${name} position`,
    });
    const save = (text: string): void => {
      const position = Math.min(max, Math.max(min, Number(text) || 0));
      this.put({ ...state, values: { ...state.values, [name]: position } });
    };
    slider.addEventListener('input', () => {
      number.value = Number(slider.value).toFixed(4);
      this.host.preview.setPositions({ [name]: Number(slider.value) });
    });
    slider.addEventListener('change', () => save(slider.value));
    number.addEventListener('change', () => save(number.value));
    return h(
      'div',
      { class: 'joint-row' },
      h('span', { class: 'ellipsis', title: name }, name),
      slider,
      number,
    );
  }

  /** Where the 3D view has the group. */
  private now(group: string, value: AssistantValue): Record<string, number> {
    const { positions } = this.host.preview;
    return Object.fromEntries(
      activeOf(group, value).map(({ name }) => [
        name,
        positions[name] ?? value.robot.defaults[name] ?? 0,
      ]),
    );
  }

  private put(state: AssistantState): void {
    const states = this.host.session.value?.states ?? [];
    void this.host.session.edit(
      'states',
      states.map((one, at) => (at === this.chosen ? state : one)),
    );
  }

  private remove(): void {
    const states = this.host.session.value?.states ?? [];
    void this.host.session.edit(
      'states',
      states.filter((_, at) => at !== this.chosen),
    );
  }

  private add(value: AssistantValue): void {
    const group = value.states.at(this.chosen)?.group ?? value.groups.at(0)?.name;
    if (!group) return;
    const taken = new Set(value.states.filter((one) => one.group === group).map((one) => one.name));
    let name = 'pose';
    for (let number = 2; taken.has(name); number++) name = `pose_${number}`;
    this.chosen = value.states.length;
    const made = { name, group, values: this.now(group, value) };
    void this.host.session.edit('states', [...value.states, made]);
  }
}

/** The variables of a group that follow no other. */
function activeOf(group: string, value: AssistantValue): MotionVariable[] {
  if (!groupOf(value.robot, group)) return [];
  const followers = new Set(value.robot.mimics.map((mimic) => mimic.variable));
  return variablesOf(value.robot, group).filter(({ name }) => !followers.has(name));
}
