/** A line below the top bar while the server is away, or when it has become another. */

import type { Connection } from '../connection';
import { button, h } from '../widgets/dom';

const PATIENCE_MS = 400;

/** Shows the state of the connection. */
export function watchConnection(root: HTMLElement, connection: Connection): void {
  let late = 0;
  connection.onState((state) => {
    clearTimeout(late);
    if (state === 'open') root.replaceChildren();
    else late = window.setTimeout(() => showLost(root, state === 'lost'), PATIENCE_MS);
  });
  connection.onHello((hello, previous) => {
    if (previous && previous.version !== hello.version) showOther(root, hello.version);
  });
}

function showLost(root: HTMLElement, lost: boolean): void {
  const text = lost
    ? 'The server does not answer. The page goes on as soon as it is back.'
    : 'Connecting to the server …';
  root.replaceChildren(h('div', { class: 'banner' }, text));
}

function showOther(root: HTMLElement, version: string): void {
  root.replaceChildren(
    h(
      'div',
      { class: 'banner' },
      `The server is now version ${version}. `,
      button('Reload the page', () => location.reload()),
    ),
  );
}
