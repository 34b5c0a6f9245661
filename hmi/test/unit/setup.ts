// After each test: the real clock.
import { afterEach, vi } from 'vitest';

afterEach(() => {
  vi.useRealTimers();
});
