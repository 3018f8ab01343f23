/** RobotModel: a robot_description drawn at its tf frames. */
import { asCallError } from '../errors';
import { Assembly } from '../model/assembly';
import type { PageScene } from '../generated/messages';
import type { Surface } from '../model/materials';
import { place } from '../model/shapes';
import type { Drawing, Drawer, Site } from './display';
import { flag, num, text } from './properties';

const RETRY_MS = 2000;

/** RViz's RobotModel. */
export const ROBOT_MODEL: Drawing = {
  properties: [
    text('Robot Description', 'robot_description', 'The parameter with the URDF.'),
    text(
      'Description Topic',
      '/robot_description',
      'The topic with the URDF; used where it exists.',
    ),
    text('TF Prefix', '', 'Put before the names of the links to get those of the frames.'),
    flag('Visual Enabled', true, 'Whether the visuals are drawn.'),
    flag('Collision Enabled', false, 'Whether the collisions are drawn.'),
    num('Alpha', 1, 'How opaque the robot is, 0 to 1.', { min: 0, max: 1 }),
    flag('Mass Properties/Mass', false, 'Whether the centres of mass are drawn.'),
    flag('Mass Properties/Inertia', false, 'Whether boxes of equal inertia are drawn.'),
    flag('Links/All Links Enabled', true, 'All links on or off.'),
    flag('Links/Show Axes', false, 'Whether axes are drawn at every link.'),
    flag('Links/Show Joints', false, 'Whether the axes of the joints are drawn.'),
  ],
  make: (site) => new RobotDrawer(site),
};

/** RViz knows no ambient colours of Gazebo's materials. */
function plainAmbient(value: PageScene): PageScene {
  for (const shape of value.bodies.flatMap((body) => body.visuals)) {
    const parts =
      shape.geometry.type === 'mesh' ? shape.geometry.parts.map((part) => part.material) : [];
    for (const paint of [shape.material, ...parts]) delete (paint as Surface | null)?.ambient;
  }
  return value;
}

class RobotDrawer implements Drawer {
  private readonly assembly: Assembly;
  private readonly stops: (() => void)[];
  private frameNames: string[] = [];
  private timer = 0;
  private asked = 0;
  private source = '';

  constructor(private readonly site: Site) {
    this.assembly = new Assembly((moved) => (moved ? site.view.moved() : site.view.invalidate()));
    site.root.add(this.assembly.root);
    this.stops = [
      site.frames.onMoved(() => this.update()),
      site.graph.watch(() => this.source && this.source !== this.wanted().join() && this.load()),
    ];
  }

  changed(path: string): void {
    const { props } = this.site;
    if (['', 'Robot Description', 'Description Topic', 'TF Prefix'].includes(path))
      void this.load();
    if (path === 'Links/All Links Enabled') {
      this.assembly.bodies.forEach((node) =>
        props.set(`Links/${node.entity.link}`, props.flag(path)),
      );
    }
    this.assembly.setMode('collisions', props.flag('Collision Enabled'));
    this.assembly.setMode('com', props.flag('Mass Properties/Mass'));
    this.assembly.setMode('inertias', props.flag('Mass Properties/Inertia'));
    this.assembly.setMode('frames', props.flag('Links/Show Axes'));
    this.assembly.setMode('joints', props.flag('Links/Show Joints'));
    this.assembly.setMode('transparent', props.num('Alpha') < 0.99);
    this.showLinks();
  }

  clear(): void {
    void this.load();
  }

  shown(visible: boolean): void {
    if (visible) this.update();
  }

  dispose(): void {
    this.stops.forEach((stop) => stop());
    clearTimeout(this.timer);
    this.asked = -1;
    this.assembly.set(null);
  }

  counts(): Record<string, number> {
    const { bodies } = this.assembly;
    const placed = this.frameNames.filter((name) => this.site.frames.at(name) >= 0).length;
    const shapes = bodies.reduce((sum, node) => sum + node.shapes.length, 0);
    return { links: bodies.length, placed, shapes, collisions: this.assembly.count('collisions') };
  }

  /** Which method's parameters fetch the description: a topic where there is one. */
  private wanted(): [string, string] {
    const { props, graph } = this.site;
    const topic =
      props.text('Topic') ||
      props.text('Description Topic') ||
      props.text('Description Topic/Value');
    if (topic && graph.value.topics.some((each) => each.name === topic)) return ['topic', topic];
    return ['parameter', props.text('Robot Description')];
  }

  private async load(): Promise<void> {
    clearTimeout(this.timer);
    const ask = ++this.asked;
    const [what, name] = this.wanted();
    this.source = [what, name].join();
    const prefix = this.site.props.text('TF Prefix');
    try {
      const value = await this.site.connection.call('robot.get', {
        [what]: name,
        tf_prefix: prefix,
      });
      if (ask !== this.asked) return;
      this.adopt(value as unknown as PageScene, prefix);
    } catch (problem) {
      if (ask !== this.asked) return;
      const error = asCallError(problem);
      // Whoever describes the robot may be started later; that is no fault of anything here.
      const level = error.message.startsWith('there is no ') ? 'warn' : 'error';
      this.site.status('URDF', level, [error.message, error.hint].filter(Boolean).join(' '));
      this.timer = window.setTimeout(() => void this.load(), RETRY_MS);
    }
  }

  private adopt(value: PageScene, prefix: string): void {
    this.assembly.set(plainAmbient(value));
    const join = prefix ? `${prefix.replace(/^\/|\/$/g, '')}/` : '';
    this.frameNames = value.bodies.map((body) => join + body.link);
    for (const body of value.bodies)
      this.site.offer(flag(`Links/${body.link}`, true, `Whether ${body.link} is drawn.`));
    this.site.status('URDF', 'ok', 'URDF parsed OK');
    this.missing(value);
    const children = new Set(value.joints.map((each) => each.child));
    this.site.frames.setRobotRoot(this.frameNames.find((_, index) => !children.has(index)) ?? '');
    this.showLinks();
    this.update();
  }

  private missing(value: PageScene): void {
    const lost = value.bodies.flatMap((body) => body.visuals).map((shape) => shape.geometry);
    const first = lost.find((geometry) => geometry.type === 'missing');
    if (first?.type === 'missing')
      this.site.status(
        'Meshes',
        'error',
        `Could not load resource [${first.uri}]: ${first.reason}`,
      );
  }

  private showLinks(): void {
    const { props } = this.site;
    for (const node of this.assembly.bodies) {
      const spec = props.get(`Links/${node.entity.link}`);
      node.root.visible = spec !== false;
      node.visuals.visible = props.flag('Visual Enabled');
    }
    this.site.view.moved();
  }

  private update(): void {
    const { frames, root, status, view } = this.site;
    if (!root.visible || !this.frameNames.length) return;
    const lost: string[] = [];
    this.assembly.bodies.forEach((node, index) => {
      const at = frames.at(this.frameNames[index]);
      node.setLost(at < 0);
      if (at < 0) {
        lost.push(this.frameNames[index]);
        place(node.root, node.value.pose);
      } else place(node.root, frames.poses, at);
    });
    if (lost.length && frames.infos.length === 0)
      status(
        'Transform',
        'warn',
        'tf tells of no frame yet: the joints stand at zero. robot_state_publisher broadcasts the links.',
      );
    else if (lost.length)
      status(
        'Transform',
        'error',
        `No transform from [${lost.slice(0, 3).join(', ')}${lost.length > 3 ? ` and ${lost.length - 3} more` : ''}] to [${frames.fixed}]`,
      );
    else status('Transform', 'ok', 'Transform OK');
    view.moved();
  }
}
