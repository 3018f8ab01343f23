/** The 3D scene and its side panels: Gazebo's and RViz's. */
import '../styles/scene.css';
import type { PanelKind } from '../panel';

/** In the order of the menu; the code comes with the first panel of a kind. */
export const SCENE: readonly PanelKind[] = [
  {
    kind: 'gazebo',
    title: 'Gazebo',
    group: 'Simulation',
    aliases: ['gzclient', 'scene', 'gz', 'ign'],
    about: 'The world in 3D',
    help: {
      what: "Gazebo's window: the world in 3D, as the simulator has it.",
      first: 'Press play (Space), click a model to select it, then Translate or Rotate it.',
      keys: [
        ['Arrow keys', 'Turn the view; with Shift move it'],
        ['+ and -', 'Come nearer, go away'],
        ['Esc', 'Back to selecting'],
        ['Delete', 'Remove the selected model'],
      ],
      docs: 'howto/studio/#in-the-world',
    },
    make: async (connection, host) =>
      new (await import('./scene_panel')).ScenePanel('gazebo', connection, host),
  },
  {
    kind: 'entities',
    title: 'World',
    group: 'Simulation',
    about: 'Models, links, joints and lights',
    help: {
      what: "Gazebo's World tab: models with their links and joints, lights, and physics.",
      first: 'Choose a model: it is selected in the view, and Properties tells about it.',
      keys: [
        ['Up, Down', 'Choose'],
        ['Right, Left', 'Unfold, fold'],
        ['Enter', 'Select in the view'],
        ['Delete', 'Remove the model'],
      ],
      docs: 'howto/studio/#in-the-world',
    },
    make: async (connection, host) =>
      new (await import('../world/entities_panel')).EntitiesPanel(connection, host),
  },
  {
    kind: 'inspector',
    title: 'Properties',
    group: 'Simulation',
    about: 'Pose and properties of what is selected',
    help: {
      what: "Gazebo's property list: pose, mass, friction, limits of what is selected.",
      first:
        'Select a model, a link or a light; values that have a field can be changed while the world runs.',
      keys: [['Enter', 'Take the value that was typed']],
      docs: 'howto/studio/#in-the-world',
    },
    make: async (connection, host) =>
      new (await import('../world/inspector_panel')).InspectorPanel(connection, host),
  },
  {
    kind: 'insert',
    title: 'Insert',
    group: 'Simulation',
    single: true,
    about: 'Models, shapes and files for the world',
    help: {
      what: "Gazebo's Insert tab: models, boxes, spheres, cylinders and files for the world.",
      first:
        'Choose a model: it is put where you look, ready to be moved. A robot file can be dropped on the view, too.',
      keys: [],
      docs: 'howto/studio/#in-the-world',
    },
    make: async (connection, host) =>
      new (await import('../world/insert_panel')).InsertPanel(connection, host),
  },
  {
    kind: 'joints-force',
    title: 'Joints',
    group: 'Simulation',
    about: 'Force, position and velocity of joints',
    help: {
      what: "Gazebo's Joints tab: a force, a position or a velocity for each joint.",
      first:
        'Choose a model with joints, then type a force or a target; Reset takes all commands back.',
      keys: [['Enter', 'Send the value that was typed']],
      docs: 'howto/studio/#in-the-world',
    },
    make: async (connection, host) =>
      new (await import('../world/joints_panel')).JointsPanel(connection, host),
  },
  {
    kind: 'rviz',
    title: 'RViz',
    group: 'Visualization',
    aliases: ['rviz2', 'rqt_rviz'],
    about: 'Displays of topics in 3D',
    help: {
      what: 'RViz: what topics carry, drawn in 3D.',
      first: 'Add displays in the panel Displays, and choose there in which frame all is drawn.',
      keys: [
        ['Arrow keys', 'Turn the view; with Shift move it'],
        ['+ and -', 'Come nearer, go away'],
        ['Esc', 'Back to the first tool'],
      ],
      docs: 'howto/studio/#navigating',
    },
    make: async (connection, host) =>
      new (await import('./scene_panel')).ScenePanel('rviz', connection, host),
  },
  {
    kind: 'displays',
    title: 'Displays',
    group: 'Visualization',
    about: 'What a 3D view shows',
    help: {
      what: "RViz's Displays: what the 3D view shows, each with its topic, its properties and its state.",
      first: 'Press Add and choose a topic. A red dot has its reason below the display.',
      keys: [
        ['Up, Down', 'Choose'],
        ['Right, Left', 'Unfold, fold'],
        ['Delete', 'Remove the display'],
      ],
      docs: 'howto/studio/',
    },
    make: async (connection, host) =>
      new (await import('../displays/displays_panel')).DisplaysPanel(connection, host),
  },
  {
    kind: 'navigation',
    title: 'Navigation',
    group: 'Visualization',
    aliases: ['nav2'],
    single: true,
    below: 'displays',
    about: "Goals, waypoints and Nav2's states: RViz's panel Navigation 2, for move_base too",
    help: {
      what: "RViz's panel Navigation 2, for Nav2 and move_base.",
      first: 'Choose 2D Nav Goal in the 3D view, press at the place and drag into the direction.',
      keys: [
        ['Up, Down', 'Choose a waypoint; with Alt move it'],
        ['Delete', 'Remove the waypoint'],
      ],
      docs: 'howto/studio/#navigating',
    },
    make: async (connection, host) =>
      new (await import('../navigation/panel')).NavigationPanel(connection, host),
  },
  {
    kind: 'motion_planning',
    title: 'MotionPlanning',
    group: 'Visualization',
    aliases: ['moveit'],
    single: true,
    about: 'Plans and executes motions of an arm with MoveIt',
    help: {
      what: "RViz's MotionPlanning: plans and executes motions of an arm with MoveIt.",
      first: 'Start move_group, choose a goal state, press Plan, then Execute.',
      keys: [['Left, Right', 'Change the tab']],
      docs: 'howto/planning/',
    },
    make: async (connection, host) =>
      new (await import('../motion/panel')).MotionPlanningPanel(connection, host),
  },
];
