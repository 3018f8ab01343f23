/** Numbers as people read them. */

/** A number in a few characters: 0.25, 1.3e-7, 12, NaN. */
export function short(value: number, digits = 6): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? 'NaN' : value > 0 ? 'inf' : '-inf';
  if (Number.isInteger(value) && Math.abs(value) < 1e15) return String(value);
  return String(Number(value.toPrecision(digits)));
}

/** Bytes per second with the unit that fits. */
export function bandwidth(bytes: number | null | undefined): string {
  if (bytes === null || bytes === undefined) return '';
  if (bytes < 1000) return `${bytes.toFixed(0)} B/s`;
  if (bytes < 1e6) return `${(bytes / 1e3).toFixed(1)} kB/s`;
  return `${(bytes / 1e6).toFixed(2)} MB/s`;
}

/** A rate in hertz. */
export function rate(hz: number | null | undefined): string {
  if (hz === null || hz === undefined || !Number.isFinite(hz)) return '';
  return hz >= 100 ? hz.toFixed(0) : hz.toFixed(2);
}

/** Seconds as minutes and hours once they are many. */
export function clock(seconds: number): string {
  if (!Number.isFinite(seconds)) return '–';
  const [digits, rest] = Math.abs(seconds).toFixed(3).split('.');
  const whole = Number(digits);
  const two = (value: number) => String(value).padStart(2, '0');
  const sign = seconds < 0 ? '-' : '';
  return `${sign}${two(Math.floor(whole / 3600))}:${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}.${rest}`;
}

/** A field of CSV, quoted where it must be. */
export function csvField(value: string | number): string {
  const text = String(value);
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}
