/** A recording as a page of one file: the world in three dimensions, time, topics and curves. */
import theme from '../styles/theme.css?inline';
import style from './replay.css?inline';
import { button, h, select, setText, toggle } from '../widgets/dom';
import type { Drawn } from './drawings';
import { Motion } from './motion';
import { Player } from './player';
import { Stage } from './stage';
import { TopicsPanel } from './topics_panel';
import { Recording } from './unpacking';

const STEP_S = 1;
const KINDS: Drawn['kind'][] = ['Scans', 'Maps', 'Paths', 'Trails'];
const KEYS =
  'Space plays and pauses, ← and → go a second back and on (with Shift a frame), Home and End to ' +
  'the ends, F frames the robots. Drag turns the view, Shift and drag moves it, the wheel zooms.';

/** What tests and other scripts of the page see. */
export interface Replay {
  player: Player;
  stage: Stage;
  topics: TopicsPanel;
}

/** Show a recording in an element. */
export function gazelleReplay(place: HTMLElement, buffer: ArrayBuffer): Replay {
  document.head.append(h('style', {}, `${theme}\n${style}`));
  const light = matchMedia('(prefers-color-scheme: light)');
  const wear = (): void => {
    document.documentElement.dataset.theme = light.matches ? 'light' : 'dark';
  };
  wear();
  const recording = new Recording(buffer);
  const { title, frames } = recording.head;
  const player = new Player(frames.duration_s);
  const host = h('div', { class: 'replay-scene' });
  const motion = new Motion(recording);
  const topics = new TopicsPanel(recording, motion, (time_s) => player.seek(time_s));
  const side = h('aside', { class: 'replay-side', 'aria-label': 'Topics' }, topics.element);
  side.hidden = topics.topics.length === 0;
  place.replaceChildren();
  place.className = 'replay';
  const head = h('header', { class: 'replay-head' });
  const foot = h('footer', { class: 'replay-foot' });
  place.append(head, host, side, foot);
  const stage = new Stage(host, recording, motion);
  head.append(h('h1', {}, title), ...sceneControls(stage, player, side));
  light.addEventListener('change', () => {
    wear();
    topics.plot.draw();
  });
  foot.append(...timeControls(player, frames.start_s));
  player.listen((time_s) => {
    stage.look(time_s);
    topics.look(time_s);
  });
  listenToKeys(player, stage, frames.period_s);
  player.seek(0);
  const made = { player, stage, topics };
  (globalThis as { shownReplay?: Replay }).shownReplay = made;
  return made;
}

function sceneControls(stage: Stage, player: Player, side: HTMLElement): HTMLElement[] {
  const follow = select(
    'Follow',
    [['', 'Free camera'], ...stage.models.map((name) => [name, `Follow ${name}`] as const)],
    stage.following,
    (name) => stage.follow(name),
  );
  stage.onBegun = () => {
    follow.value = stage.following;
  };
  const kinds = KINDS.filter((kind) => stage.drawn.some((one) => one.kind === kind)).map((kind) =>
    toggle(kind, true, (on) => stage.show(kind, on, player.time_s), {
      title: `Show ${kind.toLowerCase()}`,
    }),
  );
  const topics = toggle('Topics', !side.hidden, (on) => (side.hidden = !on), {
    title: 'Show topics and curves',
  });
  const other = button(
    '',
    () => {
      const { dataset } = document.documentElement;
      dataset.theme = dataset.theme === 'light' ? 'dark' : 'light';
      player.seek(player.time_s);
    },
    { icon: 'theme', title: 'Light or dark' },
  );
  const help = button('', () => (note.hidden = !note.hidden), { icon: 'help', title: 'Keys' });
  const note = h('p', { class: 'replay-help', role: 'note', hidden: true }, KEYS);
  const frame = button('', () => stage.fit(), { icon: 'fit', title: 'Frame the robots (F)' });
  return [follow, frame, ...kinds, topics, other, help, note];
}

function timeControls(player: Player, start_s: number): HTMLElement[] {
  const play = button('', () => player.toggle(), { icon: 'play', title: 'Play' });
  const pause = button('', () => player.toggle(), { icon: 'pause', title: 'Pause' });
  const slider = h('input', {
    type: 'range',
    class: 'replay-time',
    min: 0,
    max: player.duration_s || 1,
    step: 0.001,
    value: 0,
    'aria-label': 'Time',
    on: { input: () => player.seek(Number(slider.value)) },
  });
  const clock = h('output', { class: 'replay-clock' });
  const speed = select(
    'Speed',
    player.speeds.map((one) => [String(one), `${one}×`] as const),
    '1',
    (value) => (player.speed = Number(value)),
  );
  const whole = player.duration_s.toFixed(2);
  player.listen((time_s) => {
    play.hidden = player.playing;
    pause.hidden = !player.playing;
    slider.value = String(time_s);
    slider.setAttribute('aria-valuetext', `${time_s.toFixed(1)} of ${whole} seconds`);
    setText(clock, `${time_s.toFixed(2)} / ${whole} s`);
    clock.title = `simulated time ${(start_s + time_s).toFixed(3)} s`;
  });
  return [play, pause, slider, clock, speed];
}

/** Keys of the whole page; what is typed into a choice or a text is its own. */
function listenToKeys(player: Player, stage: Stage, frame_s: number): void {
  document.addEventListener(
    'keydown',
    (event) => {
      const { target, key } = event;
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      const inForm = target instanceof HTMLSelectElement || target instanceof HTMLButtonElement;
      const isBox = target instanceof HTMLInputElement && target.type === 'checkbox';
      if (
        key === ' ' &&
        !inForm &&
        !isBox &&
        !(target instanceof HTMLElement && target.closest('summary'))
      )
        player.toggle();
      else if (key === 'ArrowLeft' || key === 'ArrowRight') {
        if (target instanceof HTMLSelectElement) return;
        const step = event.shiftKey ? frame_s : STEP_S;
        player.seek(player.time_s + (key === 'ArrowLeft' ? -step : step));
      } else if (key === 'Home' && !inForm) player.seek(0);
      else if (key === 'End' && !inForm) player.seek(player.duration_s);
      else if (key.toLowerCase() === 'f' && !inForm) stage.fit();
      else return;
      event.preventDefault();
      event.stopPropagation();
    },
    { capture: true },
  );
}

(globalThis as { gazelleReplay?: typeof gazelleReplay }).gazelleReplay = gazelleReplay;
