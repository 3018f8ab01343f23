/** Starts the page. */

import { Connection, socketUrl } from './connection';
import { registerAll } from './panels/catalogue';

registerAll();
new Connection(socketUrl());
