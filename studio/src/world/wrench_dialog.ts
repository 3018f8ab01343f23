/** Apply Force/Torque: Gazebo's dialog. */
import type { ScenePanel } from '../scene/scene_panel';
import { button, h, select } from '../widgets/dom';

/** Ask for a force and a torque on a link and apply them. */
export function openWrenchDialog(panel: ScenePanel, model: string, link: string): void {
  const links = panel.assembly.nodes(model).map((node) => node.entity.link);
  const target = select('Link', links, link, () => undefined);
  const force = fields('Force', 'N', [10, 0, 0]);
  const torque = fields('Torque', 'N·m', [0, 0, 0]);
  const time = h('input', {
    type: 'number',
    step: 'any',
    min: 0,
    value: 1,
    'aria-label': 'Seconds',
  });
  const apply = (withForce: boolean, withTorque: boolean): void => {
    const body = panel.assembly.nodes(model, target.value)[0]?.value.name;
    if (!body) return;
    panel.world
      .call('world.wrench', {
        body,
        force: withForce ? force.values() : [0, 0, 0],
        torque: withTorque ? torque.values() : [0, 0, 0],
        seconds: Number(time.value),
      })
      .then(() => panel.say(`Applied to ${body}`), panel.fail);
  };
  const dialog = h(
    'dialog',
    { class: 'dialog', 'aria-label': `Apply Force/Torque: ${model}` },
    h('h2', {}, `Apply Force/Torque: ${model}`),
    h(
      'div',
      { class: 'form-grid' },
      h('span', {}, 'Link'),
      target,
      h('span', {}, 'Force (N)'),
      force.element,
      h('span', {}, 'Torque (N·m)'),
      torque.element,
      h('span', {}, 'Seconds'),
      time,
    ),
    h(
      'div',
      { class: 'dialog-buttons' },
      button('Apply Force', () => apply(true, false)),
      button('Apply Torque', () => apply(false, true)),
      button('Apply All', () => apply(true, true), { class: 'primary' }),
      button('Close', () => dialog.close()),
    ),
  );
  dialog.addEventListener('close', () => dialog.remove());
  document.body.append(dialog);
  dialog.show();
}

function fields(
  label: string,
  unit: string,
  values: number[],
): { element: HTMLElement; values(): number[] } {
  const inputs = ['x', 'y', 'z'].map((axis, index) =>
    h('input', {
      type: 'number',
      step: 'any',
      value: values[index],
      'aria-label': `${label} ${axis} (${unit})`,
    }),
  );
  return {
    element: h('span', { class: 'triple' }, ...inputs),
    values: () => inputs.map((input) => Number(input.value)),
  };
}
