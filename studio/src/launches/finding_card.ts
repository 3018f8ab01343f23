/** A finding about a user's file: place, source line with carets, why, fix. */

import type { LaunchFinding } from '../generated/messages';
import { button, h } from '../widgets/dom';
import { asText } from './findings_store';

const WORDS: Record<string, string> = { error: 'Error', warning: 'Warning', info: 'Note' };

/** One finding; `tell` hears that it was copied. */
export function findingCard(finding: LaunchFinding, tell: (text: string) => void): HTMLElement {
  const { severity, code, message, place, via, why, fix, phrase, link } = finding;
  const more = [
    via.length
      ? h('div', { class: 'finding-via' }, ...via.map((one) => h('div', {}, `from ${one}`)))
      : null,
    phrase ? h('p', { class: 'dim' }, `ROS or Gazebo says: ${phrase}`) : null,
  ];
  const copy = (): void =>
    void navigator.clipboard.writeText(asText(finding)).then(() => tell('The finding is copied.'));
  return h(
    'article',
    { class: 'finding', 'data-severity': severity },
    h(
      'header',
      { class: 'finding-head' },
      h('span', { class: 'finding-severity' }, WORDS[severity] ?? severity),
      place ? h('span', { class: 'finding-place mono' }, place) : null,
      button('', copy, { icon: 'copy', title: 'Copy this finding', class: 'ghost' }),
    ),
    h('p', { class: 'finding-message' }, message),
    sourceOf(finding),
    fix ? h('p', { class: 'finding-fix' }, h('strong', {}, 'Fix: '), fix) : null,
    why ? h('p', { class: 'finding-why' }, why) : null,
    ...more,
    code ? codeLine(code, link) : null,
  );
}

function sourceOf({ source }: LaunchFinding): HTMLElement | null {
  if (!source) return null;
  const at = source.column - 1;
  const line: (string | HTMLElement)[] = source.column
    ? [
        source.text.slice(0, at),
        h('mark', {}, source.text.slice(at, at + source.width) || ' '),
        source.text.slice(at + source.width),
      ]
    : [source.text];
  const carets = source.column ? `\n${' '.repeat(at)}${'^'.repeat(source.width)}` : '';
  return h(
    'pre',
    { class: 'finding-source', tabindex: 0, role: 'group', 'aria-label': `Line ${source.line}` },
    h('span', { class: 'finding-line' }, String(source.line)),
    h('code', {}, ...line, h('span', { class: 'carets', 'aria-hidden': 'true' }, carets)),
  );
}

function codeLine(code: string, link: string): HTMLElement {
  const shown = link
    ? h('a', { href: link, target: '_blank', rel: 'noopener noreferrer' }, `${code}: more about it`)
    : h('span', { class: 'mono' }, code);
  return h('p', { class: 'finding-code' }, shown);
}
