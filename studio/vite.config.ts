import { defineConfig } from 'vite';

/** Where the wheel takes the page from. Names carry no hashes: the server answers with an ETag. */
export default defineConfig({
  base: './',
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
