/** Marker and MarkerArray. */
import type { MarkerFrame } from '../generated/messages';
import type { JsonObject } from '../json';
import type { Drawing, Drawer, Site } from './display';
import { MarkerSet } from './marker_set';
import { arrayMatrix } from './message_fields';
import { flag } from './properties';

/** RViz's Marker and MarkerArray; like RViz's it also understands arrays on `<topic>_array`. */
export const MARKERS: Drawing = {
  ownPose: true,
  properties: [],
  make: (site) => new MarkersDrawer(site),
};

class MarkersDrawer implements Drawer {
  private readonly set: MarkerSet;
  private readonly stop: () => void;

  constructor(private readonly site: Site) {
    const shows = (namespace: string): boolean =>
      site.props.get(`Namespaces/${namespace}`) !== false;
    this.set = new MarkerSet(site.root, () => site.view.invalidate(), shows);
    this.stop = site.view.beforeDraw((now) => {
      const wait = this.set.tick(now);
      if (wait < Infinity) site.view.wakeIn(Math.max(20, wait));
    });
  }

  take(value: JsonObject): void {
    const {
      message: { markers },
      poses,
    } = value as unknown as MarkerFrame;
    let problem: string | null = null;
    let lost = '';
    markers.forEach((marker, index) => {
      const base = arrayMatrix(poses[index]);
      const deletes = marker.action === 2 || marker.action === 3;
      if (base === null && !deletes) lost ||= marker.header.frame_id;
      else problem = this.set.take(marker, base ?? IDENTITY) ?? problem;
    });
    const { status, frames } = this.site;
    for (const name of this.set.namespaces())
      this.site.offer(flag(`Namespaces/${name}`, true, `The markers of ${name}.`));
    if (lost) status('Transform', 'error', `No transform from [${lost}] to [${frames.fixed}]`);
    else status('Transform', 'ok', 'Transform OK');
    if (problem) status('Markers', 'warn', problem);
    else status('Markers', 'ok', `${this.set.size} markers`);
  }

  changed(): void {
    this.set.refresh();
  }

  clear(): void {
    this.set.clear();
  }

  dispose(): void {
    this.stop();
    this.set.dispose();
  }

  counts(): Record<string, number> {
    return this.set.counts();
  }
}

const IDENTITY = arrayMatrix([0, 0, 0, 0, 0, 0, 1]) as NonNullable<ReturnType<typeof arrayMatrix>>;
