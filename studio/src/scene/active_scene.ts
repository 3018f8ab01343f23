/** The scene panels of the page, and which of them the side panels speak of. */
import type { ScenePanel } from './scene_panel';

const panels: ScenePanel[] = [];
const listeners = new Set<() => void>();

/** All scene panels; the last used one is the last. */
export function scenePanels(): readonly ScenePanel[] {
  return panels;
}

/** The one for a side panel: the last used, of a kind where there is one. */
export function activeScene(kind?: 'gazebo' | 'rviz'): ScenePanel | null {
  return panels.findLast((panel) => panel.kind === kind) ?? panels[panels.length - 1] ?? null;
}

/** A panel came or was used. */
export function useScene(panel: ScenePanel): void {
  if (panels[panels.length - 1] === panel) return;
  dropScene(panel, false);
  panels.push(panel);
  listeners.forEach((listener) => listener());
}

/** A panel went. */
export function dropScene(panel: ScenePanel, tell = true): void {
  const at = panels.indexOf(panel);
  if (at >= 0) panels.splice(at, 1);
  if (tell) listeners.forEach((listener) => listener());
}

/** Be told when another panel is used, and now. Returns what ends it. */
export function onActiveScene(listener: () => void): () => void {
  listeners.add(listener);
  listener();
  return () => listeners.delete(listener);
}
