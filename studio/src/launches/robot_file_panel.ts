/** A robot, model or world of files that were dropped, by itself, with what is wrong in them. */

import type * as THREE from 'three';
import { asCallError } from '../errors';
import type { RobotFile } from '../generated/messages';
import { isObject, textOf, type JsonObject } from '../json';
import { Assembly } from '../model/assembly';
import { MODES, type Mode } from '../model/view_modes';
import { BasePanel } from '../panels/base';
import { FirstLook } from '../scene/first_look';
import { gridLines } from '../scene/grid';
import { Pointer } from '../scene/pointer';
import { View } from '../scene/view';
import { fillSelect, h, notice, select, setText, spacer, toggle, toolbar } from '../widgets/dom';
import { upload } from './dropped_files';
import { findingCard } from './finding_card';
import { inWords } from './findings_store';
import { acceptDrops, RobotDrop } from './robot_drop';

const LOOKS: readonly Mode[] = ['collisions', 'inertias', 'frames', 'joints'];

/** Shows a robot file as `gazelle view` does, to be turned with the mouse. */
export class RobotFilePanel extends BasePanel {
  readonly title = 'Robot File';
  private set = '';
  private file = '';
  private asked = 0;
  private firstLook: FirstLook | null = null;
  private readonly looks: readonly HTMLElement[];
  private readonly view: View;
  private readonly assembly: Assembly;
  private readonly files = select('File', [], '', (file) => {
    this.file = file;
    this.host.touched();
    void this.read();
  });
  private readonly said = h('span', { class: 'dim', role: 'status' });
  private readonly findings = h('div', { class: 'scroll findings-list robot-findings' });
  private readonly stage = h('div', { class: 'scene-stage' });
  private readonly empty = h('div', { class: 'robot-empty' });

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.view = new View(this.stage);
    this.view.canvas.setAttribute(
      'aria-label',
      'Robot file: 3D view. Arrow keys turn, plus and minus zoom.',
    );
    this.assembly = new Assembly((moved) => (moved ? this.view.moved() : this.view.invalidate()));
    this.view.scene.add(this.assembly.root);
    const colour: [number, number, number] = [0.45, 0.46, 0.48];
    this.view.scene.add(
      gridLines({ cells: 20, size_m: 0.5, colour, alpha: 0.5, plane: 'XY', axes: true }),
    );
    new Pointer(this.view, 'rviz', {
      tool: () => ({ name: 'Move Camera', key: '', about: '' }),
      menu: () => undefined,
      key: () => false,
    });
    this.looks = LOOKS.map((mode) =>
      toggle(MODES[mode], false, (on) => this.assembly.setMode(mode, on)),
    );
    this.empty.append(new RobotDrop(this.connection, this.host).element);
    this.element.classList.add('robot-file');
    this.element.append(
      toolbar('Robot file', this.files, ...this.looks, spacer(), this.said),
      h('div', { class: 'robot-body' }, this.stage, this.empty),
      this.findings,
    );
    acceptDrops(this.element, (files) => void this.takeDrop(files));
    this.show(null);
  }

  override open(params: JsonObject): void {
    const set = textOf(params, 'set');
    if (!set || (set === this.set && this.file)) return;
    this.set = set;
    this.file = textOf(params, 'file');
    void this.read();
  }

  override state(): JsonObject {
    return { set: this.set, file: this.file };
  }

  override shown(visible: boolean): void {
    super.shown(visible);
    this.view.show(visible);
  }

  override dispose(): void {
    super.dispose();
    this.firstLook?.end();
    this.view.dispose();
  }

  private async takeDrop(
    files: ReturnType<typeof import('./dropped_files').filesOf>,
  ): Promise<void> {
    try {
      const given = await files;
      if (given.length === 0) return;
      const set = await upload(this.connection, given, (part) =>
        setText(this.said, `Reading: ${Math.round(part * 100)} %`),
      );
      this.open({ set });
    } catch (problem) {
      this.host.fail(problem, 'The files cannot be shown');
    }
  }

  private async read(): Promise<void> {
    const ask = ++this.asked;
    setText(this.said, 'Reading …');
    try {
      const file: JsonObject = this.file ? { file: this.file } : {};
      const value = await this.connection.call('robot_file.read', { set: this.set, ...file });
      if (ask === this.asked && isObject(value)) this.show(value as unknown as RobotFile);
    } catch (problem) {
      if (ask !== this.asked) return;
      const { message, hint } = asCallError(problem);
      this.show(null);
      this.findings.replaceChildren(notice([message, hint].filter(Boolean).join(': ')));
      this.findings.hidden = false;
    }
  }

  private show(value: RobotFile | null): void {
    const scene = value?.scene ?? null;
    this.stage.hidden = !scene;
    this.empty.hidden = value !== null;
    for (const each of this.looks) each.hidden = !scene;
    this.files.hidden = !value || value.files.length < 2;
    const wrong = (value?.findings ?? []).filter((each) => each.severity !== 'info');
    const count = (severity: string): number =>
      wrong.filter((each) => each.severity === severity).length;
    const words = inWords(count('error'), count('warning'));
    setText(this.said, [value?.counts, words].filter(Boolean).join('; '));
    this.findings.hidden = wrong.length === 0;
    this.findings.classList.toggle('alone', !scene);
    this.findings.replaceChildren(
      ...wrong.map((each) => findingCard(each, (text) => this.host.tell(text))),
    );
    this.assembly.set(scene);
    if (!value) return;
    this.file = value.file;
    fillSelect(this.files, value.files, value.file);
    this.host.setTitle(value.file.split('/').pop() ?? value.file);
    this.frame();
  }

  private frame(): void {
    this.firstLook?.end();
    this.firstLook = new FirstLook(this.view, this.assembly);
    this.firstLook.at(() => this.robotBox());
  }

  /** Grounds and walls of a world are not what one looks at. */
  private robotBox(): THREE.Box3 {
    const models = this.assembly.value?.models ?? [];
    const loose = models.filter((model) => !model.static);
    const shown = loose.length > 0 ? loose : models;
    return this.assembly.worldBox(shown.flatMap((model) => this.assembly.nodes(model.name)));
  }
}
