/** Step Write Package: the files, which of them are new, changed or were edited, and writing. */
import type { AssistantFile, AssistantValue, AssistantWritten } from '../generated/messages';
import { button, h, type Child } from '../widgets/dom';
import { Step } from './step';

const STATES: Record<string, string> = {
  new: 'new',
  same: 'as it is',
  changed: 'changed',
  edited: 'edited by somebody: kept unless it is ticked',
};

/** Writes the package. */
export class WriteStep extends Step {
  readonly name = 'Write Package';
  readonly about = 'What will be written. Files that somebody edited since are kept.';
  private files: AssistantFile[] = [];
  private readonly overwrite = new Set<string>();
  private result: AssistantWritten | null = null;
  private asked = '';

  protected content(value: AssistantValue): (Child & Node)[] {
    const key = JSON.stringify([value, this.result?.written.length]);
    if (key !== this.asked) {
      this.asked = key;
      void this.look();
    }
    const parts: (Child & Node)[] = [
      h('p', { class: 'mono' }, value.folder),
      h(
        'table',
        { class: 'assistant-table', 'aria-label': 'Files of the package' },
        h(
          'thead',
          {},
          h('tr', {}, h('th', { scope: 'col' }, 'File'), h('th', { scope: 'col' }, 'State')),
        ),
        h('tbody', {}, ...this.files.map((file) => this.row(file))),
      ),
      h(
        'div',
        { class: 'assistant-actions' },
        button('Write package', () => void this.write(), { icon: 'save', class: 'primary' }),
      ),
    ];
    if (this.result) parts.push(this.told(this.result));
    return parts;
  }

  private row(file: AssistantFile): HTMLElement {
    const state = h('td', { class: 'dim' }, STATES[file.state] ?? file.state);
    if (file.state === 'edited') {
      const box = h('input', { type: 'checkbox', 'aria-label': `Overwrite ${file.path}` });
      box.checked = this.overwrite.has(file.path);
      box.addEventListener('change', () => {
        if (box.checked) this.overwrite.add(file.path);
        else this.overwrite.delete(file.path);
      });
      state.prepend(box, ' ');
    }
    return h('tr', { 'data-state': file.state }, h('td', { class: 'mono' }, file.path), state);
  }

  private told(result: AssistantWritten): HTMLElement {
    const files = result.written.length === 1 ? '1 file' : `${result.written.length} files`;
    const kept = result.kept.length ? ` Kept as edited: ${result.kept.join(', ')}.` : '';
    return h(
      'div',
      { role: 'status', class: 'assistant-written' },
      h('p', {}, `${files} written.${kept} What to type next:`),
      h('pre', {}, result.next.join('\n')),
    );
  }

  private async look(): Promise<void> {
    const { session } = this.host;
    if (!session.value) return;
    const answer = await session.ask('setup_assistant.files', { session: session.value.session });
    if (answer === null) return;
    this.files = answer as unknown as AssistantFile[];
    this.refresh();
  }

  private async write(): Promise<void> {
    const { session } = this.host;
    if (!session.value) return;
    const answer = await session.ask('setup_assistant.write', {
      session: session.value.session,
      overwrite: [...this.overwrite],
    });
    if (answer === null) return;
    this.result = answer as unknown as AssistantWritten;
    this.overwrite.clear();
    this.asked = '';
    this.host.say(`${session.value.package_name} is written.`);
    this.refresh();
  }
}
