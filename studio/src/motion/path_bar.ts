/** The planned path's animation: play, scrub, loop, trail, speed. */
import { button, checkbox, h, icon, select, setText } from '../widgets/dom';
import { DISPLAY_TIMES } from './player';
import type { MotionStore } from './store';

const STEPS = 1000;

/** One row; it follows the store's player. */
export class PathBar {
  readonly element: HTMLElement;
  private readonly slider = h('input', {
    type: 'range',
    class: 'timeline',
    min: 0,
    max: STEPS,
    step: 1,
    'aria-label': 'Place in the planned path',
  });
  private readonly play: HTMLButtonElement;
  private readonly words = h('output', { class: 'mono motion-time' });
  private readonly speed: HTMLSelectElement;
  private readonly switches: Record<'loop' | 'trail', HTMLInputElement>;

  constructor(private readonly store: MotionStore) {
    const { player } = store;
    this.slider.addEventListener('input', () => {
      player.seek((Number(this.slider.value) / STEPS) * player.duration_s);
      store.tell('play');
    });
    this.play = button(
      '',
      () => {
        if (player.playing) player.seek(player.time_s);
        else player.play();
        store.tell('play');
      },
      { icon: 'play', title: 'Play the planned path' },
    );
    this.speed = select(
      'State Display Time',
      DISPLAY_TIMES.map((word) => [word, word] as const),
      player.displayTime,
      (word) => {
        player.setDisplayTime(word);
        store.tell('play');
      },
    );
    const flip = (name: 'loop' | 'trail', text: string, about: string): HTMLLabelElement =>
      checkbox(
        text,
        player[name],
        (on) => {
          player[name] = on;
          store.tell('path');
        },
        about,
      );
    const labels = {
      loop: flip('loop', 'Loop', 'Begin again at the end'),
      trail: flip('trail', 'Trail', 'Show all states of the path'),
    };
    this.switches = {
      loop: labels.loop.querySelector('input') as HTMLInputElement,
      trail: labels.trail.querySelector('input') as HTMLInputElement,
    };
    this.element = h(
      'div',
      { class: 'motion-path', role: 'group', 'aria-label': 'Planned path' },
      this.play,
      this.slider,
      this.words,
      this.speed,
      labels.loop,
      labels.trail,
    );
    this.refresh();
  }

  /** Show where the animation is. */
  refresh(): void {
    const { player } = this.store;
    const there = player.path !== null;
    this.slider.disabled = this.play.disabled = !there;
    this.slider.value = String(
      player.duration_s ? Math.round((player.time_s / player.duration_s) * STEPS) : 0,
    );
    const text = there
      ? `${player.time_s.toFixed(2)} / ${player.duration_s.toFixed(2)} s`
      : 'no path';
    setText(this.words, text);
    this.slider.setAttribute('aria-valuetext', text);
    const name = player.playing ? 'Pause' : 'Play the planned path';
    if (this.play.title !== name) {
      this.play.title = name;
      this.play.setAttribute('aria-label', name);
      this.play.replaceChildren(icon(player.playing ? 'pause' : 'play'));
    }
    if (![...this.speed.options].some((option) => option.value === player.displayTime)) {
      this.speed.append(h('option', { value: player.displayTime }, player.displayTime));
    }
    this.speed.value = player.displayTime;
    for (const name of ['loop', 'trail'] as const) this.switches[name].checked = player[name];
  }
}
