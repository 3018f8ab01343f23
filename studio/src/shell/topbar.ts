/** The bar at the top: the world's controls, the panels, the layouts, the theme. */

import type { Connection } from '../connection';
import { allPanels, onPanelsChanged, PANEL_GROUPS } from '../panel';
import { findingsBadge } from '../launches/badge';
import { button, h, spacer } from '../widgets/dom';
import { openMenu, type MenuItem } from '../widgets/menu';
import type { Dock } from './dock';
import type { Layouts } from './layout_menu';
import { switchTheme } from './theme';
import type { WorldControls } from './world_controls';

/** Fills the bar; answers the button of the panels' menu. */
export function buildTopbar(
  root: HTMLElement,
  connection: Connection,
  dock: Dock,
  layouts: Layouts,
  world: WorldControls,
  help: () => void,
): HTMLButtonElement {
  const open = (): void => openMenu(panels, panelItems(dock), 'Panels', 3);
  const panels = button('Panels', open, { icon: 'panels', title: 'Open a panel (P)' });
  const layout = button('Layout', () => void layouts.openMenu(layout), {
    icon: 'layout',
    title: 'Save, load and reset layouts',
  });
  for (const each of [panels, layout]) each.setAttribute('aria-haspopup', 'menu');
  onPanelsChanged(() => {
    if (panels.getAttribute('aria-expanded') !== 'true') return;
    const chosen = document.activeElement?.textContent;
    // Once to close it, once to open it with what is new.
    open();
    open();
    for (const item of document.querySelectorAll<HTMLElement>('.menu [role^=menuitem]'))
      if (item.textContent === chosen) item.focus();
  });
  const light = h('span', { class: 'light', role: 'img' });
  connection.onState((state) => {
    light.dataset.state = state;
    const text = state === 'open' ? 'Connected' : state === 'lost' ? 'Not connected' : 'Connecting';
    light.setAttribute('aria-label', text);
    light.title = text;
  });
  root.replaceChildren(
    h('h1', {}, 'Gazelle'),
    panels,
    layout,
    world.element,
    spacer(),
    findingsBadge(connection, () => dock.show('findings')),
    button('', () => dock.show('start'), {
      icon: 'home',
      title: 'Start page: demos, last launches, robot files',
      class: 'ghost',
    }),
    button('', help, { icon: 'help', title: 'Keyboard shortcuts (?)', class: 'ghost' }),
    button('', switchTheme, { icon: 'theme', title: 'Light or dark', class: 'ghost' }),
    light,
  );
  return panels;
}

/** The panels by group, as in rqt's Plugins menu. */
function panelItems(dock: Dock): MenuItem[] {
  return PANEL_GROUPS.flatMap((group) => {
    const kinds = allPanels().filter((kind) => kind.group === group);
    if (kinds.length === 0) return [];
    const items = kinds.map(
      (kind): MenuItem => ({
        text: kind.title,
        note: kind.note ?? kind.kind,
        title: kind.about,
        faded: kind.faded,
        run: () => dock.show(kind.kind),
      }),
    );
    return [{ text: group, heading: true }, ...items];
  });
}
