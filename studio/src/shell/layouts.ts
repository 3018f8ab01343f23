/** The layouts that commands open with, by the command's name. */

import { findPanel } from '../panel';
import type { Place } from './dock';

const GAZEBO: readonly Place[] = [
  { kind: 'gazebo' },
  { kind: 'entities', beside: 'gazebo', direction: 'left', width: 270 },
  { kind: 'inspector', beside: 'entities', direction: 'below' },
  { kind: 'joints-force', beside: 'inspector', direction: 'within' },
  { kind: 'insert', beside: 'entities', direction: 'within' },
];

const RVIZ: readonly Place[] = [
  { kind: 'rviz' },
  { kind: 'displays', beside: 'rviz', direction: 'left', width: 310 },
];

const STUDIO: readonly Place[] = [
  ...GAZEBO,
  { kind: 'displays', beside: 'gazebo', direction: 'right', width: 300 },
  { kind: 'rqt_topic', beside: 'gazebo', direction: 'below', height: 260 },
  { kind: 'rqt_console', beside: 'rqt_topic', direction: 'within' },
  { kind: 'rqt_graph', beside: 'rqt_topic', direction: 'within' },
];

const WITHOUT_WORLD: readonly Place[] = [
  { kind: 'rqt_graph' },
  { kind: 'rqt_topic', beside: 'rqt_graph', direction: 'below', height: 320 },
  { kind: 'rqt_console', beside: 'rqt_topic', direction: 'right' },
];

/** While nothing runs. */
export const IDLE: readonly Place[] = [{ kind: 'start' }];

const BY_COMMAND: Readonly<Record<string, readonly Place[]>> = {
  gzclient: GAZEBO,
  gazebo: GAZEBO,
  scene: GAZEBO,
  rviz: RVIZ,
  rviz2: RVIZ,
  studio: STUDIO,
  graph: WITHOUT_WORLD,
  rqt_gui: WITHOUT_WORLD,
  notebook: [{ kind: 'gazebo' }],
};

/** Names a person can choose from the layout menu. */
export const NAMED_LAYOUTS = [
  ['studio', 'Everything'],
  ['gzclient', 'Gazebo'],
  ['rviz', 'RViz'],
  ['graph', 'Graph and topics'],
] as const;

/** The places for one command: its own layout, or its panel alone. */
export function placesFor(command: string): readonly Place[] {
  return BY_COMMAND[command] ?? [{ kind: command }];
}

/** The panels that belong to a command's own: RViz's list of displays. */
export function companionsOf(command: string): readonly Place[] {
  return (BY_COMMAND[command] ?? []).slice(1);
}

/**
 * The places for all commands that asked for a panel. The first command that has a layout of its
 * own gives the frame; the panels of the others go into tabs at its right, their trees beside them
 * where the page is roomy, else into the tabs of the frame's tree.
 */
export function placesForAll(commands: readonly string[], isRoomy: boolean): readonly Place[] {
  if (commands.length === 0) return STUDIO;
  const framed = commands.find((command) => command in BY_COMMAND) ?? commands[0];
  const places = [...placesFor(framed)];
  const anchor = places[0].kind;
  let last: string | null = null;
  for (const command of commands) {
    const kind = findPanel(command)?.kind;
    if (command === framed || !kind || places.some((place) => findPanel(place.kind)?.kind === kind))
      continue;
    places.push(
      last
        ? { kind, beside: last, direction: 'within' }
        : { kind, beside: anchor, direction: 'right', width: 480 },
    );
    last = kind;
    for (const each of companionsOf(command)) {
      if (places.some((place) => place.kind === each.kind)) continue;
      places.push(
        isRoomy || !places.some((place) => place.kind === 'entities')
          ? each
          : { kind: each.kind, beside: 'entities', direction: 'within' },
      );
    }
  }
  return places;
}
