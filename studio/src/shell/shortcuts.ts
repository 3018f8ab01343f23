/** Keys that work anywhere outside of text fields. */

import type { Dock } from './dock';
import { openDialog, shortcutList } from './dialog';
import { switchTheme } from './theme';
import type { WorldControls } from './world_controls';

const ROWS = [
  ['Space', 'Play or pause the simulation'],
  ['.', 'Step'],
  ['Ctrl+R', 'Reset world'],
  ['Ctrl+Shift+R', 'Reset model poses'],
  ['P', 'Open a panel'],
  ['M', 'Maximize the panel, or restore it'],
  ['Alt+W', 'Close the panel'],
  ['L', 'Light or dark'],
  ['F6', 'Next group of panels'],
  ['F1', 'Help on the panel'],
  ['?', 'This list'],
] as const;

/** Shows the list of shortcuts. */
export function help(): void {
  openDialog('Keyboard shortcuts', shortcutList(ROWS));
}

/** Listens for the keys. A panel that handles a key stops it from coming here. */
export function listenForKeys(dock: Dock, world: WorldControls, panels: HTMLButtonElement): void {
  document.addEventListener('keydown', (event) => {
    if (event.defaultPrevented || inField(event.target)) return;
    const run = actionFor(event, dock, world, panels);
    if (!run) return;
    event.preventDefault();
    run();
  });
}

function inField(target: EventTarget | null): boolean {
  if (!(target instanceof HTMLElement)) return false;
  return (
    target.closest(
      'input:not([type=checkbox]):not([type=range]), textarea, select, dialog, [data-keys]',
    ) !== null
  );
}

function actionFor(
  event: KeyboardEvent,
  dock: Dock,
  world: WorldControls,
  panels: HTMLButtonElement,
): (() => void) | null {
  const key = event.key.toLowerCase();
  if (event.ctrlKey && key === 'r' && world.present)
    return () => world.reset(event.shiftKey ? 'poses' : 'world');
  if (key === 'f1') return () => dock.helpOnActive();
  if (event.altKey && key === 'w') return () => dock.closeActive();
  if (event.ctrlKey || event.altKey || event.metaKey) return null;
  const onButton =
    event.target instanceof HTMLElement &&
    event.target.closest('button, a, summary, [role=tab]') !== null;
  if (key === ' ' && world.present && !onButton) return () => world.togglePlay();
  if (key === '.' && world.present) return () => world.step();
  if (key === 'p') return () => panels.click();
  if (key === 'm') return () => dock.maximizeActive();
  if (key === 'l') return switchTheme;
  if (key === '?') return help;
  return null;
}
