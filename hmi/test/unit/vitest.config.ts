// The unit tests: all of the page that needs no browser.
import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    include: ['test/unit/**/*.test.ts'],
    environment: 'node',
    setupFiles: ['test/unit/setup.ts'],
    // The clock of the tests stands still; this is the real one, on a machine that has much to do.
    testTimeout: 30_000,
    restoreMocks: true,
    unstubGlobals: true,
  },
});
