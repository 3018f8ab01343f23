/** Steps that are a table of rows: virtual joints, end effectors, controllers, and short lists. */
import type { AssistantController, AssistantValue } from '../generated/messages';
import { button, h, notice, select, type Child } from '../widgets/dom';
import type { Part } from './session';
import { Step, field, textInput, type StepHost } from './step';

type Row = Record<string, string>;

/** A column: a text, or a choice of what there is. */
interface Column {
  name: string;
  title: string;
  options?: (value: AssistantValue) => readonly string[];
}

/** What a table is about. */
interface TableKind {
  name: string;
  about: string;
  empty: string;
  part: Part;
  columns: readonly Column[];
  rows: (value: AssistantValue) => readonly object[];
  fresh: (value: AssistantValue) => object;
}

const linksOf = (value: AssistantValue): string[] => value.links.map((link) => link.name);
const groupsOf = (value: AssistantValue): string[] => value.groups.map((group) => group.name);

/** The robot's root link. */
function rootOf(value: AssistantValue): string {
  return value.robot.root;
}

const VIRTUAL_JOINTS: TableKind = {
  name: 'Virtual Joints',
  about:
    "How the robot's root is held by the world: fixed, free in the plane, or free. A robot whose root link is world needs none.",
  empty: 'Nothing holds the root: poses are in its frame.',
  part: 'virtual_joints',
  columns: [
    { name: 'name', title: 'Name' },
    { name: 'child_link', title: 'Link', options: linksOf },
    { name: 'parent_frame', title: 'Frame' },
    { name: 'type', title: 'Type', options: () => ['fixed', 'planar', 'floating'] },
  ],
  rows: (value) => value.virtual_joints,
  fresh: (value) => ({
    name: 'virtual_joint',
    type: 'fixed',
    parent_frame: 'world',
    child_link: rootOf(value),
  }),
};

const END_EFFECTORS: TableKind = {
  name: 'End Effectors',
  about: 'Hands: a group, and the link of another group that it is mounted on.',
  empty: 'No group is mounted on another.',
  part: 'end_effectors',
  columns: [
    { name: 'name', title: 'Name' },
    { name: 'group', title: 'Group', options: groupsOf },
    { name: 'parent_link', title: 'Mounted on', options: linksOf },
    { name: 'parent_group', title: 'Of group', options: (value) => ['', ...groupsOf(value)] },
  ],
  rows: (value) => value.end_effectors,
  fresh: (value) => ({
    name: 'hand_ee',
    group: groupsOf(value).at(-1) ?? '',
    parent_link: value.groups.at(0)?.chains.at(0)?.tip_link ?? rootOf(value),
    parent_group: groupsOf(value).at(0) ?? '',
  }),
};

/** A step that is one table. */
class TableStep extends Step {
  readonly name: string;
  readonly about: string;

  constructor(
    host: StepHost,
    private readonly kind: TableKind,
  ) {
    super(host);
    this.name = kind.name;
    this.about = kind.about;
  }

  protected content(value: AssistantValue): (Child & Node)[] {
    const { kind } = this;
    const rows = kind.rows(value) as readonly Row[];
    const save = (next: readonly object[]): void => void this.host.session.edit(kind.part, next);
    const cell = (row: Row, at: number, column: Column): HTMLElement => {
      const label = `${column.title}, row ${at + 1}`;
      const put = (text: string): void =>
        save(rows.map((one, index) => (index === at ? { ...one, [column.name]: text } : one)));
      const control = column.options
        ? select(label, column.options(value), row[column.name], put)
        : textInput(label, row[column.name], put);
      return h('td', {}, control);
    };
    const table = h(
      'table',
      { class: 'assistant-table', 'aria-label': kind.name },
      h(
        'thead',
        {},
        h(
          'tr',
          {},
          ...kind.columns.map((column) => h('th', { scope: 'col' }, column.title)),
          h('td', {}),
        ),
      ),
      h(
        'tbody',
        {},
        ...rows.map((row, at) =>
          h(
            'tr',
            {},
            ...kind.columns.map((column) => cell(row, at, column)),
            h(
              'td',
              {},
              button('', () => save(rows.filter((_, index) => index !== at)), {
                icon: 'trash',
                title: `Remove ${row.name}`,
              }),
            ),
          ),
        ),
      ),
    );
    return [
      rows.length ? table : notice(kind.empty),
      h(
        'div',
        { class: 'assistant-actions' },
        button('Add', () => save([...rows, kind.fresh(value)]), { icon: 'plus' }),
      ),
    ];
  }
}

/** Step Virtual Joints. */
export const virtualJoints = (host: StepHost): Step => new TableStep(host, VIRTUAL_JOINTS);

/** Step End Effectors. */
export const endEffectors = (host: StepHost): Step => new TableStep(host, END_EFFECTORS);

/** Step Passive Joints. */
export class PassiveStep extends Step {
  readonly name = 'Passive Joints';
  readonly about = 'Joints that nothing drives: casters, and those that follow others.';

  protected content(value: AssistantValue): (Child & Node)[] {
    const moving = value.links.filter((link) => link.kind !== 'fixed' && link.joint);
    if (!moving.length) return [notice('No joint of this robot moves.')];
    return [
      h(
        'div',
        { class: 'assistant-checks' },
        ...moving.map(({ joint }) => {
          const box = h('input', { type: 'checkbox', 'aria-label': `${joint} is passive` });
          box.checked = value.passive_joints.includes(joint);
          box.addEventListener('change', () => {
            const names = moving
              .map((link) => link.joint)
              .filter((name) =>
                name === joint ? box.checked : value.passive_joints.includes(name),
              );
            void this.host.session.edit('passive_joints', names);
          });
          return h('label', { class: 'check' }, box, h('span', {}, joint));
        }),
      ),
    ];
  }
}

/** Step Controllers. */
export class ControllersStep extends Step {
  readonly name = 'Controllers';
  readonly about =
    'What trajectories are sent to: a name, its action, its class for the controller manager, its joints.';

  protected content(value: AssistantValue): (Child & Node)[] {
    const rows = value.controllers;
    const save = (next: AssistantController[]): void =>
      void this.host.session.edit('controllers', next);
    const parts = rows.map((row, at) => {
      const put = (part: Partial<AssistantController>): void =>
        save(rows.map((one, index) => (index === at ? { ...one, ...part } : one)));
      return h(
        'fieldset',
        { class: 'assistant-card' },
        h('legend', {}, row.name),
        field(
          'Name',
          textInput(`Name of controller ${at + 1}`, row.name, (name) => put({ name })),
          button('', () => save(rows.filter((_, index) => index !== at)), {
            icon: 'trash',
            title: `Remove ${row.name}`,
          }),
        ),
        field(
          'Action',
          select(
            `Action of ${row.name}`,
            ['FollowJointTrajectory', 'GripperCommand'],
            row.type,
            (type) =>
              put({
                type,
                action_ns: type === 'GripperCommand' ? 'gripper_cmd' : 'follow_joint_trajectory',
              }),
          ),
        ),
        field(
          'Class',
          textInput(`Class of ${row.name}`, row.plugin, (plugin) => put({ plugin })),
        ),
        field(
          'Joints',
          textInput(`Joints of ${row.name}`, row.joints.join(' '), (text) =>
            put({ joints: text.split(/[\s,]+/).filter(Boolean) }),
          ),
        ),
      );
    });
    const group = value.robot.groups.at(0);
    const fresh = {
      name: `${group?.name ?? 'arm'}_controller`,
      type: 'FollowJointTrajectory',
      plugin:
        value.ros_version === 1
          ? 'position_controllers/JointTrajectoryController'
          : 'joint_trajectory_controller/JointTrajectoryController',
      action_ns: 'follow_joint_trajectory',
      joints: group?.active ?? [],
    };
    return [
      ...(parts.length ? parts : [notice('Nothing executes trajectories yet.')]),
      h(
        'div',
        { class: 'assistant-actions' },
        button('Add', () => save([...rows, fresh]), { icon: 'plus' }),
      ),
    ];
  }
}

/** Step ros2_control, or transmissions of ROS 1. */
export class HardwareStep extends Step {
  readonly name = 'Hardware';
  readonly about =
    'What joints are commanded by: <ros2_control> of ROS 2, <transmission> of ROS 1. What the robot itself says stays; the rest is added by this package.';

  protected content(value: AssistantValue): (Child & Node)[] {
    const kinds = ['position', 'velocity', 'effort'];
    if (!value.interfaces.length) return [notice('No joint of this robot is driven.')];
    const change = (joint: string, kind: string, on: boolean): void => {
      const next = value.interfaces.map((row) =>
        row.joint === joint
          ? {
              ...row,
              kinds: kinds.filter((one) => (one === kind ? on : row.kinds.includes(one))),
            }
          : row,
      );
      void this.host.session.edit('interfaces', next);
    };
    return [
      h(
        'table',
        { class: 'assistant-table', 'aria-label': 'Command interfaces' },
        h(
          'thead',
          {},
          h(
            'tr',
            {},
            ...['Joint', ...kinds, 'Said by'].map((text) => h('th', { scope: 'col' }, text)),
          ),
        ),
        h(
          'tbody',
          {},
          ...value.interfaces.map((row) =>
            h(
              'tr',
              {},
              h('td', {}, row.joint),
              ...kinds.map((kind) => {
                const box = h('input', {
                  type: 'checkbox',
                  'aria-label': `${row.joint} ${kind}`,
                  disabled: !row.is_added,
                });
                box.checked = row.kinds.includes(kind);
                box.addEventListener('change', () => change(row.joint, kind, box.checked));
                return h('td', {}, box);
              }),
              h('td', { class: 'dim' }, row.is_added ? 'this package' : 'the robot'),
            ),
          ),
        ),
      ),
      h('p', { class: 'dim' }, `Told of each joint: ${value.state_interfaces.join(', ')}.`),
    ];
  }
}

/** Step Author. */
export class AuthorStep extends Step {
  readonly name = 'Author';
  readonly about = 'Who maintains the package, and what it is called.';

  protected content(value: AssistantValue): (Child & Node)[] {
    const author = (part: object): void =>
      void this.host.session.edit('author', {
        name: value.author_name,
        email: value.author_email,
        ...part,
      });
    return [
      field(
        'Name',
        textInput('Author', value.author_name, (name) => author({ name })),
      ),
      field(
        'Address',
        textInput('Email', value.author_email, (email) => author({ email })),
      ),
      field(
        'Package',
        textInput(
          'Name of the package',
          value.package_name,
          (name) => void this.host.session.edit('package_name', name),
        ),
      ),
    ];
  }
}
