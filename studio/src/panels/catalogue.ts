/** Every kind of panel, in the order of the menu. Code is loaded when a panel is first opened. */

import { registerPanel, type PanelKind } from '../panel';
import { SCENE } from '../scene/panel_kinds';

const SIMULATION: readonly PanelKind[] = [
  {
    kind: 'joint_state_publisher_gui',
    title: 'Joint State Publisher',
    group: 'Simulation',
    about: 'A slider for every joint',
    make: async (connection, host) =>
      new (await import('./joint_sliders')).JointSliders(connection, host),
  },
  {
    kind: 'turtlesim',
    title: 'TurtleSim',
    group: 'Simulation',
    aliases: ['turtlesim_node'],
    about: 'The turtles, driven with the arrow keys',
    make: async (connection, host) => new (await import('./turtlesim')).Turtlesim(connection, host),
  },
];

const TOPICS: readonly PanelKind[] = [
  {
    kind: 'rqt_topic',
    title: 'Topic Monitor',
    group: 'Topics',
    about: 'Types, rates, bandwidths and values',
    make: async (connection, host) =>
      new (await import('./topic_monitor')).TopicMonitor(connection, host),
  },
  {
    kind: 'rqt_publisher',
    title: 'Message Publisher',
    group: 'Topics',
    about: 'Messages from forms and expressions',
    make: async (connection, host) =>
      new (await import('./publisher')).Publisher('Message Publisher', false, connection, host),
  },
  {
    kind: 'rqt_ez_publisher',
    title: 'Easy Message Publisher',
    group: 'Topics',
    about: 'Messages from sliders',
    make: async (connection, host) =>
      new (await import('./publisher')).Publisher('Easy Message Publisher', true, connection, host),
  },
  {
    kind: 'rqt_msg',
    title: 'Message Type Browser',
    group: 'Topics',
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
    make: async (connection, host) =>
      new (await import('./service_caller')).ServiceCaller(connection, host),
  },
  {
    kind: 'rqt_srv',
    title: 'Service Type Browser',
    group: 'Services',
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
    make: async (connection, host) =>
      new (await import('./action_caller')).ActionCaller(connection, host),
  },
  {
    kind: 'rqt_action',
    title: 'Action Type Browser',
    group: 'Actions',
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
    make: async (connection, host) => new (await import('./plot')).Plot(connection, host),
  },
  {
    kind: 'rqt_image_view',
    title: 'Image View',
    group: 'Visualization',
    aliases: ['image_view'],
    make: async (connection, host) =>
      new (await import('./image_view')).ImageView(connection, host),
  },
  {
    kind: 'rqt_tf_tree',
    title: 'TF Tree',
    group: 'Visualization',
    aliases: ['view_frames'],
    about: 'Frames and who broadcasts them',
    make: async (connection, host) => new (await import('./tf_tree')).TfTree(connection, host),
  },
];

const LOGGING: readonly PanelKind[] = [
  {
    kind: 'rqt_console',
    title: 'Console',
    group: 'Logging',
    about: 'What nodes log',
    make: async (connection, host) => new (await import('./console')).Console(connection, host),
  },
  {
    kind: 'rqt_logger_level',
    title: 'Logger Level',
    group: 'Logging',
    make: async (connection, host) =>
      new (await import('./logger_level')).LoggerLevel(connection, host),
  },
  {
    kind: 'rqt_bag',
    title: 'Bag',
    group: 'Logging',
    about: 'Records and plays bags',
    make: async (connection, host) => new (await import('./bag')).Bag(connection, host),
  },
];

const OTHERS: readonly PanelKind[] = [
  {
    kind: 'rqt_graph',
    title: 'Node Graph',
    group: 'Introspection',
    about: 'Who publishes to whom',
    make: async (connection, host) =>
      new (await import('./node_graph')).NodeGraph(connection, host),
  },
  {
    kind: 'rqt_top',
    title: 'Nodes',
    group: 'Introspection',
    aliases: ['rqt_node'],
    about: 'What a node publishes and serves, and its process',
    make: async (connection, host) => new (await import('./nodes')).Nodes(connection, host),
  },
  {
    kind: 'rqt_reconfigure',
    title: 'Dynamic Reconfigure',
    group: 'Configuration',
    about: 'Parameters of running nodes',
    make: async (connection, host) =>
      new (await import('./reconfigure')).Reconfigure(connection, host),
  },
  {
    kind: 'rqt_param',
    title: 'Parameters',
    group: 'Configuration',
    about: 'The ROS 1 parameter store',
    make: async (connection, host) =>
      new (await import('./parameters')).Parameters(connection, host),
  },
  {
    kind: 'moveit_setup_assistant',
    title: 'Setup Assistant',
    group: 'Robot Tools',
    aliases: ['setup_assistant'],
    about: 'Makes a MoveIt config package for a robot',
    make: async (connection, host) =>
      new (await import('../setup_assistant/panel')).SetupAssistantPanel(connection, host),
  },
  {
    kind: 'rqt_robot_steering',
    title: 'Robot Steering',
    group: 'Robot Tools',
    about: 'Velocity commands from sliders, a pad and keys',
    aliases: ['teleop_twist_keyboard'],
    make: async (connection, host) =>
      new (await import('./drive')).Drive('Robot Steering', connection, host),
  },
];

/** Makes all kinds known. */
export function registerAll(): void {
  for (const group of [
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
