import { expect, test } from 'vitest';
import { allPanels, PANEL_GROUPS, type PanelKind } from '../../src/panel';
import { registerAll } from '../../src/panels/catalogue';

registerAll();
const kinds: readonly PanelKind[] = allPanels();

test.each(kinds.map((kind) => [kind.kind, kind] as const))('%s has a help', (_, kind) => {
  const { help } = kind;
  expect(help?.what).toMatch(/\.$/);
  expect(help?.first).toMatch(/\.$/);
  expect(help?.docs).toMatch(/^[a-z_]+\/([a-z_]+\/)?(#[a-z-]+)?$/);
});

test('every panel is in a group of the menu, under a name of its own', () => {
  expect(new Set(kinds.map((kind) => kind.kind)).size).toBe(kinds.length);
  for (const { group } of kinds) expect(PANEL_GROUPS).toContain(group);
});
