/** The panels of launches: where one begins, what is wrong, and a robot's file by itself. */

import '../styles/launches.css';
import type { PanelKind } from '../panel';

/** In the order of the menu; the code comes with the first panel of a kind. */
export const LAUNCHES: readonly PanelKind[] = [
  {
    kind: 'start',
    title: 'Start',
    group: 'Simulation',
    single: true,
    about: 'Demos, the last launches, and a robot file to look at',
    help: {
      what: 'Where the page begins while nothing runs.',
      first: 'Start a demo, copy one of your last commands into a terminal, or drop a robot file.',
      keys: [['Tab', 'From card to card']],
      docs: 'howto/studio/#where-to-begin',
    },
    make: async (connection, host) =>
      new (await import('./start_panel')).StartPanel(connection, host),
  },
  {
    kind: 'robot_file',
    title: 'Robot File',
    group: 'Visualization',
    about: 'A URDF, xacro or SDF file of yours, without a world',
    help: {
      what: 'What gazelle view draws, to be turned: a robot of files that were dropped on the page.',
      first:
        'Drop a URDF, xacro or SDF file, or the whole package for its meshes. What is wrong in it stands below, with line and fix.',
      keys: [
        ['Arrow keys', 'Turn the view; with Shift move it'],
        ['+ and -', 'Come nearer, go away'],
      ],
      docs: 'howto/studio/#where-to-begin',
    },
    make: async (connection, host) =>
      new (await import('./robot_file_panel')).RobotFilePanel(connection, host),
  },
  {
    kind: 'findings',
    title: 'Findings',
    group: 'Logging',
    single: true,
    about: 'What is wrong in the files of a launch, with line and fix',
    help: {
      what: "What gazelle doctor and the terminal say of a launch's files: place, line, why and fix.",
      first: 'Correct the file as Fix says, and start the launch again.',
      keys: [],
      docs: 'howto/studio/#what-is-wrong-in-a-launch',
    },
    make: async (connection, host) =>
      new (await import('./findings_panel')).FindingsPanel(connection, host),
  },
];
