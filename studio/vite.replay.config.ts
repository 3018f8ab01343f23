import { defineConfig } from 'vite';
import { builtFrom } from './vite.config.ts';

/** The viewer of recordings: one script, which `gazelle.studio.replay` writes into each file. */
export default defineConfig({
  publicDir: false,
  plugins: [builtFrom()],
  build: {
    outDir: '../src/gazelle/studio/replay/viewer',
    emptyOutDir: true,
    target: 'es2022',
    chunkSizeWarningLimit: 900,
    lib: {
      entry: 'src/replay/main.ts',
      formats: ['iife'],
      name: 'gazelleReplayViewer',
      fileName: () => 'replay.js',
    },
  },
});
