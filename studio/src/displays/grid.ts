/** Grid and Axes: what needs no topic, only a frame. */
import { shared, axesGeometry } from '../model/geometry';
import { place } from '../model/shapes';
import { gridLines } from '../scene/grid';
import * as THREE from 'three';
import type { Drawing, Drawer, Site } from './display';
import { choice, colour, num, type PropertySpec } from './properties';

const FIXED = '<Fixed Frame>';
const FRAME: PropertySpec = {
  path: 'Reference Frame',
  kind: 'frame',
  value: FIXED,
  about: 'The frame this is drawn in.',
};

/** RViz's Grid. */
export const GRID: Drawing = {
  properties: [
    FRAME,
    num('Plane Cell Count', 10, 'Cells along each side.', { min: 1, max: 1000 }),
    num('Cell Size', 1, 'Size of a cell, metres.', { min: 0.001 }),
    colour('Color', '160; 160; 164', 'Colour of the lines.'),
    num('Alpha', 0.5, 'How opaque the lines are, 0 to 1.', { min: 0, max: 1 }),
    choice('Plane', 'XY', ['XY', 'XZ', 'YZ'], 'The plane the grid lies in.'),
  ],
  make(site) {
    const rebuild = (): void => {
      site.root.clear();
      site.root.add(
        gridLines({
          cells: Math.min(1000, site.props.num('Plane Cell Count')),
          size_m: site.props.num('Cell Size'),
          colour: site.props.colour('Color'),
          alpha: site.props.num('Alpha'),
          plane: site.props.text('Plane') as 'XY',
          axes: false,
        }),
      );
    };
    return framed(site, rebuild, () => ({ lines: 2 * (site.props.num('Plane Cell Count') + 1) }));
  },
};

/** RViz's Axes. */
export const AXES: Drawing = {
  properties: [
    FRAME,
    num('Length', 1, 'Length of each axis, metres.', { min: 0.001 }),
    num('Radius', 0.1, 'Radius of each axis, metres.', { min: 0.001 }),
    num('Alpha', 1, 'How opaque the axes are, 0 to 1.', { min: 0, max: 1 }),
  ],
  make(site) {
    const rebuild = (): void => {
      site.root.clear();
      const [length, radius, alpha] = ['Length', 'Radius', 'Alpha'].map((name) =>
        site.props.num(name),
      );
      const geometry = shared(`axes ${length} ${radius}`, () => axesGeometry(length, radius));
      const paint = new THREE.MeshPhongMaterial({
        vertexColors: true,
        opacity: alpha,
        transparent: alpha < 1,
      });
      site.root.add(new THREE.Mesh(geometry, paint));
    };
    return framed(site, rebuild, () => ({ axes: 1 }));
  },
};

/** A drawer that keeps its root at the Reference Frame. */
function framed(site: Site, rebuild: () => void, counts: () => Record<string, number>): Drawer {
  const follow = (): void => {
    const name = site.props.text('Reference Frame');
    if (name === FIXED || name === site.frames.fixed || !name) {
      place(site.root, [0, 0, 0, 0, 0, 0, 1]);
      site.status('Transform', 'ok', 'Transform OK');
      return;
    }
    const at = site.frames.at(name);
    if (at < 0)
      return site.status(
        'Transform',
        'error',
        `No transform from [${name}] to [${site.frames.fixed}]`,
      );
    place(site.root, site.frames.poses, at);
    site.status('Transform', 'ok', 'Transform OK');
    site.view.invalidate();
  };
  const stop = site.frames.onMoved(() => {
    if (site.props.text('Reference Frame') !== FIXED) follow();
  });
  return {
    changed: (path) => {
      if (path !== 'Reference Frame') rebuild();
      follow();
    },
    clear: () => undefined,
    dispose: stop,
    counts,
  };
}
