/** Values that people type: numbers, truth values, lists and texts, as YAML reads them. */

import type { Json } from '../json';

/** Reads a typed value; what is nothing else is a text. */
export function valueFromText(text: string): Json {
  const plain = text.trim();
  if (/^(true|yes|on)$/i.test(plain)) return true;
  if (/^(false|no|off)$/i.test(plain)) return false;
  if (/^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$/.test(plain)) return Number(plain);
  if (/^[[{"]/.test(plain)) {
    try {
      return JSON.parse(plain) as Json;
    } catch {
      return plain;
    }
  }
  return plain;
}
