/** Step Self-Collisions: pairs of links that need no check, as a table or a matrix. */
import type { AssistantPair, AssistantValue } from '../generated/messages';
import { button, h, notice, select, toggle, type Child } from '../widgets/dom';
import { Step, field } from './step';

const REASONS = ['Adjacent', 'Default', 'Always', 'Never', 'User'] as const;
const MATRIX_LETTERS: Record<string, string> = {
  Adjacent: 'A',
  Default: 'D',
  Always: 'O',
  Never: 'N',
  User: 'U',
};

/** Finds the pairs, and lets a person change each. */
export class CollisionsStep extends Step {
  readonly name = 'Self-Collisions';
  readonly about =
    'Pairs of links that need no collision check: neighbours, those that overlap at the default positions or always, and those that never meet in many random configurations.';
  private trials = '10000';
  private shown = 'all';
  private filter = '';
  private asMatrix = false;
  private running = false;
  private readonly bar = h('progress', { max: 1, value: 0, 'aria-label': 'Search for pairs' });

  protected content(value: AssistantValue): (Child & Node)[] {
    const trials = h('input', {
      type: 'number',
      min: 1,
      max: 1_000_000,
      step: 1000,
      value: this.trials,
      'aria-label': 'Random configurations',
    });
    trials.addEventListener('change', () => {
      this.trials = trials.value;
    });
    const find = this.running
      ? button('Stop', () => this.host.session.stop())
      : button('Find pairs', () => void this.find(), { class: 'primary' });
    return [
      field('Random configurations', trials, find, this.running ? this.bar : null),
      h('p', { role: 'status', class: 'assistant-counts' }, counted(value.pairs)),
      this.choices(),
      this.asMatrix ? this.matrix(value.pairs) : this.table(value.pairs),
    ];
  }

  override left(): void {
    this.host.preview.mark(null);
  }

  private choices(): HTMLElement {
    const filter = h('input', {
      type: 'search',
      value: this.filter,
      placeholder: 'Link',
      'aria-label': 'Only links with this in their name',
    });
    filter.addEventListener('input', () => {
      this.filter = filter.value;
      this.refresh();
    });
    return h(
      'div',
      { class: 'assistant-actions' },
      select(
        'Pairs shown',
        [['all', 'All pairs'], ['', 'Checked'], ...REASONS.map((one) => [one, one] as const)],
        this.shown,
        (shown) => {
          this.shown = shown;
          this.refresh();
        },
      ),
      filter,
      toggle('Matrix', this.asMatrix, (on) => {
        this.asMatrix = on;
        this.refresh();
      }),
    );
  }

  private seen(pairs: readonly AssistantPair[]): AssistantPair[] {
    const word = this.filter.toLowerCase();
    return pairs.filter(
      ({ link1, link2, reason }) =>
        (this.shown === 'all' || reason === this.shown) &&
        `${link1} ${link2}`.toLowerCase().includes(word),
    );
  }

  private table(pairs: readonly AssistantPair[]): HTMLElement {
    const rows = this.seen(pairs);
    if (!rows.length) return notice('No pair is like that.');
    return h(
      'table',
      { class: 'assistant-table', 'aria-label': 'Pairs of links' },
      h('thead', {}, h('tr', {}, ...['Link', 'Link', 'Not checked', 'Why'].map(heading))),
      h('tbody', {}, ...rows.map((pair) => this.row(pair))),
    );
  }

  private row(pair: AssistantPair): HTMLElement {
    const box = h('input', {
      type: 'checkbox',
      'aria-label': `Do not check ${pair.link1} and ${pair.link2}`,
    });
    box.checked = pair.reason !== '';
    box.addEventListener('change', () => this.change(pair, box.checked ? 'User' : ''));
    const row = h(
      'tr',
      { 'data-reason': pair.reason },
      h('td', {}, pair.link1),
      h('td', {}, pair.link2),
      h('td', {}, box),
      h('td', { class: 'dim' }, pair.reason),
    );
    const mark = (): void => this.host.preview.mark([pair.link1, pair.link2]);
    row.addEventListener('pointerenter', mark);
    row.addEventListener('focusin', mark);
    return row;
  }

  private matrix(pairs: readonly AssistantPair[]): HTMLElement {
    const word = this.filter.toLowerCase();
    const links = [...new Set(pairs.flatMap((pair) => [pair.link1, pair.link2]))]
      .filter((link) => link.toLowerCase().includes(word))
      .sort();
    const known = new Map(pairs.map((pair) => [`${pair.link1} ${pair.link2}`, pair]));
    if (links.length < 2) return notice('Fewer than two links are like that.');
    const cell = (first: string, second: string): HTMLElement => {
      const [a, b] = [first, second].sort();
      const pair = known.get(`${a} ${b}`);
      if (!pair) return h('td', { class: 'assistant-self' });
      const label = `${a} and ${b}: ${pair.reason || 'checked'}`;
      return h(
        'td',
        { 'data-reason': pair.reason },
        button(
          MATRIX_LETTERS[pair.reason] ?? '',
          () => this.change(pair, pair.reason ? '' : 'User'),
          { title: label, class: 'assistant-cell' },
        ),
      );
    };
    const table = h(
      'table',
      { class: 'assistant-matrix', 'aria-label': 'Pairs of links as a matrix' },
      h('thead', {}, h('tr', {}, h('td', {}), ...links.map((link) => heading(link)))),
      h(
        'tbody',
        {},
        ...links.map((first) =>
          h('tr', {}, h('th', { scope: 'row' }, first), ...links.map((link) => cell(first, link))),
        ),
      ),
    );
    for (const made of table.querySelectorAll<HTMLButtonElement>('.assistant-cell'))
      made.setAttribute('aria-label', made.title);
    return h('div', { class: 'assistant-matrix-box' }, table);
  }

  private change(pair: AssistantPair, reason: string): void {
    const pairs = this.host.session.value?.pairs ?? [];
    const rows = pairs
      .map((one) =>
        one.link1 === pair.link1 && one.link2 === pair.link2 ? { ...one, reason } : one,
      )
      .filter((one) => one.reason);
    void this.host.session.edit('pairs', rows);
  }

  private async find(): Promise<void> {
    this.running = true;
    this.bar.value = 0;
    this.refresh();
    await this.host.session.findPairs(Math.max(1, Number(this.trials) || 10_000), (done) => {
      this.bar.value = done;
    });
    this.running = false;
    this.refresh();
  }
}

function heading(text: string): HTMLElement {
  return h('th', { scope: 'col' }, h('span', {}, text));
}

/** How many pairs there are of each reason. */
export function counted(pairs: readonly AssistantPair[]): string {
  const of = (reason: string): number => pairs.filter((pair) => pair.reason === reason).length;
  const told = REASONS.filter((reason) => of(reason)).map((reason) => `${of(reason)} ${reason}`);
  const off = pairs.length - of('');
  return `${off} of ${pairs.length} pairs are not checked${told.length ? `: ${told.join(', ')}` : ''}.`;
}
