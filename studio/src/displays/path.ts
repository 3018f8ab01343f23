/** Path and Polygon: lines through points. */
import type * as THREE from 'three';
import type { Point, PoseStamped } from '../generated/messages';
import type { JsonObject } from '../json';
import type { Drawing, Drawer, Site } from './display';
import { strip, ThinLines, WideLines } from './lines';
import { list, part, poseMatrix, vector } from './message_fields';
import { choice, colour, num } from './properties';
import { PoseShapes, shapeProperties } from './instanced_shapes';

/** RViz's Path. */
export const PATH: Drawing = {
  properties: [
    choice('Line Style', 'Lines', ['Lines', 'Billboards'], 'Thin lines, or lines of a width.'),
    num('Line Width', 0.03, 'Width of Billboards, metres.', { min: 0.001 }),
    colour('Color', '25; 255; 0', 'Colour of the line.'),
    num('Alpha', 1, 'How opaque the line is, 0 to 1.', { min: 0, max: 1 }),
    choice('Pose Style', 'None', ['None', 'Axes', 'Arrows'], 'What is drawn at every pose.'),
    ...shapeProperties('Arrow', 'Pose ', true)
      .slice(1)
      .map((spec) => ({ ...spec, path: spec.path })),
  ],
  make: (site) => new PathDrawer(site),
};

class PathDrawer implements Drawer {
  private readonly thin: ThinLines;
  private readonly wide: WideLines;
  private readonly shapes: PoseShapes;
  private poses: PoseStamped[] = [];

  constructor(private readonly site: Site) {
    this.thin = new ThinLines(site.root);
    this.wide = new WideLines(site.root);
    this.shapes = new PoseShapes(site.root, site.props, 'Pose ');
  }

  take(value: JsonObject): void {
    this.poses = list(part(value, 'message'), 'poses');
    this.draw();
  }

  changed(): void {
    const { props } = this.site;
    this.thin.paint(props.colour('Color'), props.num('Alpha'));
    this.wide.paint(props.colour('Color'), props.num('Alpha'), props.num('Line Width'));
    this.shapes.restyle();
    this.draw();
  }

  clear(): void {
    this.poses = [];
    this.draw();
  }

  dispose(): void {
    this.thin.dispose();
    this.wide.dispose();
    this.shapes.dispose();
  }

  counts(): Record<string, number> {
    return { poses: this.poses.length, shapes: this.shapes.count };
  }

  private draw(): void {
    const points = strip(this.poses.map((each) => each.pose.position));
    const isWide = this.site.props.text('Line Style') === 'Billboards';
    this.thin.set(isWide ? [] : points);
    this.wide.set(isWide ? points : []);
    const style = this.site.props.text('Pose Style');
    this.site.props.set('Pose', style === 'Axes' ? 'Axes' : 'Arrow');
    const matrices = style === 'None' ? [] : this.poses.map((each) => poseMatrix(each.pose));
    this.shapes.set(matrices);
  }
}

/** RViz's Polygon. */
export const POLYGON: Drawing = {
  properties: [
    colour('Color', '25; 255; 0', 'Colour of the line.'),
    num('Alpha', 1, 'How opaque the line is, 0 to 1.', { min: 0, max: 1 }),
  ],
  make(site) {
    const lines = new ThinLines(site.root);
    let corners = 0;
    return {
      take(value) {
        const points = list<Point>(part(value, 'message', 'polygon'), 'points');
        corners = points.length;
        lines.set(
          strip(
            points.map((point) => vector(point as never) as THREE.Vector3),
            true,
          ),
        );
      },
      changed: () => lines.paint(site.props.colour('Color'), site.props.num('Alpha')),
      clear() {
        corners = 0;
        lines.set([]);
      },
      dispose: () => lines.dispose(),
      counts: () => ({ corners }),
    };
  },
};
