/** Makes panels of the user's own known: those that the server lists, and those a layout remembers. */

import type { Connection } from '../connection';
import { isObject, textOf, type JsonObject } from '../json';
import { forgetPanel, PANEL_GROUPS, panelsChanged, registerFamily, registerPanel, type PanelGroup, type PanelKind } from '../panel';

const OWN = 'plugin:';
const FOREIGN = 'rqt-plugin:';

/** Registers what the server lists, now, at every connection and when the person comes back to the page. */
export function watchPlugins(connection: Connection): void {
  registerFamily(OWN, (kind) => ownKind(kind, { title: kind.slice(OWN.length).split('.').pop() ?? kind }));
  registerFamily(FOREIGN, (kind) => foreignKind(kind, { title: kind.slice(FOREIGN.length) }));
  let known: string[] = [];
  let listed = '[]';
  const refresh = async (): Promise<void> => {
    if (connection.state !== 'open') return;
    const answer = await connection.call('plugin.list').catch(() => null);
    if (!Array.isArray(answer) || JSON.stringify(answer) === listed) return;
    listed = JSON.stringify(answer);
    const kinds = answer.filter(isObject).map(kindOf);
    for (const kind of known) if (!kinds.some((each) => each.kind === kind)) forgetPanel(kind);
    kinds.forEach(registerPanel);
    known = kinds.map((each) => each.kind);
    panelsChanged();
  };
  connection.onHello(() => void refresh());
  window.addEventListener('focus', () => void refresh());
}

function kindOf(entry: JsonObject): PanelKind {
  const foreign = entry['kind'] === 'rqt';
  const kind = (foreign ? FOREIGN : OWN) + textOf(entry, 'name');
  return foreign ? foreignKind(kind, entry) : ownKind(kind, entry);
}

function ownKind(kind: string, entry: JsonObject): PanelKind {
  const name = kind.slice(OWN.length);
  const problem = textOf(entry, 'problem');
  return {
    kind, title: textOf(entry, 'title'), group: groupOf(entry), single: true, note: name,
    about: problem || textOf(entry, 'about'), faded: problem !== '',
    make: async (connection, host) => new (await import('./plugin_panel')).PluginPanel(name, connection, host),
  };
}

function foreignKind(kind: string, entry: JsonObject): PanelKind {
  const name = kind.slice(FOREIGN.length);
  return {
    kind, title: textOf(entry, 'title'), group: 'Plugins', single: true, note: 'rqt', about: textOf(entry, 'about'), faded: true,
    make: async (connection, host) => new (await import('./port_panel')).PortPanel(name, connection, host),
  };
}

function groupOf(entry: JsonObject): PanelGroup {
  const wanted = textOf(entry, 'group');
  return PANEL_GROUPS.find((group) => group === wanted) ?? 'Plugins';
}
