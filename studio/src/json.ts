/** JSON values as they come over the WebSocket, and careful ways to read them. */

export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
export type JsonObject = { [key: string]: Json };

/** Whether a value is an object with names (neither null nor a list). */
export function isObject(value: unknown): value is JsonObject {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

/** The string under a name, or what stands in for it. */
export function textOf(object: JsonObject, name: string, otherwise = ''): string {
  const value = object[name];
  return typeof value === 'string' ? value : otherwise;
}

/** The number under a name, or what stands in for it. */
export function numberOf(object: JsonObject, name: string, otherwise = 0): number {
  const value = object[name];
  return typeof value === 'number' ? value : otherwise;
}

/** The strings of a list under a name. */
export function textsOf(object: JsonObject, name: string): string[] {
  const value = object[name];
  return Array.isArray(value)
    ? value.filter((item): item is string => typeof item === 'string')
    : [];
}
