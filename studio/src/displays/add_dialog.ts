/** Add: a display by its type, or by a topic that somebody publishes. */
import type { Connection } from '../connection';
import { inOneLine } from '../errors';
import { shortType, type GraphStore } from '../graph_store';
import { button, h } from '../widgets/dom';
import { displayKinds, kindsFor, learnAdded } from './registry';

/** What was chosen. */
export interface Choice {
  className: string;
  topic: string;
}

interface Option extends Choice {
  text: string;
  note: string;
}

/** Ask which display to add; null when the person thinks better of it. */
export function askDisplay(graph: GraphStore, connection: Connection): Promise<Choice | null> {
  return new Promise((resolve) => {
    let chosen: Choice | null = null;
    const list = h('div', { class: 'add-list', role: 'listbox', 'aria-label': 'Displays' });
    const finish = (choice: Choice | null): void => {
      chosen = choice;
      dialog.close();
    };
    const tabs = h('div', { class: 'add-tabs', role: 'tablist' });
    let byTopic = false;
    let shown = '';
    const fill = (): void => {
      const options = byTopic ? byTopics(graph) : byTypes();
      const text = JSON.stringify(options);
      if (text === shown) return;
      shown = text;
      list.replaceChildren(...options.map((option) => row(option, finish)));
      if (!options.length)
        list.append(
          h('div', { class: 'notice' }, 'Nobody publishes anything that a display shows.'),
        );
    };
    const show = (topics: boolean): void => {
      byTopic = topics;
      fill();
      [...tabs.children].forEach((tab, index) =>
        tab.setAttribute('aria-selected', String(byTopic === (index === 1))),
      );
    };
    for (const [text, topics] of [
      ['By display type', false],
      ['By topic', true],
    ] as const) {
      const tab = button(text, () => show(topics));
      tab.setAttribute('role', 'tab');
      tabs.append(tab);
    }
    const dialog = h(
      'dialog',
      { class: 'dialog add-dialog', 'aria-label': 'Add a display' },
      h('h2', {}, 'Add a display'),
      tabs,
      list,
      h(
        'div',
        { class: 'dialog-buttons' },
        button('Cancel', () => finish(null)),
      ),
    );
    const unwatch = graph.watch(fill);
    learnAdded(connection)
      .catch((problem: unknown) => [inOneLine(problem)])
      .then((problems) => {
        fill();
        list.after(...problems.map((problem) => h('div', { class: 'notice' }, problem)));
      });
    dialog.addEventListener('close', () => {
      unwatch();
      dialog.remove();
      resolve(chosen);
    });
    document.body.append(dialog);
    show(false);
    dialog.showModal();
  });
}

function byTypes(): Option[] {
  return displayKinds().map((kind) => ({
    className: kind.name,
    topic: '',
    text: kind.name,
    note: kind.about,
  }));
}

function byTopics(graph: GraphStore): Option[] {
  return graph.value.topics
    .filter((topic) => !topic.hidden)
    .flatMap((topic) =>
      kindsFor(topic.type).map((kind) => ({
        className: kind.name,
        topic: topic.name,
        text: topic.name,
        note: `${kind.name} · ${shortType(topic.type)}`,
      })),
    );
}

function row(option: Option, finish: (choice: Choice) => void): HTMLElement {
  return h(
    'button',
    { type: 'button', class: 'add-row', role: 'option', on: { click: () => finish(option) } },
    h('span', {}, option.text),
    h('span', { class: 'menu-note' }, option.note),
  );
}
