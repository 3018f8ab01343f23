/** Light and dark: a data attribute of the page that the styles read. */

export type Theme = 'dark' | 'light';

const KEY = 'gazelle.theme';
const listeners = new Set<(theme: Theme) => void>();

/** The theme that shows. */
export function theme(): Theme {
  return document.documentElement.dataset.theme === 'light' ? 'light' : 'dark';
}

/** Takes up what the address asks for, else the person's last choice; dark at first. */
export function restoreTheme(): void {
  const asked = new URLSearchParams(location.search).get('theme');
  apply((asked ?? localStorage.getItem(KEY)) === 'light' ? 'light' : 'dark');
}

/** Shows the other theme and keeps the choice. */
export function switchTheme(): void {
  const next: Theme = theme() === 'dark' ? 'light' : 'dark';
  localStorage.setItem(KEY, next);
  apply(next);
}

/** Calls back when the theme changes; returns what ends it. */
export function onTheme(listener: (theme: Theme) => void): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

/** The value of one of the theme's CSS variables, for canvases. */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

function apply(next: Theme): void {
  document.documentElement.dataset.theme = next;
  for (const listener of listeners) listener(next);
}
