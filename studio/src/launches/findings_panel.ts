/** Findings: what is wrong in the files of the launches of this graph, each with its line and fix. */

import type { LaunchValue } from '../generated/messages';
import type { JsonObject } from '../json';
import { BasePanel } from '../panels/base';
import { button, h, notice, setText, spacer, toggle, toolbar } from '../widgets/dom';
import { download } from '../widgets/download';
import { findingCard } from './finding_card';
import { asText, findingsStore, inWords, stateOf, type FindingsStore } from './findings_store';

/** The findings of launches. */
export class FindingsPanel extends BasePanel {
  readonly title = 'Findings';
  private readonly store: FindingsStore;
  private withNotes = false;
  private shownText = '';
  private readonly summary = h('span', { class: 'dim', role: 'status' });
  private readonly list = h('div', { class: 'scroll findings-list' });
  private readonly notes = toggle(
    'Notes',
    false,
    (on) => {
      this.withNotes = on;
      this.host.touched();
      this.draw();
    },
    { title: 'Show what works and is only said' },
  );

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.store = findingsStore(this.connection);
    this.element.classList.add('findings');
    this.element.append(
      toolbar(
        'Findings',
        this.summary,
        spacer(),
        this.notes,
        button('Text', () => this.save(), { icon: 'save', title: 'Save all findings as text' }),
      ),
      this.list,
    );
    this.atEnd(this.store.watch(() => this.draw()));
  }

  override open(params: JsonObject): void {
    this.withNotes = params.notes === true;
    this.notes.setAttribute('aria-pressed', String(this.withNotes));
    this.draw();
  }

  override state(): JsonObject {
    return { notes: this.withNotes };
  }

  private draw(): void {
    const text = JSON.stringify([this.store.launches, this.withNotes]);
    // What is read would lose its place.
    if (text === this.shownText) return;
    this.shownText = text;
    const { launches } = this.store;
    const words = inWords(this.store.count('error'), this.store.count('warning'));
    setText(this.summary, words || 'No errors and no warnings');
    if (launches.length === 0) {
      this.list.replaceChildren(
        notice('Nothing was launched on this graph yet. What a launch finds wrong stands here.'),
      );
      return;
    }
    this.list.replaceChildren(...launches.map((launch) => this.section(launch)));
  }

  private section(launch: LaunchValue): HTMLElement {
    const shown = launch.findings.filter((each) => this.withNotes || each.severity !== 'info');
    const hidden = launch.findings.length - shown.length;
    const nothing = hidden
      ? `Nothing is wrong; ${hidden === 1 ? 'a note is' : `${hidden} notes are`} hidden.`
      : 'It has found nothing wrong.';
    const when = new Date(launch.started_s * 1000).toLocaleTimeString();
    return h(
      'section',
      { class: 'findings-launch', 'aria-label': launch.command },
      h(
        'h3',
        {},
        h('span', { class: 'mono' }, launch.command),
        h('span', { class: 'dim' }, ` ${when}, ${stateOf(launch)}`),
      ),
      ...(shown.length
        ? shown.map((each) => findingCard(each, (text) => this.host.tell(text)))
        : [h('p', { class: 'dim' }, nothing)]),
    );
  }

  private save(): void {
    const parts = this.store.launches.flatMap((launch) => [
      `$ ${launch.command}`,
      ...launch.findings.map(asText),
      '',
    ]);
    download('findings.txt', parts.join('\n'), 'text/plain');
  }
}
