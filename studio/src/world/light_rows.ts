/** The properties of a light. */
import type { LightValue } from '../generated/messages';
import { h } from '../widgets/dom';

/** Rows that change a light; `change` gets the values that are new. */
export function lightRows(
  light: LightValue,
  change: (values: Partial<LightValue>) => void,
): HTMLElement[] {
  const shadows = h('input', {
    type: 'checkbox',
    'aria-label': 'Cast shadows',
    on: { change: () => change({ cast_shadows: shadows.checked }) },
  });
  shadows.checked = light.cast_shadows;
  const place = numbers('Position (m)', light.pose.slice(0, 3), (values) =>
    change({ pose: [...values, ...light.pose.slice(3)] as LightValue['pose'] }),
  );
  const direction = numbers('Direction', light.direction, (values) =>
    change({ direction: values as LightValue['direction'] }),
  );
  const range = numbers('Range (m)', [light.range_m], ([value]) => change({ range_m: value }));
  return [
    row('Type', h('span', { class: 'inspector-value' }, light.type)),
    row(
      'Diffuse',
      colour('Diffuse', light.diffuse, (diffuse) => change({ diffuse })),
    ),
    row(
      'Specular',
      colour('Specular', light.specular, (specular) => change({ specular })),
    ),
    row('Position (m)', place),
    row('Direction', direction),
    ...(light.type === 'directional' ? [] : [row('Range (m)', range)]),
    row('Cast shadows', shadows),
  ];
}

function colour(label: string, rgb: number[], change: (rgb: number[]) => void): HTMLElement {
  const hex = `#${rgb
    .slice(0, 3)
    .map((value) =>
      Math.round(Math.max(0, Math.min(1, value)) * 255)
        .toString(16)
        .padStart(2, '0'),
    )
    .join('')}`;
  const input = h('input', { type: 'color', value: hex, 'aria-label': label });
  input.addEventListener('change', () =>
    change(
      [...[1, 3, 5].map((at) => parseInt(input.value.slice(at, at + 2), 16) / 255), 1].slice(
        0,
        Math.max(rgb.length, 3),
      ),
    ),
  );
  return input;
}

function numbers(label: string, values: number[], change: (values: number[]) => void): HTMLElement {
  const inputs = values.map((value, index) =>
    h('input', {
      type: 'number',
      step: 'any',
      value: String(value),
      'aria-label': values.length > 1 ? `${label} ${'xyz'[index]}` : label,
    }),
  );
  inputs.forEach((input) =>
    input.addEventListener('change', () => change(inputs.map((each) => Number(each.value)))),
  );
  return h('span', { class: 'triple' }, ...inputs);
}

function row(name: string, control: HTMLElement): HTMLElement {
  return h(
    'div',
    { class: 'property-row' },
    h('span', { class: 'property-name' }, name),
    h('span', { class: 'property-value' }, control),
  );
}
