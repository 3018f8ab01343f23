/** What the server tells of a node's parameters → groups of controls. */

import type { DynamicParameterRow, NodeParameter, Reconfigurable } from '../generated/messages';
import { isObject, textOf, type Json } from '../json';
import type { ParameterSpec } from '../widgets/value_control';

export interface ParameterGroup {
  name: string;
  parameters: ParameterSpec[];
}

/** Groups of `reconfigure.get`. */
export function readGroups(value: Json): ParameterGroup[] {
  const { groups } = value as unknown as Reconfigurable;
  return groups
    .map((group) => ({ name: group.name, parameters: group.parameters.map(dynamicSpec) }))
    .filter((group) => group.parameters.length > 0);
}

/** Rows of `node.params`, grouped by the part of the name before its first dot. */
export function readNodeParameters(value: Json): ParameterGroup[] {
  const groups = new Map<string, ParameterSpec[]>();
  for (const row of value as unknown as NodeParameter[]) {
    const { name } = row;
    const group = name.includes('.') ? name.slice(0, name.indexOf('.')) : '';
    groups.set(group, [...(groups.get(group) ?? []), nodeSpec(row)]);
  }
  return [...groups].map(([name, parameters]) => ({ name, parameters }));
}

function dynamicSpec({
  name,
  type,
  value,
  min,
  max,
  edit_method,
  description,
}: DynamicParameterRow): ParameterSpec {
  return {
    name,
    type,
    value,
    min: numberIn(min),
    max: numberIn(max),
    options: optionsIn(edit_method),
    about: description,
    readOnly: false,
  };
}

function nodeSpec({ name, type, value, descriptor: about }: NodeParameter): ParameterSpec {
  const range = isObject(about.range) ? about.range : {};
  return {
    name,
    type,
    value,
    min: numberIn(range.from_value),
    max: numberIn(range.to_value),
    step: numberIn(range.step),
    about: [about.description, about.constraints].filter(Boolean).join(' '),
    readOnly: about.read_only,
  };
}

function numberIn(value: Json | undefined): number | undefined {
  return typeof value === 'number' ? value : undefined;
}

function optionsIn(method: Json | undefined): ParameterSpec['options'] {
  if (!isObject(method) || !Array.isArray(method.enum)) return undefined;
  return method.enum.filter(isObject).map((each) => ({
    name: textOf(each, 'name'),
    value: each.value ?? null,
    about: textOf(each, 'description'),
  }));
}
