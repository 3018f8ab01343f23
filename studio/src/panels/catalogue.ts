/** Every kind of panel, in the order of the menu. Code is loaded when a panel is first opened. */

import { registerPanel, type PanelKind } from '../panel';
import { LAUNCHES } from '../launches/panel_kinds';
import { SCENE } from '../scene/panel_kinds';

const SIMULATION: readonly PanelKind[] = [
  {
    kind: 'joint_state_publisher_gui',
    title: 'Joint State Publisher',
    group: 'Simulation',
    about: 'A slider for every joint',
    help: {
      what: 'joint_state_publisher_gui: a slider for every joint that moves.',
      first: 'Move a slider: the robot in RViz follows. Center puts all joints back.',
      keys: [['Arrow keys', 'Move the slider that has the focus']],
      docs: 'howto/studio/#by-the-old-names',
    },
    make: async (connection, host) =>
      new (await import('./joint_sliders')).JointSliders(connection, host),
  },
  {
    kind: 'turtlesim',
    title: 'TurtleSim',
    group: 'Simulation',
    aliases: ['turtlesim_node'],
    about: 'The turtles, driven with the arrow keys',
    help: {
      what: "turtlesim's window: the turtles and the lines that they draw.",
      first: 'Click on the water, then drive the turtle.',
      keys: [['Arrow keys', 'Drive']],
      docs: 'howto/turtles/',
    },
    make: async (connection, host) => new (await import('./turtlesim')).Turtlesim(connection, host),
  },
];

const TOPICS: readonly PanelKind[] = [
  {
    kind: 'rqt_topic',
    title: 'Topic Monitor',
    group: 'Topics',
    about: 'Types, rates, bandwidths and values',
    help: {
      what: 'rqt_topic: every topic with its type, rate, bandwidth and values.',
      first: 'Tick a topic to listen to it, and unfold it for its fields.',
      keys: [
        ['Up, Down', 'Choose'],
        ['Right, Left', 'Unfold, fold'],
      ],
      docs: 'howto/nodes/',
    },
    make: async (connection, host) =>
      new (await import('./topic_monitor')).TopicMonitor(connection, host),
  },
  {
    kind: 'rqt_publisher',
    title: 'Message Publisher',
    group: 'Topics',
    about: 'Messages from forms and expressions',
    help: {
      what: 'rqt_publisher: publishes messages, once or at a rate.',
      first:
        'Choose a topic and its type, press Add, fill in the fields; a field may be an expression such as sin(i/10).',
      keys: [['Enter', 'Add the topic that was typed']],
      docs: 'howto/nodes/',
    },
    make: async (connection, host) =>
      new (await import('./publisher')).Publisher('Message Publisher', false, connection, host),
  },
  {
    kind: 'rqt_ez_publisher',
    title: 'Easy Message Publisher',
    group: 'Topics',
    about: 'Messages from sliders',
    help: {
      what: 'rqt_ez_publisher: publishes messages whose numbers are sliders.',
      first: 'Choose a topic, press Add, and move the sliders.',
      keys: [['Arrow keys', 'Move the slider that has the focus']],
      docs: 'howto/nodes/',
    },
    make: async (connection, host) =>
      new (await import('./publisher')).Publisher('Easy Message Publisher', true, connection, host),
  },
  {
    kind: 'rqt_msg',
    title: 'Message Type Browser',
    group: 'Topics',
    help: {
      what: 'rqt_msg: the fields of message types.',
      first: 'Type a part of a name, and choose a type.',
      keys: [['Up, Down', 'Choose']],
      docs: 'howto/nodes/',
    },
    make: async (connection, host) =>
      new (await import('./type_browser')).TypeBrowser(
        'Message Type Browser',
        'msg',
        connection,
        host,
      ),
  },
];

const SERVICES: readonly PanelKind[] = [
  {
    kind: 'rqt_service_caller',
    title: 'Service Caller',
    group: 'Services',
    help: {
      what: 'rqt_service_caller: calls a service and shows the answer.',
      first: 'Choose a service, fill in the request, press Call.',
      keys: [],
      docs: 'howto/nodes/',
    },
    make: async (connection, host) =>
      new (await import('./service_caller')).ServiceCaller(connection, host),
  },
  {
    kind: 'rqt_srv',
    title: 'Service Type Browser',
    group: 'Services',
    help: {
      what: 'rqt_srv: the fields of service types.',
      first: 'Type a part of a name, and choose a type.',
      keys: [['Up, Down', 'Choose']],
      docs: 'howto/nodes/',
    },
    make: async (connection, host) =>
      new (await import('./type_browser')).TypeBrowser(
        'Service Type Browser',
        'srv',
        connection,
        host,
      ),
  },
];

const ACTIONS: readonly PanelKind[] = [
  {
    kind: 'action_caller',
    title: 'Action Caller',
    group: 'Actions',
    about: 'Sends goals, shows feedback and results',
    help: {
      what: 'Sends goals to actions and shows their feedback and results.',
      first: 'Choose an action, fill in the goal, press Send.',
      keys: [],
      docs: 'howto/actions/',
    },
    make: async (connection, host) =>
      new (await import('./action_caller')).ActionCaller(connection, host),
  },
  {
    kind: 'rqt_action',
    title: 'Action Type Browser',
    group: 'Actions',
    help: {
      what: 'rqt_action: the fields of action types.',
      first: 'Type a part of a name, and choose a type.',
      keys: [['Up, Down', 'Choose']],
      docs: 'howto/actions/',
    },
    make: async (connection, host) =>
      new (await import('./type_browser')).TypeBrowser(
        'Action Type Browser',
        'action',
        connection,
        host,
      ),
  },
];

const VISUALIZATION: readonly PanelKind[] = [
  {
    kind: 'rqt_plot',
    title: 'Plot',
    group: 'Visualization',
    about: 'Numbers over time',
    help: {
      what: 'rqt_plot: numbers of topics over time.',
      first:
        'Type a topic with a field, such as /odom/twist/twist/linear/x, and press Enter; a topic alone stands for all its numbers.',
      keys: [['Enter', 'Add the curve that was typed']],
      docs: 'howto/studio/#by-the-old-names',
    },
    make: async (connection, host) => new (await import('./plot')).Plot(connection, host),
  },
  {
    kind: 'rqt_image_view',
    title: 'Image View',
    group: 'Visualization',
    aliases: ['image_view'],
    help: {
      what: "rqt_image_view: the pictures of a camera's topic.",
      first: 'Choose a topic of images.',
      keys: [],
      docs: 'sensors/',
    },
    make: async (connection, host) =>
      new (await import('./image_view')).ImageView(connection, host),
  },
  {
    kind: 'rqt_tf_tree',
    title: 'TF Tree',
    group: 'Visualization',
    aliases: ['view_frames'],
    about: 'Frames and who broadcasts them',
    help: {
      what: 'rqt_tf_tree, view_frames: coordinate frames, and who broadcasts them.',
      first:
        'An arrow leads from a parent to a child. Two trees that do not meet are why a display finds no transform.',
      keys: [
        ['Arrow keys', 'Move the picture'],
        ['+ and -', 'Larger, smaller'],
        ['0', 'All of it'],
      ],
      docs: 'howto/studio/#by-the-old-names',
    },
    make: async (connection, host) => new (await import('./tf_tree')).TfTree(connection, host),
  },
];

const LOGGING: readonly PanelKind[] = [
  {
    kind: 'rqt_console',
    title: 'Console',
    group: 'Logging',
    about: 'What nodes log',
    help: {
      what: 'rqt_console: what nodes log.',
      first: 'Filter by level, text or node; click on a line for all of it.',
      keys: [['Up, Down', 'Scroll']],
      docs: 'howto/mishaps/',
    },
    make: async (connection, host) => new (await import('./console')).Console(connection, host),
  },
  {
    kind: 'rqt_logger_level',
    title: 'Logger Level',
    group: 'Logging',
    help: {
      what: 'rqt_logger_level: from which level on a node logs.',
      first: 'Choose a node, a logger and a level.',
      keys: [['Up, Down', 'Choose']],
      docs: 'howto/nodes/',
    },
    make: async (connection, host) =>
      new (await import('./logger_level')).LoggerLevel(connection, host),
  },
  {
    kind: 'rqt_bag',
    title: 'Bag',
    group: 'Logging',
    about: 'Records and plays bags',
    help: {
      what: 'rqt_bag: records topics into a bag, and plays bags.',
      first:
        "Press Record, or type a bag's path and press Enter; the line of time takes you to a moment.",
      keys: [['Enter', 'Open the bag that was typed']],
      docs: 'howto/bags/',
    },
    make: async (connection, host) => new (await import('./bag')).Bag(connection, host),
  },
];

const OTHERS: readonly PanelKind[] = [
  {
    kind: 'rqt_graph',
    title: 'Node Graph',
    group: 'Introspection',
    about: 'Who publishes to whom',
    help: {
      what: 'rqt_graph: which node talks to which, by which topics.',
      first:
        'Hover over a node or topic for what it is joined to. Debug topics are hidden at first.',
      keys: [
        ['Arrow keys', 'Move the picture'],
        ['+ and -', 'Larger, smaller'],
        ['0', 'All of it'],
        ['Enter', 'Choose what has the focus'],
      ],
      docs: 'howto/nodes/',
    },
    make: async (connection, host) =>
      new (await import('./node_graph')).NodeGraph(connection, host),
  },
  {
    kind: 'rqt_top',
    title: 'Nodes',
    group: 'Introspection',
    aliases: ['rqt_node'],
    about: 'What a node publishes and serves, and its process',
    help: {
      what: 'rqt_top and rqt_node_info: what each node publishes, hears and serves, and its process.',
      first: 'Choose a node.',
      keys: [['Up, Down', 'Choose']],
      docs: 'howto/nodes/',
    },
    make: async (connection, host) => new (await import('./nodes')).Nodes(connection, host),
  },
  {
    kind: 'rqt_reconfigure',
    title: 'Dynamic Reconfigure',
    group: 'Configuration',
    about: 'Parameters of running nodes',
    help: {
      what: 'rqt_reconfigure: parameters of running nodes, with sliders where they have limits.',
      first: 'Choose a node and change a value: it counts at once.',
      keys: [['Enter', 'Take the value that was typed']],
      docs: 'controllers/',
    },
    make: async (connection, host) =>
      new (await import('./reconfigure')).Reconfigure(connection, host),
  },
  {
    kind: 'rqt_param',
    title: 'Parameters',
    group: 'Configuration',
    about: 'The ROS 1 parameter store',
    help: {
      what: 'The parameter store of ROS 1, as rosparam has it.',
      first: 'Type a part of a name to find it; a value that is changed is set at once.',
      keys: [['Enter', 'Take the value that was typed']],
      docs: 'howto/nodes/',
    },
    make: async (connection, host) =>
      new (await import('./parameters')).Parameters(connection, host),
  },
  {
    kind: 'moveit_setup_assistant',
    title: 'Setup Assistant',
    group: 'Robot Tools',
    aliases: ['setup_assistant'],
    about: 'Makes a MoveIt config package for a robot',
    help: {
      what: "MoveIt's Setup Assistant: a config package for a robot that has only a URDF.",
      first:
        'Load a robot, look at what each step suggests, and write the package in the last one.',
      keys: [['Up, Down', 'The step before, the next one']],
      docs: 'howto/setup_assistant/',
    },
    make: async (connection, host) =>
      new (await import('../setup_assistant/panel')).SetupAssistantPanel(connection, host),
  },
  {
    kind: 'rqt_robot_steering',
    title: 'Robot Steering',
    group: 'Robot Tools',
    about: 'Velocity commands from sliders, a pad and keys',
    aliases: ['teleop_twist_keyboard'],
    help: {
      what: 'rqt_robot_steering and teleop_twist_keyboard: velocities from sliders, a pad and keys.',
      first:
        "Name the robot's topic, often /cmd_vel, click into the field with the keys, and drive.",
      keys: [
        ['W A S D or arrows', 'Drive'],
        ['Space', 'Stop'],
      ],
      docs: 'howto/studio/#by-the-old-names',
    },
    make: async (connection, host) =>
      new (await import('./drive')).Drive('Robot Steering', connection, host),
  },
];

/** Makes all kinds known. */
export function registerAll(): void {
  for (const group of [
    LAUNCHES,
    SCENE,
    SIMULATION,
    TOPICS,
    SERVICES,
    ACTIONS,
    VISUALIZATION,
    LOGGING,
    OTHERS,
  ])
    group.forEach(registerPanel);
}
