import { createHash } from 'node:crypto';
import { readdirSync, readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { defineConfig, type Plugin } from 'vite';

const SOURCES = import.meta.dirname;
const FILES = [
  'index.html',
  'package-lock.json',
  'tsconfig.json',
  'vite.config.ts',
  'vite.replay.config.ts',
];
const FOLDERS = ['src', 'public'];

/** Paths of all that the page is made of, below this folder, with forward slashes. */
function sources(): string[] {
  const below = FOLDERS.flatMap((folder) =>
    readdirSync(join(SOURCES, folder), { recursive: true, encoding: 'utf8' }).map(
      (name) => `${folder}/${name.replaceAll('\\', '/')}`,
    ),
  );
  return [...FILES, ...below.filter((path) => statSync(join(SOURCES, path)).isFile())].sort();
}

/** Write what the page was built from; `tests/studio/test_build.py` compares it with what is there. */
export function builtFrom(): Plugin {
  return {
    name: 'built-from',
    apply: 'build',
    generateBundle() {
      const hash = createHash('sha256');
      for (const path of sources()) {
        const text = readFileSync(join(SOURCES, path), 'utf8').replaceAll('\r\n', '\n');
        hash.update(`${path}\0${text}\0`);
      }
      this.emitFile({
        type: 'asset',
        fileName: 'built_from.txt',
        source: `sha256 ${hash.digest('hex')}\n`,
      });
    },
  };
}

/** Where the wheel takes the page from. Names carry no hashes: the server answers with an ETag. */
export default defineConfig({
  base: './',
  plugins: [builtFrom()],
  build: {
    outDir: '../src/gazelle/studio/page',
    emptyOutDir: true,
    target: 'es2022',
    modulePreload: { polyfill: false },
    cssCodeSplit: false,
    chunkSizeWarningLimit: 900,
    rollupOptions: {
      output: {
        entryFileNames: 'assets/[name].js',
        chunkFileNames: 'assets/[name].js',
        assetFileNames: 'assets/[name][extname]',
      },
    },
  },
});
