/** Play, pause, step, reset and the clocks of a running world; hidden while there is none. */

import type { Channel } from '../channel';
import type { Connection } from '../connection';
import type { WorldStats } from '../generated/messages';
import { isObject, type Json, type JsonObject } from '../json';
import { button, h, icon, perFrame, setText } from '../widgets/dom';
import { clock } from '../widgets/format';
import { openMenu } from '../widgets/menu';
import type { Toasts } from './toasts';

const LOOK_AGAIN_MS = 2000;

/** The controls of the world in the top bar. */
export class WorldControls {
  readonly element: HTMLElement;
  private readonly play: HTMLButtonElement;
  private readonly steps = h('input', {
    type: 'number',
    class: 'steps',
    min: 1,
    value: 1,
    'aria-label': 'Steps',
    title: 'How many steps',
  });
  private readonly wanted = h('input', {
    type: 'number',
    class: 'wanted',
    min: 0,
    step: 0.1,
    'aria-label': 'Wanted real-time factor',
    title: 'Wanted real-time factor; 0 is as fast as it goes',
  });
  private readonly rtf = h('output', { class: 'figure', 'aria-label': 'Real-time factor' });
  private readonly sim = h('output', { class: 'figure', 'aria-label': 'Simulation time' });
  private readonly real = h('output', { class: 'figure', 'aria-label': 'Real time' });
  private stats: WorldStats | null = null;
  private channel: Channel | null = null;
  private readonly draw = perFrame(() => this.render());

  constructor(
    private readonly connection: Connection,
    private readonly toasts: Toasts,
  ) {
    this.play = button('', () => this.togglePlay(), {
      icon: 'play',
      title: 'Play (Space)',
      class: 'primary',
    });
    const reset = button('Reset', () => this.openReset(reset), {
      icon: 'reset',
      title: 'Reset the world, the model poses or the time',
    });
    reset.setAttribute('aria-haspopup', 'menu');
    this.wanted.addEventListener('change', () =>
      this.send('world.factor', { wanted_rtf: Number(this.wanted.value) }),
    );
    this.element = h(
      'div',
      { class: 'world', role: 'toolbar', 'aria-label': 'Simulation', hidden: true },
      this.play,
      h(
        'span',
        { class: 'joined' },
        button('', () => this.step(), { icon: 'step', title: 'Step ( . )' }),
        this.steps,
      ),
      reset,
      h('span', { class: 'rule' }),
      figure('RTF', this.rtf),
      h('label', { class: 'figure-label' }, 'wanted ', this.wanted),
      figure('Sim', this.sim),
      figure('Real', this.real),
    );
    this.watch();
  }

  /** Whether there is a world. */
  get present(): boolean {
    return this.stats !== null;
  }

  /** Pauses what runs, runs what is paused. */
  togglePlay(): void {
    this.send(this.stats?.paused ? 'world.play' : 'world.pause');
  }

  /** Goes on by the steps in the field. */
  step(): void {
    this.send('world.step', { count: Math.max(1, Math.round(Number(this.steps.value) || 1)) });
  }

  /** Resets `world`, `poses` or `time`. */
  reset(what: string): void {
    this.send('world.reset', { what });
  }

  private openReset(anchor: HTMLElement): void {
    openMenu(
      anchor,
      [
        { text: 'Reset world', note: 'Ctrl+R', run: () => this.reset('world') },
        { text: 'Reset model poses', note: 'Ctrl+Shift+R', run: () => this.reset('poses') },
        { text: 'Reset time', run: () => this.reset('time') },
      ],
      'Reset',
    );
  }

  private send(method: string, params: JsonObject = {}): void {
    this.connection.call(method, params).catch((problem: unknown) => this.toasts.fail(problem));
  }

  private watch(): void {
    this.channel = this.connection.open(
      'world.stats',
      {},
      {
        onData: (value) => this.take(value),
        onFailed: () => this.lookAgain(),
        onEnded: () => this.lookAgain(),
      },
    );
  }

  private lookAgain(): void {
    this.take(null);
    this.channel?.close();
    setTimeout(() => this.watch(), LOOK_AGAIN_MS);
  }

  private take(value: Json): void {
    this.stats = isObject(value) ? (value as unknown as WorldStats) : null;
    this.draw();
  }

  private render(): void {
    const stats = this.stats;
    this.element.hidden = stats === null;
    if (!stats) return;
    const wanted = stats.paused ? 'play' : 'pause';
    if (this.play.dataset.shows !== wanted) this.showPlay(wanted);
    setText(this.rtf, stats.paused ? 'paused' : stats.rtf.toFixed(2));
    setText(this.sim, clock(stats.sim_s));
    setText(this.real, clock(stats.real_s));
    if (document.activeElement !== this.wanted) this.wanted.value = String(stats.wanted_rtf ?? 0);
  }

  private showPlay(shows: 'play' | 'pause'): void {
    const title = shows === 'play' ? 'Play (Space)' : 'Pause (Space)';
    this.play.dataset.shows = shows;
    this.play.replaceChildren(icon(shows));
    this.play.title = title;
    this.play.setAttribute('aria-label', title);
  }
}

function figure(label: string, value: HTMLElement): HTMLElement {
  return h('span', { class: 'figure-label' }, `${label} `, value);
}
