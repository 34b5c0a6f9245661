// Configuration of the unit tests, which need no browser.
import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    include: ['test/unit/**/*.test.ts'],
    environment: 'node',
    setupFiles: ['test/unit/setup.ts'],
    // In real time, with reserve for a busy computer; the clock inside the tests is stopped.
    testTimeout: 30_000,
    restoreMocks: true,
    unstubGlobals: true,
  },
});
