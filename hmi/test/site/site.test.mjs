// The documentation served by `motionrack docs`, in a browser: search, colours, widths, and no request to other hosts.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { openBrowser, PICTURES, PROGRAM, until } from '../support.mjs';

const all = {};

before(async () => {
  all.program = spawn(PROGRAM, ['docs', '--port', '0']);
  let said = '';
  for (const stream of [all.program.stdout, all.program.stderr]) stream.on('data', (text) => (said += text));
  all.address = await until(() => /http:\/\/\S+\//.exec(said)?.[0], 'the address of the site');
  all.browser = await openBrowser();
  mkdirSync(PICTURES, { recursive: true });
});

after(async () => {
  await all.browser?.close();
  all.program?.kill('SIGTERM');
});

/** Opens a tab on a page of the site. `troubles`: errors of the browser; `elsewhere`: requests to other hosts. */
async function open(path, { width = 1440, scheme = 'light' } = {}) {
  const context = await all.browser.newContext({ viewport: { width, height: 900 }, colorScheme: scheme });
  const page = await context.newPage();
  const tab = { page, context, troubles: [], elsewhere: [] };
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && tab.troubles.push(message.text()));
  page.on('pageerror', (error) => tab.troubles.push(error.message));
  page.on('request', (one) => one.url().startsWith(all.address) || tab.elsewhere.push(one.url()));
  await page.goto(all.address + path);
  return tab;
}

async function close(tab) {
  assert.deepEqual(tab.elsewhere, []);
  assert.deepEqual(tab.troubles, []);
  await tab.context.close();
}

/** Types words letter by letter into the search after its index is loaded. */
async function search(tab, words) {
  const ready = tab.page.locator('.md-search-result__meta', { hasText: 'Type to start searching' });
  await ready.waitFor({ state: 'attached', timeout: 30_000 });
  await tab.page.getByRole('textbox', { name: 'Search' }).click();
  await tab.page.keyboard.type(words);
}

for (const scheme of ['dark', 'light'])
  for (const width of [390, 1024, 1440])
    for (const path of ['index.html', 'explanations/paths.html', 'reference/mcx314.html', 'reference/headers/sim.html'])
      test(`${path} fits ${width} px in ${scheme} colours`, async () => {
        const tab = await open(path, { width, scheme });
        const shown = () => tab.page.locator('body').getAttribute('data-md-color-scheme');
        await until(async () => (await shown()) === (scheme === 'dark' ? 'slate' : 'default'), `${scheme} colours`);
        const wide = await tab.page.evaluate(() => document.documentElement.scrollWidth);
        assert.ok(wide <= width, `the page is ${wide} px wide`);
        const name = `site_${path.replace(/\W/g, '_')}_${width}_${scheme}.png`;
        await tab.page.screenshot({ path: join(PICTURES, name) });
        await close(tab);
      });

test('a word is searched, and its page opens', async () => {
  const tab = await open('index.html');
  await search(tab, 'look-ahead');
  const found = tab.page.locator('.md-search-result__link[href*="explanations/paths.html"]').first();
  await found.waitFor();
  await tab.page.screenshot({ path: join(PICTURES, 'site_search.png') });
  await found.click();
  await tab.page.waitForURL(/explanations\/paths\.html/);
  await close(tab);
});

for (const letter of ['r', 'x', '1'])
  test(`a page is found at the letter ${letter}`, async () => {
    const tab = await open('index.html');
    await search(tab, letter);
    await tab.page.locator('.md-search-result__link').first().waitFor();
    await close(tab);
  });

test('a class is found by its name, in the reference of the headers', async () => {
  const tab = await open('howto/panel.html');
  await search(tab, 'RackConfig');
  await tab.page.locator('.md-search-result__link[href*="reference/headers/rack.html"]').first().waitFor();
  await close(tab);
});
