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
    make: async (connection, host) =>
      new (await import('./scene_panel')).ScenePanel('gazebo', connection, host),
  },
  {
    kind: 'entities',
    title: 'World',
    group: 'Simulation',
    about: 'Models, links, joints and lights',
    make: async (connection, host) =>
      new (await import('../world/entities_panel')).EntitiesPanel(connection, host),
  },
  {
    kind: 'inspector',
    title: 'Properties',
    group: 'Simulation',
    about: 'Pose and properties of what is selected',
    make: async (connection, host) =>
      new (await import('../world/inspector_panel')).InspectorPanel(connection, host),
  },
  {
    kind: 'insert',
    title: 'Insert',
    group: 'Simulation',
    single: true,
    about: 'Models, shapes and files for the world',
    make: async (connection, host) =>
      new (await import('../world/insert_panel')).InsertPanel(connection, host),
  },
  {
    kind: 'joints-force',
    title: 'Joints',
    group: 'Simulation',
    about: 'Force, position and velocity of joints',
    make: async (connection, host) =>
      new (await import('../world/joints_panel')).JointsPanel(connection, host),
  },
  {
    kind: 'rviz',
    title: 'RViz',
    group: 'Visualization',
    aliases: ['rviz2', 'rqt_rviz'],
    about: 'Displays of topics in 3D',
    make: async (connection, host) =>
      new (await import('./scene_panel')).ScenePanel('rviz', connection, host),
  },
  {
    kind: 'displays',
    title: 'Displays',
    group: 'Visualization',
    about: 'What a 3D view shows',
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
    make: async (connection, host) =>
      new (await import('../motion/panel')).MotionPlanningPanel(connection, host),
  },
];
