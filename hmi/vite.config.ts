// Build of the page: all files are local and nothing is inline, as the strict content security policy requires.
import { defineConfig } from 'vite';
import { licences } from './licences.mjs';

export default defineConfig({
  base: './',
  plugins: [licences()],
  build: {
    outDir: process.env.MOTIONRACK_PAGE ?? '../build/release/share/motionrack/page',
    emptyOutDir: true,
    target: 'es2021',
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 800,
    reportCompressedSize: false,
  },
  server: { proxy: { '/api': { target: process.env.MOTIONRACK_SERVER ?? 'http://127.0.0.1:8080', ws: true } } },
});
