/** Starts the page. */

import 'dockview/dist/styles/dockview.css';
import './styles/theme.css';
import './styles/shell.css';
import './styles/panels.css';
import { Connection, socketUrl } from './connection';
import { GraphStore } from './graph_store';
import { registerAll } from './panels/catalogue';
import { watchPlugins } from './panels/plugins';
import { watchConnection } from './shell/banner';
import { Dock } from './shell/dock';
import { Layouts } from './shell/layout_menu';
import { LayoutStore } from './shell/layout_store';
import { help, listenForKeys } from './shell/shortcuts';
import { restoreTheme } from './shell/theme';
import { Toasts } from './shell/toasts';
import { buildTopbar } from './shell/topbar';
import { WorldControls } from './shell/world_controls';

function part(id: string): HTMLElement {
  const element = document.getElementById(id);
  if (!element) throw new Error(`the page has no element ${id}`);
  return element;
}

function start(): void {
  restoreTheme();
  registerAll();
  const connection = new Connection(socketUrl());
  watchPlugins(connection);
  const toasts = new Toasts(part('toasts'));
  const graph = new GraphStore(connection);
  const dock = new Dock(part('dock'), connection, graph, toasts);
  const layouts = new Layouts(connection, dock, new LayoutStore(connection), toasts, graph);
  const world = new WorldControls(connection, toasts);
  const panels = buildTopbar(part('topbar'), connection, dock, layouts, world, help);
  listenForKeys(dock, world, panels);
  watchConnection(part('banner'), connection);
}

start();
