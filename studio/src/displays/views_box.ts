/** Views: the camera's type and numbers, as RViz's panel of this name. */
import { h, select, setText } from '../widgets/dom';
import { VIEW_KINDS, type ViewKind, type ViewState } from '../scene/cameras';
import type { Frames } from '../scene/frames';
import type { View } from '../scene/view';
import { matrixOf } from '../model/assembly';
import type { Pose } from '../model/pose';
import { nameInput } from '../widgets/name_input';

type Field = 'distance' | 'yaw' | 'pitch' | 'scale' | 'angle' | 'x' | 'y' | 'z';
const FIELDS: Record<ViewKind, readonly Field[]> = {
  Orbit: ['distance', 'yaw', 'pitch', 'x', 'y', 'z'],
  ThirdPersonFollower: ['distance', 'yaw', 'pitch', 'x', 'y', 'z'],
  FPS: ['yaw', 'pitch', 'x', 'y', 'z'],
  TopDownOrtho: ['scale', 'angle', 'x', 'y'],
};
const NAMES: Record<Field, string> = {
  distance: 'Distance',
  yaw: 'Yaw',
  pitch: 'Pitch',
  scale: 'Scale',
  angle: 'Angle',
  x: 'Focal Point X',
  y: 'Focal Point Y',
  z: 'Focal Point Z',
};

const FIXED = '<Fixed Frame>';

/** The box with the numbers of one view's camera. */
export class ViewsBox {
  readonly element = h('div', { class: 'views-box' });
  private readonly stop: () => void;
  private readonly inputs = new Map<Field, HTMLInputElement>();
  private kind: ViewKind | null = null;
  private target = '';

  constructor(
    private readonly view: View,
    private readonly frames: Frames,
  ) {
    this.stop = view.afterDraw(() => this.refresh());
    this.refresh();
  }

  dispose(): void {
    this.stop();
  }

  private refresh(): void {
    const { state } = this.view.rig;
    if (state.kind !== this.kind) this.build(state.kind);
    this.inputs.forEach((input, field) => {
      const value = read(state, field).toFixed(3);
      if (document.activeElement !== input && input.value !== value) input.value = value;
    });
  }

  private build(kind: ViewKind): void {
    this.kind = kind;
    this.inputs.clear();
    const type = select('Type', Object.entries(VIEW_KINDS), kind, (next) =>
      this.view.rig.setKind(next as ViewKind),
    );
    const target = nameInput({
      label: 'Target Frame',
      placeholder: FIXED,
      value: this.target,
      names: () => [FIXED, ...this.frames.infos.map((info) => info.name)],
      chosen: (name) => this.follow(name),
    });
    this.element.replaceChildren(
      this.row('Type', type),
      this.row('Target Frame', target),
      ...FIELDS[kind].map((field) => {
        const input = h('input', { type: 'number', step: 'any', 'aria-label': NAMES[field] });
        input.addEventListener('change', () => this.write(field, Number(input.value)));
        this.inputs.set(field, input);
        return this.row(NAMES[field], input);
      }),
    );
  }

  /** RViz's Target Frame: the view goes along with a frame. */
  private follow(name: string): void {
    this.target = name === FIXED ? '' : name;
    this.view.rig.follow(
      this.target
        ? () => {
            const at = this.frames.at(this.target);
            return at < 0 ? null : matrixOf([...this.frames.poses.subarray(at, at + 7)] as Pose);
          }
        : null,
    );
  }

  private row(name: string, control: HTMLElement): HTMLElement {
    const words = h('span', { class: 'property-name' });
    setText(words, name);
    return h(
      'div',
      { class: 'property-row' },
      words,
      h('span', { class: 'property-value' }, control),
    );
  }

  private write(field: Field, value: number): void {
    if (!Number.isFinite(value)) return;
    const axis = 'xyz'.indexOf(field);
    if (axis < 0) return this.view.rig.set({ [field]: value });
    const focal = [...this.view.rig.state.focal] as [number, number, number];
    focal[axis] = value;
    this.view.rig.set({ focal });
  }
}

function read(state: ViewState, field: Field): number {
  const axis = 'xyz'.indexOf(field);
  return axis < 0 ? (state[field as 'yaw'] as number) : state.focal[axis];
}
