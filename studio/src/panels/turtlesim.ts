/** The turtlesim window, with turtle_teleop_key's keys. */

import { bytes, type Frame } from '../binary_frame';
import type { Channel } from '../channel';
import { textOf, type JsonObject } from '../json';
import { button, h, notice, setText, spacer, toolbar } from '../widgets/dom';
import { BasePanel } from './base';

const LINEAR = 2;
const ANGULAR = 2;
const KEYS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowUp: [LINEAR, 0],
  ArrowDown: [-LINEAR, 0],
  ArrowLeft: [0, ANGULAR],
  ArrowRight: [0, -ANGULAR],
};

/** TurtleSim. */
export class Turtlesim extends BasePanel {
  readonly title = 'TurtleSim';
  private node = '/turtlesim';
  private turtle = '/turtle1';
  private channel: Channel | null = null;
  private readonly canvas = h('canvas', { class: 'picture', width: 500, height: 500, role: 'img' });
  private readonly stage = h(
    'div',
    {
      class: 'stage fit',
      tabindex: 0,
      'data-keys': 'turtle',
      'aria-label': 'TurtleSim: drive with the arrow keys',
    },
    this.canvas,
  );
  private readonly empty = notice('Waiting for turtlesim.');
  private readonly who = h('span', { class: 'dim' });

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.element.classList.add('image');
    this.canvas.setAttribute('aria-label', 'Turtles');
    this.element.append(
      toolbar(
        'TurtleSim',
        button('Clear', () => void this.call('/clear'), { icon: 'clear' }),
        button('Reset', () => void this.call('/reset'), { icon: 'reset' }),
        spacer(),
        this.who,
      ),
      h('div', { class: 'stage-box' }, this.stage, this.empty),
    );
    this.stage.addEventListener('keydown', (event) => this.key(event));
    this.stage.addEventListener('pointerdown', () => this.stage.focus());
  }

  override open(params: JsonObject): void {
    this.node = textOf(params, 'node', this.node);
    this.turtle = textOf(params, 'turtle', this.turtle);
    setText(this.who, `Arrow keys drive ${this.turtle}`);
    if (this.channel) this.endStream(this.channel);
    this.channel = this.stream(
      'turtles',
      { node: this.node },
      { onFrame: (frame) => this.draw(frame) },
    );
  }

  override state(): JsonObject {
    return { node: this.node, turtle: this.turtle };
  }

  private async draw(frame: Frame): Promise<void> {
    const picture = await createImageBitmap(new Blob([bytes(frame)]));
    if (this.canvas.width !== picture.width) {
      this.canvas.width = picture.width;
      this.canvas.height = picture.height;
    }
    this.canvas.getContext('2d')?.drawImage(picture, 0, 0);
    picture.close();
    this.empty.hidden = true;
  }

  private async call(service: string): Promise<void> {
    await this.ask('service.call', { service, request: {} });
  }

  private key(event: KeyboardEvent): void {
    const command = KEYS[event.key];
    if (!command) return;
    event.preventDefault();
    event.stopPropagation();
    const message = {
      linear: { x: command[0], y: 0, z: 0 },
      angular: { x: 0, y: 0, z: command[1] },
    };
    void this.ask('topic.publish', {
      topic: `${this.turtle}/cmd_vel`,
      type: 'geometry_msgs/Twist',
      message,
    });
  }
}
