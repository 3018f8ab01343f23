/** The tab Joints: a slider for every joint of the group, within its limits. */
import { h, notice, select } from '../widgets/dom';
import type { MotionVariable } from '../generated/messages';
import { groupOf, variablesOf } from './robot';
import type { MotionStore, Query } from './store';

const STEPS = 10_000;

interface Row {
  variable: MotionVariable;
  slider: HTMLInputElement;
  number: HTMLInputElement;
}

/** RViz's tab Joints. */
export class JointsTab {
  readonly element = h('div', { class: 'scroll motion-page' });
  private readonly body = h('div', { class: 'joints' });
  private query: Query = 'goal';
  private rows: Row[] = [];
  private made = '';

  constructor(private readonly store: MotionStore) {
    const choice = select(
      'State of the sliders',
      [
        ['goal', 'Goal state'],
        ['start', 'Start state'],
      ],
      'goal',
      (value) => {
        this.query = value as Query;
        if (!store[this.query].shown) store.show(this.query, true);
        this.refresh();
      },
    );
    this.element.append(h('div', { class: 'motion-row' }, choice), this.body);
    this.refresh();
  }

  /** Show where the state is. */
  refresh(): void {
    const { robot, group } = this.store;
    const key = `${robot?.node} ${robot?.name} ${group}`;
    if (key !== this.made) this.build();
    this.made = key;
    const positions = this.store.positions(this.query);
    for (const row of this.rows) {
      if (document.activeElement !== row.slider)
        row.slider.value = String(positions[row.variable.name] ?? 0);
      if (document.activeElement !== row.number)
        row.number.value = String(Number((positions[row.variable.name] ?? 0).toFixed(4)));
    }
  }

  private build(): void {
    const { robot, group } = this.store;
    const mimics = new Set(robot?.mimics.map((mimic) => mimic.variable));
    const active = new Set(robot && groupOf(robot, group)?.variables);
    this.rows = robot
      ? variablesOf(robot, group)
          .filter(({ name }) => active.has(name) && !mimics.has(name))
          .map((variable) => this.row(variable))
      : [];
    this.body.replaceChildren(
      ...this.rows.map(({ variable, slider, number }) =>
        h(
          'div',
          { class: 'joint-row' },
          h('span', { class: 'ellipsis', title: variable.name }, variable.name),
          slider,
          number,
        ),
      ),
    );
    if (!this.rows.length)
      this.body.append(
        notice(robot ? 'This group has no joint that can move.' : 'No robot is known.'),
      );
  }

  private row(variable: MotionVariable): Row {
    const min = variable.lower ?? -Math.PI;
    const max = variable.upper ?? Math.PI;
    const slider = h('input', {
      type: 'range',
      min,
      max,
      step: (max - min) / STEPS || 0.001,
      'aria-label': variable.name,
    });
    const number = h('input', {
      type: 'number',
      min,
      max,
      step: 'any',
      'aria-label': `${variable.name} position`,
    });
    const change = (text: string): void => {
      const value = Math.min(max, Math.max(min, Number(text) || 0));
      this.store.setQuery(this.query, {
        ...this.store.positions(this.query),
        [variable.name]: value,
      });
    };
    slider.addEventListener('input', () => {
      number.value = Number(slider.value).toFixed(4);
      change(slider.value);
    });
    number.addEventListener('change', () => {
      change(number.value);
      slider.value = number.value;
    });
    return { variable, slider, number };
  }
}
