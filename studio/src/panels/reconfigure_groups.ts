/** What the server tells of a node's parameters → groups of controls. */

import { isObject, textOf, type Json, type JsonObject } from '../json';
import type { ParameterSpec } from '../widgets/value_control';

export interface ParameterGroup { name: string; parameters: ParameterSpec[] }

/** Groups of `reconfigure.get`. */
export function readGroups(value: Json): ParameterGroup[] {
  if (!isObject(value) || !Array.isArray(value['groups'])) return [];
  return value['groups'].filter(isObject).map((group) => ({
    name: textOf(group, 'name'),
    parameters: Array.isArray(group['parameters']) ? group['parameters'].filter(isObject).map(dynamicSpec) : [],
  })).filter((group) => group.parameters.length > 0);
}

/** Rows of `node.params`, grouped by the part of the name before its first dot. */
export function readNodeParameters(value: Json): ParameterGroup[] {
  if (!Array.isArray(value)) return [];
  const groups = new Map<string, ParameterSpec[]>();
  for (const row of value.filter(isObject)) {
    const name = textOf(row, 'name');
    const group = name.includes('.') ? name.slice(0, name.indexOf('.')) : '';
    groups.set(group, [...(groups.get(group) ?? []), nodeSpec(row)]);
  }
  return [...groups].map(([name, parameters]) => ({ name, parameters }));
}

function dynamicSpec(row: JsonObject): ParameterSpec {
  return {
    name: textOf(row, 'name'), type: textOf(row, 'type'), value: row['value'] ?? null,
    min: numberIn(row['min']), max: numberIn(row['max']), options: optionsIn(row['edit_method']),
    about: textOf(row, 'description'), readOnly: false,
  };
}

function nodeSpec(row: JsonObject): ParameterSpec {
  const about = isObject(row['descriptor']) ? row['descriptor'] : {};
  const range = isObject(about['range']) ? about['range'] : {};
  return {
    name: textOf(row, 'name'), type: textOf(row, 'type'), value: row['value'] ?? null,
    min: numberIn(range['from_value']), max: numberIn(range['to_value']), step: numberIn(range['step']),
    about: [textOf(about, 'description'), textOf(about, 'constraints')].filter(Boolean).join(' '), readOnly: about['read_only'] === true,
  };
}

function numberIn(value: Json | undefined): number | undefined {
  return typeof value === 'number' ? value : undefined;
}

function optionsIn(method: Json | undefined): ParameterSpec['options'] {
  if (!isObject(method) || !Array.isArray(method['enum'])) return undefined;
  return method['enum'].filter(isObject).map((each) => ({ name: textOf(each, 'name'), value: each['value'] ?? null, about: textOf(each, 'description') }));
}
