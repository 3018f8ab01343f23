/** Step Planning Groups: chains from link to link, joints of hands, their solvers. */
import type { AssistantGroup, AssistantLink, AssistantValue } from '../generated/messages';
import { button, h, notice, select, type Child } from '../widgets/dom';
import { Step, field, textInput } from './step';

const SOLVERS: readonly (readonly [string, string])[] = [
  ['', 'None'],
  ['kdl_kinematics_plugin/KDLKinematicsPlugin', 'KDL'],
  ['trac_ik_kinematics_plugin/TRAC_IKKinematicsPlugin', 'TRAC-IK'],
  ['cached_ik_kinematics_plugin/CachedKDLKinematicsPlugin', 'KDL, cached'],
  ['lma_kinematics_plugin/LMAKinematicsPlugin', 'LMA'],
];

/** Changes groups. */
export class GroupsStep extends Step {
  readonly name = 'Planning Groups';
  readonly about =
    'Joints that are planned for together: an arm is a chain from link to link, a hand is a list of joints.';
  private chosen = 0;

  protected content(value: AssistantValue): (Child & Node)[] {
    this.chosen = Math.min(this.chosen, Math.max(0, value.groups.length - 1));
    const group = value.groups.at(this.chosen);
    this.host.preview.mark(group ? linksOf(group, value) : null);
    const names = value.groups.map((one, at) =>
      button(
        one.name,
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
        { class: 'assistant-actions', role: 'group', 'aria-label': 'Groups' },
        ...names,
        button('Chain', () => this.add(value, true), { icon: 'plus', title: 'Add a chain' }),
        button('Joints', () => this.add(value, false), { icon: 'plus', title: 'Add joints' }),
      ),
      ...(group ? this.form(group, value) : [notice('There is no group yet: add one.')]),
    ];
  }

  override left(): void {
    this.host.preview.mark(null);
  }

  private form(group: AssistantGroup, value: AssistantValue): (Child & Node)[] {
    const parts: (Child & Node)[] = [
      field(
        'Name',
        textInput('Name of the group', group.name, (name) => this.put({ ...group, name })),
        button('Remove', () => this.remove(), { icon: 'trash', title: `Remove ${group.name}` }),
      ),
      field(
        'Inverse kinematics',
        select(
          'Solver of inverse kinematics',
          SOLVERS.some(([name]) => name === group.solver)
            ? SOLVERS
            : [...SOLVERS, [group.solver, group.solver]],
          group.solver,
          (solver) => this.put({ ...group, solver }),
        ),
      ),
    ];
    const links = value.links.map((link) => link.name);
    group.chains.forEach((chain, at) => {
      const change = (part: object): void =>
        this.put({
          ...group,
          chains: group.chains.map((one, index) => (index === at ? { ...one, ...part } : one)),
        });
      parts.push(
        field(
          'Chain',
          select('First link of the chain', links, chain.base_link, (base_link) =>
            change({ base_link }),
          ),
          h('span', {}, 'to'),
          select('Last link of the chain', links, chain.tip_link, (tip_link) =>
            change({ tip_link }),
          ),
        ),
      );
    });
    if (!group.chains.length) parts.push(this.joints(group, value));
    parts.push(
      h('h3', {}, 'Links of the robot'),
      tree(group, value, (link) => this.mark(link)),
    );
    return parts;
  }

  private joints(group: AssistantGroup, value: AssistantValue): HTMLElement {
    const moving = value.links.filter((link) => link.kind !== 'fixed' && link.joint);
    return h(
      'fieldset',
      { class: 'assistant-checks' },
      h('legend', {}, 'Joints'),
      ...moving.map((link) => {
        const box = h('input', { type: 'checkbox', 'aria-label': `Joint ${link.joint}` });
        box.checked = group.joints.includes(link.joint);
        box.addEventListener('change', () =>
          this.put({
            ...group,
            joints: moving
              .map((one) => one.joint)
              .filter((name) => (name === link.joint ? box.checked : group.joints.includes(name))),
          }),
        );
        return h('label', { class: 'check' }, box, h('span', {}, link.joint));
      }),
    );
  }

  private mark(link: string): void {
    this.host.preview.mark([link]);
  }

  private put(group: AssistantGroup): void {
    const groups = this.host.session.value?.groups ?? [];
    void this.host.session.edit(
      'groups',
      groups.map((one, at) => (at === this.chosen ? group : one)),
    );
  }

  private remove(): void {
    const groups = this.host.session.value?.groups ?? [];
    void this.host.session.edit(
      'groups',
      groups.filter((_, at) => at !== this.chosen),
    );
  }

  private add(value: AssistantValue, isChain: boolean): void {
    const taken = new Set(value.groups.map((group) => group.name));
    const plain = isChain ? 'arm' : 'gripper';
    let name = plain;
    for (let number = 2; taken.has(name); number++) name = `${plain}_${number}`;
    const moving = value.links.filter((link) => link.kind !== 'fixed' && link.joint);
    const [first, last] = [moving.at(0), moving.at(-1)];
    if (!first || !last) return;
    const chains = isChain ? [{ base_link: first.parent, tip_link: first.name }] : [];
    const joints = isChain ? [] : [last.joint];
    const made = { name, chains, links: [], joints, subgroups: [], solver: '' };
    this.chosen = value.groups.length;
    void this.host.session.edit('groups', [...value.groups, made]);
  }
}

/** The links that a group's joints carry. */
export function linksOf(group: AssistantGroup, value: AssistantValue): string[] {
  const above = new Map(value.links.map((link) => [link.name, link]));
  const found = new Set(group.links);
  for (const link of value.links) if (group.joints.includes(link.joint)) found.add(link.name);
  for (const chain of group.chains) {
    let at: AssistantLink | undefined = above.get(chain.tip_link);
    while (at && at.name !== chain.base_link) {
      found.add(at.name);
      at = above.get(at.parent);
    }
  }
  for (const name of group.subgroups) {
    const inner = value.groups.find((one) => one.name === name);
    if (inner && inner !== group) for (const link of linksOf(inner, value)) found.add(link);
  }
  return [...found];
}

/** All links, each below the one that carries it; those of the group are marked. */
function tree(
  group: AssistantGroup,
  value: AssistantValue,
  entered: (link: string) => void,
): HTMLElement {
  const own = new Set(linksOf(group, value));
  const depth = new Map<string, number>();
  return h(
    'ul',
    { class: 'assistant-tree', 'aria-label': 'Links of the robot' },
    ...value.links.map((link) => {
      const level = link.joint ? (depth.get(link.parent) ?? 0) + 1 : 0;
      depth.set(link.name, level);
      const how = link.joint ? ` (${link.kind} ${link.joint})` : '';
      return h(
        'li',
        {
          style: `padding-left: ${level * 12}px`,
          'data-own': own.has(link.name) ? 'yes' : undefined,
          on: { pointerenter: () => entered(link.name) },
        },
        link.name,
        h('span', { class: 'dim' }, how),
      );
    }),
  );
}
