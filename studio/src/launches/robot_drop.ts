/** The place where robot files are dropped or chosen. */

import type { Connection } from '../connection';
import type { PanelHost } from '../panel';
import { button, h, setText } from '../widgets/dom';
import { filesIn, filesOf, upload, type NamedFile } from './dropped_files';

/** A box that takes robot files, and shows them in a panel of their own. */
export class RobotDrop {
  readonly element: HTMLElement;
  private readonly state = h('p', { class: 'dim drop-state', role: 'status' });

  constructor(
    private readonly connection: Connection,
    private readonly host: PanelHost,
  ) {
    const files = chooser((input) => this.take(filesIn(input)), false);
    const folder = chooser((input) => this.take(filesIn(input)), true);
    this.element = h(
      'div',
      { class: 'robot-drop' },
      h('p', { class: 'drop-title' }, 'Drop a robot here: URDF, xacro or SDF'),
      h(
        'p',
        { class: 'dim' },
        'With its folder or package, or as a .zip, its meshes are shown too. Nothing is run.',
      ),
      h(
        'div',
        { class: 'drop-buttons' },
        button('Choose files', () => files.click(), { icon: 'plus' }),
        button('Choose a folder', () => folder.click(), { icon: 'plus' }),
      ),
      this.state,
      files,
      folder,
    );
    acceptDrops(this.element, (found) => this.take(found));
  }

  /** Brings files to the server and opens their panel. */
  take(files: Promise<NamedFile[]> | NamedFile[]): void {
    void this.show(files);
  }

  private async show(files: Promise<NamedFile[]> | NamedFile[]): Promise<void> {
    try {
      const given = await files;
      if (given.length === 0) return;
      const set = await upload(this.connection, given, (part) =>
        setText(this.state, `Reading the files: ${Math.round(part * 100)} %`),
      );
      this.host.show('robot_file', { set });
    } catch (problem) {
      this.host.fail(problem, 'The files cannot be shown');
    } finally {
      setText(this.state, '');
    }
  }
}

/** Lets an element take files that are dropped on it. */
export function acceptDrops(
  element: HTMLElement,
  take: (files: Promise<NamedFile[]>) => void,
): void {
  element.addEventListener('dragover', (event) => {
    event.preventDefault();
    element.classList.add('drop-here');
  });
  element.addEventListener('dragleave', (event) => {
    if (!element.contains(event.relatedTarget as Node | null))
      element.classList.remove('drop-here');
  });
  element.addEventListener('drop', (event) => {
    event.preventDefault();
    event.stopPropagation();
    element.classList.remove('drop-here');
    take(filesOf(event.dataTransfer));
  });
}

function chooser(chosen: (input: HTMLInputElement) => void, isFolder: boolean): HTMLInputElement {
  const input = h('input', {
    type: 'file',
    multiple: true,
    hidden: true,
    webkitdirectory: isFolder,
    'aria-label': isFolder ? 'A folder with a robot' : 'Robot files',
    on: {
      change: () => {
        chosen(input);
        input.value = '';
      },
    },
  });
  return input;
}
