import { beforeAll, expect, test } from 'vitest';
import { registerPanel } from '../../src/panel';
import { companionsOf, placesFor, placesForAll } from '../../src/shell/layouts';

beforeAll(() => {
  for (const kind of ['gazebo', 'rviz', 'rqt_plot', 'displays', 'entities', 'rqt_console'])
    registerPanel({ kind, title: kind, group: 'Topics', make: () => Promise.reject() });
});

function kinds(commands: string[], isRoomy = true): string[] {
  return placesForAll(commands, isRoomy).map((place) => place.kind);
}

test('a command without a layout of its own has its panel alone', () => {
  expect(placesFor('rqt_plot')).toEqual([{ kind: 'rqt_plot' }]);
  expect(companionsOf('rviz2').map((place) => place.kind)).toEqual(['displays']);
});

test('the first command with a layout gives the frame, wherever it stands', () => {
  expect(kinds(['rqt_plot', 'gzclient'])[0]).toBe('gazebo');
  expect(kinds(['rqt_plot', 'gzclient'])).toContain('rqt_plot');
});

test('panels of later commands share one place of tabs', () => {
  const places = placesForAll(['gzclient', 'rqt_plot', 'rqt_console'], true);
  const [plot, log] = ['rqt_plot', 'rqt_console'].map((kind) =>
    places.find((place) => place.kind === kind),
  );
  expect(plot).toMatchObject({ beside: 'gazebo', direction: 'right' });
  expect(log).toMatchObject({ beside: 'rqt_plot', direction: 'within' });
});

test('where it is narrow, the list of displays is a tab of the tree', () => {
  const place = placesForAll(['gzclient', 'rviz'], false).find((each) => each.kind === 'displays');
  expect(place).toEqual({ kind: 'displays', beside: 'entities', direction: 'within' });
});

test('no command opens everything, the same one twice opens one panel', () => {
  expect(kinds([])).toContain('rqt_graph');
  expect(kinds(['rqt_plot', 'rqt_plot'])).toEqual(['rqt_plot']);
});
