/** Files that are dropped or chosen, with their folders, and how they come to the server. */

import type { Connection } from '../connection';
import { CallError } from '../errors';

/** A file with its path below what was dropped. */
export interface NamedFile {
  path: string;
  file: File;
}

/** The server takes no longer messages; base64 makes a third more of it. */
const PIECE_BYTES = 6 << 20;
const MOST_FILES = 4000;
const MOST_BYTES = 512 << 20;
const HIDDEN = /(^|\/)(\.[^/]*|__pycache__)(\/|$)/;

/** All files of a drop, those in folders too. To be called within the event. */
export async function filesOf(transfer: DataTransfer | null): Promise<NamedFile[]> {
  const entries = [...(transfer?.items ?? [])].map((item) => item.webkitGetAsEntry?.() ?? null);
  const plain = [...(transfer?.files ?? [])];
  const found: NamedFile[] = [];
  if (entries.every((entry) => entry === null))
    return plain.map((file) => ({ path: file.name, file }));
  for (const entry of entries) if (entry) await gather(entry, '', found);
  return found;
}

/** The files of an input, with the folders below a folder that was chosen. */
export function filesIn(input: HTMLInputElement): NamedFile[] {
  return [...(input.files ?? [])].map((file) => ({
    path: file.webkitRelativePath || file.name,
    file,
  }));
}

/** Brings files to the server; answers the name of their set there. */
export async function upload(
  connection: Connection,
  files: readonly NamedFile[],
  progress: (part: number) => void,
): Promise<string> {
  const wanted = files.filter((each) => !HIDDEN.test(each.path));
  const total = wanted.reduce((sum, each) => sum + each.file.size, 0);
  if (wanted.length > MOST_FILES || total > MOST_BYTES)
    throw new CallError(
      `These are ${wanted.length} files of ${Math.round(total / 2 ** 20)} MiB, which is too much.`,
      `At most ${MOST_FILES} files and ${MOST_BYTES >> 20} MiB: drop the robot's package alone.`,
    );
  const set = String(await connection.call('robot_file.begin'));
  let sent = 0;
  for (const { path, file } of wanted) {
    for (let at = 0; at === 0 || at < file.size; at += PIECE_BYTES) {
      const piece = file.slice(at, at + PIECE_BYTES);
      const base64 = await asBase64(piece);
      await connection.call('robot_file.put', { set, path, base64, more: at > 0 });
      sent += piece.size;
      progress(total ? sent / total : 1);
    }
  }
  return set;
}

async function gather(entry: FileSystemEntry, above: string, found: NamedFile[]): Promise<void> {
  const path = above + entry.name;
  if (found.length > MOST_FILES || HIDDEN.test(path)) return;
  if (entry.isFile) {
    const file = await new Promise<File>((resolve, reject) =>
      (entry as FileSystemFileEntry).file(resolve, reject),
    );
    found.push({ path, file });
    return;
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  for (;;) {
    // A reader gives a hundred at a time.
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) =>
      reader.readEntries(resolve, reject),
    );
    if (some.length === 0) return;
    for (const each of some) await gather(each, `${path}/`, found);
  }
}

function asBase64(piece: Blob): Promise<string> {
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.addEventListener('load', () => resolve(String(reader.result).split(',', 2)[1] ?? ''));
    reader.addEventListener('error', () => reject(reader.error ?? new Error('the file is gone')));
    reader.readAsDataURL(piece);
  });
}
