/** Sliders for the numbers of a message, as Easy Message Publisher shows them. */

import type { TypeField } from '../generated/messages';
import { isObject, type Json, type JsonObject } from '../json';
import { h } from './dom';
import { MessageForm } from './message_form';

const FLOATS = /^(float(32|64)?|double)$/;
const INTEGERS = /^(u?int(8|16|32|64)|byte|char|octet)$/;

/** A message form whose number fields have sliders with limits that a person can change. */
export class SliderForm {
  readonly element = h('div', { class: 'slider-form' });
  private readonly form: MessageForm;
  private readonly limits = new Map<string, [number, number]>();
  private readonly syncs: (() => void)[] = [];

  constructor(
    fields: readonly TypeField[],
    ranges: Json,
    private readonly changed: () => void,
  ) {
    this.form = new MessageForm(fields, { expressions: true, changed });
    this.element.append(this.form.element);
    for (const [path, field] of numbersOf(fields)) this.addSlider(path, field, ranges);
  }

  message(): JsonObject {
    return this.form.message();
  }

  expressions(): Record<string, string> {
    return this.form.expressions();
  }

  texts(): Record<string, string> {
    return this.form.texts();
  }

  /** The sliders' limits by path. */
  ranges(): JsonObject {
    return Object.fromEntries([...this.limits].map(([path, limits]) => [path, [...limits]]));
  }

  fill(texts: Json | undefined): void {
    this.form.fill(texts);
    for (const sync of this.syncs) sync();
  }

  private addSlider(path: string, field: TypeField, ranges: Json): void {
    const input = this.form.element.querySelector<HTMLInputElement>(
      `input[aria-label="${CSS.escape(path)}"]`,
    );
    if (!input) return;
    const whole = INTEGERS.test(field.type);
    const [low, high] = rangeFor(path, ranges, whole);
    this.limits.set(path, [low, high]);
    const slider = h('input', {
      type: 'range',
      min: low,
      max: high,
      step: whole ? 1 : (high - low) / 1000,
      value: Number(input.value) || 0,
      'aria-label': `${path} slider`,
    });
    slider.addEventListener('input', () => {
      input.value = slider.value;
      this.changed();
    });
    const sync = () => {
      if (Number.isFinite(Number(input.value))) slider.value = input.value;
    };
    input.addEventListener('input', sync);
    this.syncs.push(sync);
    input.before(this.bound(path, 0, slider), slider, this.bound(path, 1, slider));
    input.parentElement?.classList.add('with-slider');
  }

  private bound(path: string, end: 0 | 1, slider: HTMLInputElement): HTMLInputElement {
    const limits = this.limits.get(path) ?? [-1, 1];
    const input = h('input', {
      type: 'number',
      step: 'any',
      class: 'bound',
      value: limits[end],
      'aria-label': `${path} ${end ? 'maximum' : 'minimum'}`,
    });
    input.addEventListener('change', () => {
      limits[end] = Number(input.value);
      slider.min = String(limits[0]);
      slider.max = String(limits[1]);
      this.changed();
    });
    return input;
  }
}

function rangeFor(path: string, ranges: Json, whole: boolean): [number, number] {
  const kept = isObject(ranges) ? ranges[path] : null;
  if (Array.isArray(kept) && typeof kept[0] === 'number' && typeof kept[1] === 'number')
    return [kept[0], kept[1]];
  return whole ? [0, 100] : [-1, 1];
}

function* numbersOf(fields: readonly TypeField[], parent = ''): Generator<[string, TypeField]> {
  for (const field of fields) {
    const path = parent ? `${parent}.${field.name}` : field.name;
    if (field.array !== null) continue;
    if (field.fields) yield* numbersOf(field.fields, path);
    else if (FLOATS.test(field.type) || INTEGERS.test(field.type)) yield [path, field];
  }
}
