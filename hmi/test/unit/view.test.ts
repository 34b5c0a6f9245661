// The current view, and the settings of this browser.
import { describe, expect, test } from 'vitest';
import { openBrowser, type Browser, type Settings } from './browser';

const opened = async (settings: Settings = {}): Promise<[Browser, typeof import('../../src/view')]> => {
  const browser = openBrowser(settings);
  const view = await import('../../src/view');
  view.watch();
  return [browser, view];
};

describe('the view', () => {
  test.each([
    ['', 'operate', ''],
    ['#/scope', 'scope', ''],
    ['#scope', 'scope', ''],
    ['#/cards/mcx', 'cards', 'mcx'],
    ['#/registers/a%20card', 'registers', 'a card'],
    ['#/cards/left/right', 'cards', 'left/right'],
    ['#/nonsense', 'operate', ''],
    ['#/cards/100%', 'cards', '100%'],
  ])('shows for the address "%s" the view %s "%s"', async (hash, name, detail) => {
    const [, { view, detail: of }] = await opened({ hash });
    expect([view.value, of.value]).toEqual([name, detail]);
  });

  test('follows the address', async () => {
    const [browser, { view }] = await opened();
    browser.goTo('#/events');
    expect(view.value).toBe('events');
  });

  test('has an address that reopens it', async () => {
    const [browser, { address, detail, view }] = await opened();
    expect(address('scope')).toBe('#/scope');
    for (const card of ['mcx', 'grating bus / left', 'a%20b', '100%']) {
      browser.goTo(address('cards', card));
      expect([view.value, detail.value]).toEqual(['cards', card]);
    }
  });
});

describe('the theme', () => {
  test('follows the system until one is chosen', async () => {
    const [browser, { dark, setTheme }] = await opened({ prefersDark: false });
    expect(dark.value).toBe(false);
    browser.systemDark.turn(true);
    expect(dark.value).toBe(true);
    setTheme('light');
    expect(dark.value).toBe(false);
    expect(browser.document.documentElement.dataset.theme).toBe('light');
  });

  test('is kept once it was chosen', async () => {
    const [browser, { setTheme }] = await opened({ prefersDark: true });
    setTheme('light');
    const [, { dark }] = await opened({ stored: Object.fromEntries(browser.store), prefersDark: true });
    expect(dark.value).toBe(false);
  });
});

test('large numbers are kept', async () => {
  const [browser, { largeNumbers }] = await opened();
  expect(largeNumbers.value).toBe(false);
  largeNumbers.value = true;
  const [, again] = await opened({ stored: Object.fromEntries(browser.store) });
  expect(again.largeNumbers.value).toBe(true);
});

test('a narrow page gets the layout of a phone, and a wide one that of a desktop', async () => {
  const [browser, { narrow }] = await opened({ narrow: true });
  expect(narrow.value).toBe(true);
  browser.phone.turn(false);
  expect(narrow.value).toBe(false);
});
