/** Makes panels of the user's own known: those that the server lists, and those a layout remembers. */

import type { Connection } from '../connection';
import type { PanelEntry } from '../generated/messages';
import {
  forgetPanel,
  PANEL_GROUPS,
  panelsChanged,
  registerFamily,
  registerPanel,
  type PanelGroup,
  type PanelKind,
} from '../panel';

const OWN = 'plugin:';
const FOREIGN = 'rqt-plugin:';

/** Registers what the server lists, now, at every connection and when the person comes back to the page. */
export function watchPlugins(connection: Connection): void {
  registerFamily(OWN, (kind) =>
    ownKind(kind, { title: kind.slice(OWN.length).split('.').pop() ?? kind }),
  );
  registerFamily(FOREIGN, (kind) => foreignKind(kind, { title: kind.slice(FOREIGN.length) }));
  let known: string[] = [];
  let listed = '[]';
  const refresh = async (): Promise<void> => {
    if (connection.state !== 'open') return;
    const answer = await connection.call('plugin.list').catch(() => null);
    if (!Array.isArray(answer) || JSON.stringify(answer) === listed) return;
    listed = JSON.stringify(answer);
    const kinds = (answer as unknown as PanelEntry[]).map(kindOf);
    for (const kind of known) if (!kinds.some((each) => each.kind === kind)) forgetPanel(kind);
    kinds.forEach(registerPanel);
    known = kinds.map((each) => each.kind);
    panelsChanged();
  };
  connection.onHello(() => void refresh());
  window.addEventListener('focus', () => void refresh());
}

/** What is known of a panel; a layout remembers less than the server tells. */
type Known = Pick<PanelEntry, 'title'> & Partial<PanelEntry>;

function kindOf(entry: PanelEntry): PanelKind {
  const foreign = entry.kind === 'rqt';
  const kind = (foreign ? FOREIGN : OWN) + entry.name;
  return foreign ? foreignKind(kind, entry) : ownKind(kind, entry);
}

function ownKind(kind: string, entry: Known): PanelKind {
  const name = kind.slice(OWN.length);
  const problem = entry.problem ?? '';
  return {
    kind,
    title: entry.title,
    group: groupOf(entry),
    single: true,
    note: name,
    about: problem || (entry.about ?? ''),
    faded: problem !== '',
    help: {
      what: `A panel of yours, or of a package: the Python class ${name}.`,
      first: 'What it does is in its file. Reload starts it anew after a change.',
      keys: [],
      docs: 'howto/panels/',
    },
    make: async (connection, host) =>
      new (await import('./plugin_panel')).PluginPanel(name, connection, host),
  };
}

function foreignKind(kind: string, entry: Known): PanelKind {
  const name = kind.slice(FOREIGN.length);
  return {
    kind,
    title: entry.title,
    group: 'Plugins',
    single: true,
    note: 'rqt',
    about: entry.about ?? '',
    faded: true,
    help: {
      what: `The plug-in ${name} of rqt, which is written for Qt.`,
      first:
        'Save the panel that is drafted from its forms, and fill in what the draft leaves open.',
      keys: [],
      docs: 'howto/panels/',
    },
    make: async (connection, host) =>
      new (await import('./rqt_port_panel')).PortPanel(name, connection, host),
  };
}

function groupOf(entry: Known): PanelGroup {
  return PANEL_GROUPS.find((group) => group === entry.group) ?? 'Plugins';
}
