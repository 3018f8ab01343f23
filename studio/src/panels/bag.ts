/** Bag: recording topics, playing a bag with a timeline. */

import { BAG_FORMATS } from '../generated/bags';
import type { BagState, PlayerState, RecorderState } from '../generated/messages';
import { isObject, textOf, textsOf, type Json, type JsonObject } from '../json';
import {
  button,
  checkbox,
  h,
  icon,
  notice,
  select,
  setText,
  spacer,
  toolbar,
} from '../widgets/dom';
import { clock } from '../widgets/format';
import { BasePanel } from './base';
import { BagTimeline } from './bag_timeline';

const FACTORS = ['0.1', '0.25', '0.5', '1', '2', '5', '10'];

/** rqt_bag. */
export class Bag extends BasePanel {
  readonly title = 'Bag';
  private all = true;
  private format = 'bag';
  private recording = false;
  private playing = false;
  private opened = '';
  private readonly chosen = new Set<string>();
  private readonly path = h('input', {
    type: 'text',
    class: 'name',
    placeholder: 'record to (a name is made up when empty)',
    'aria-label': 'Record to',
  });
  private readonly playPath = h('input', {
    type: 'text',
    class: 'name',
    placeholder: '/path/to/recording.bag',
    'aria-label': 'Bag to open',
  });
  private readonly recordButton = button('Record', () => void this.record(), {
    icon: 'record',
    title: 'Record',
  });
  private readonly playButton = button('', () => void this.togglePlay(), {
    icon: 'play',
    title: 'Play',
  });
  private readonly recordState = h('span', { class: 'dim', role: 'status' });
  private readonly time = h('output', { class: 'mono', 'aria-label': 'Time in the bag' });
  private readonly topics = h('div', { class: 'bag-topics' });
  private readonly rows = h('div', { class: 'bag-rows' });
  private readonly timeline = new BagTimeline((time_s) => void this.ask('bag.seek', { time_s }));
  private readonly player = h('div', { class: 'bag-player', hidden: true });
  private readonly empty = notice('Open a bag to play it, or record topics into one.');

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.element.classList.add('bag');
    this.playPath.addEventListener('keydown', (event) => {
      if (event.key === 'Enter') void this.openBag();
    });
    this.player.append(
      toolbar(
        'Player',
        this.playButton,
        select(
          'Rate',
          FACTORS.map((each) => [each, `${each}×`] as const),
          '1',
          (factor) => void this.ask('bag.rate', { factor: Number(factor) }),
        ),
        this.time,
        spacer(),
        button('Close', () => void this.ask('bag.close'), {
          icon: 'close',
          title: 'Close the bag',
        }),
      ),
      this.timeline.element,
      this.rows,
    );
    this.element.append(
      toolbar(
        'Record',
        this.recordButton,
        this.path,
        select('Format', BAG_FORMATS, this.format, (format) => {
          this.format = format;
          this.host.touched();
        }),
        checkbox('All topics', true, (on) => {
          this.all = on;
          this.showTopics();
        }),
        spacer(),
        this.recordState,
      ),
      this.topics,
      toolbar(
        'Open',
        this.playPath,
        button('Open', () => void this.openBag(), { title: 'Open the bag' }),
      ),
      h('div', { class: 'scroll' }, this.player, this.empty),
    );
    this.atEnd(this.host.graph.watch(() => this.showTopics()));
    this.stream('bag', {}, { onData: (value) => this.take(value) });
  }

  override open(params: JsonObject): void {
    this.format = textOf(params, 'format', this.format);
    const path = textOf(params, 'path') || textsOf(params, 'args')[0];
    if (path) {
      this.playPath.value = path;
      void this.openBag();
    }
  }

  override state(): JsonObject {
    return { format: this.format };
  }

  private showTopics(): void {
    this.topics.hidden = this.all;
    if (this.all) return;
    const names = this.host.graph.value.topics
      .filter((topic) => !topic.hidden)
      .map((topic) => topic.name);
    this.topics.replaceChildren(
      ...names.map((name) =>
        checkbox(name, this.chosen.has(name), (on) => {
          if (on) this.chosen.add(name);
          else this.chosen.delete(name);
        }),
      ),
    );
  }

  private async record(): Promise<void> {
    if (this.recording) {
      const done = await this.ask('bag.record_stop');
      if (isObject(done) && textOf(done, 'path')) this.playPath.value = textOf(done, 'path');
      return;
    }
    if (!this.all && this.chosen.size === 0) {
      this.host.fail(new Error('No topic is ticked to be recorded.'));
      return;
    }
    const topics: JsonObject = this.all ? {} : { topics: [...this.chosen] };
    await this.ask('bag.record', { ...topics, path: this.path.value.trim(), format: this.format });
  }

  private async openBag(): Promise<void> {
    const path = this.playPath.value.trim();
    if (path) await this.ask('bag.open', { path });
  }

  private togglePlay(): Promise<Json> {
    return this.ask(this.playing ? 'bag.pause' : 'bag.play');
  }

  private take(value: Json): void {
    const { recorder, player } = value as unknown as BagState;
    this.showRecorder(recorder);
    this.showPlayer(player);
  }

  private showRecorder(state: RecorderState | null): void {
    this.recording = state !== null;
    this.recordButton.classList.toggle('recording', this.recording);
    setText(
      this.recordButton.querySelector('span') ?? this.recordButton,
      this.recording ? 'Stop' : 'Record',
    );
    this.recordButton.title = this.recording ? 'Stop recording' : 'Record';
    setText(
      this.recordState,
      state
        ? `${state.path}  ${clock(state.seconds)}  ${state.messages} messages  ${(state.bytes / 1e6).toFixed(1)} MB`
        : '',
    );
  }

  private showPlayer(state: PlayerState | null): void {
    this.player.hidden = state === null;
    this.empty.hidden = state !== null;
    if (!state) {
      this.opened = '';
      return;
    }
    const { playing, begin_s: begin } = state;
    if (playing !== this.playing || this.opened === '')
      this.playButton.replaceChildren(icon(playing ? 'pause' : 'play'));
    this.playing = playing;
    this.playButton.title = playing ? 'Pause' : 'Play';
    this.playButton.setAttribute('aria-label', this.playButton.title);
    setText(this.time, `${clock(state.time_s - begin)} of ${clock(state.end_s - begin)}`);
    this.timeline.show(begin, state.end_s, state.time_s);
    if (this.opened !== state.path) this.showRows(state);
  }

  private showRows(state: PlayerState): void {
    this.opened = state.path;
    this.playPath.value = this.opened;
    this.rows.replaceChildren(
      ...state.topics.map((topic) =>
        h(
          'div',
          { class: 'bag-row' },
          h('span', { class: 'ellipsis' }, topic.name),
          h('span', { class: 'dim ellipsis' }, topic.type),
          h('span', { class: 'number' }, String(topic.count)),
        ),
      ),
    );
  }
}
