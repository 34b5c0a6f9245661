// Accessibility and use on touch screens: axe-core on every view, sizes of targets, order of focus, live regions,
// themes, phone, reduced motion.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import test from 'node:test';
import { openTab, RACKS, show, suite, takeControl, until } from './support.mjs';

const all = suite(test, RACKS.all);
const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const CARDS = ['motion', 'positioner', 'glass', 'host', 'decoder', 'scan'];
const VIEWS = ['operate', 'scope', 'cards', ...CARDS.map((card) => `cards/${card}`), 'registers', 'faults', 'events'];

async function go(tab, view) {
  await show(tab, view);
  await tab.page.waitForTimeout(400);
}

async function faults(tab) {
  await tab.page.evaluate(AXE);
  const result = await tab.page.evaluate(() =>
    window.axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] }),
  );
  return result.violations.flatMap((one) =>
    one.nodes.map((node) => `${one.id}: ${node.target.join(' ')}: ${node.failureSummary.split('\n')[1] ?? ''}`),
  );
}

/** Returns the visible elements that can be pressed, with their sizes in CSS pixels. */
const targets = (tab, selector) =>
  tab.page.evaluate(
    (which) =>
      [...document.querySelectorAll(which)]
        .filter((one) => one.offsetParent !== null && !one.classList.contains('hidden'))
        .map((one) => ({
          text: one.getAttribute('aria-label') ?? one.textContent,
          width: one.getBoundingClientRect().width,
          height: one.getBoundingClientRect().height,
        })),
    selector,
  );

for (const scheme of ['dark', 'light'])
  test(`axe-core finds nothing on any view, ${scheme}`, async () => {
    const tab = await openTab(all.browser, all.server, { scheme });
    await takeControl(tab);
    for (const view of VIEWS) {
      await go(tab, view);
      assert.deepEqual(await faults(tab), [], view);
    }
    await go(tab, 'operate');
    await tab.page.keyboard.press('?');
    assert.deepEqual(await faults(tab), [], 'help');
    await tab.context.close();
  });

for (const scheme of ['dark', 'light'])
  test(`old values can still be read, ${scheme}`, async () => {
    const tab = await openTab(all.browser, all.server, { scheme });
    await takeControl(tab);
    await tab.page.evaluate(() => {
      const root = document.documentElement;
      const keep = () => root.classList.contains('stale') || root.classList.add('stale');
      new globalThis.MutationObserver(keep).observe(root, { attributeFilter: ['class'] });
      keep();
    });
    for (const view of VIEWS) {
      await go(tab, view);
      assert.deepEqual(await faults(tab), [], view);
    }
    await tab.context.close();
  });

test('axe-core finds nothing on a phone', async () => {
  const tab = await openTab(all.browser, all.server, { width: 360, height: 720 });
  assert.deepEqual(await faults(tab), []);
  await tab.context.close();
});

test('every target is at least 24 by 24 CSS pixels, machine controls at least 44 by 44', async () => {
  const tab = await openTab(all.browser, all.server);
  await takeControl(tab);
  for (const view of VIEWS) {
    await go(tab, view);
    for (const one of await targets(tab, 'button, a, input, select, textarea, summary, [role=switch]'))
      assert.ok(one.width >= 24 && one.height >= 24, `${view}: ${one.text} is ${one.width} x ${one.height}`);
    for (const one of await targets(tab, '.button.machine, .stop, .jog, button.letter'))
      assert.ok(one.width >= 44 && one.height >= 44, `${view}: ${one.text} is ${one.width} x ${one.height}`);
  }
  await tab.context.close();
});

test('STOP is the first in the order of focus and is never disabled', async () => {
  const tab = await openTab(all.browser, all.server);
  await tab.page.keyboard.press('Tab');
  assert.equal(await tab.page.evaluate(() => document.activeElement.textContent), 'STOP');
  const stop = tab.page.getByRole('button', { name: 'STOP', exact: true });
  assert.equal(await stop.getAttribute('aria-disabled'), null);
  assert.equal(await tab.page.getByText('E-STOP', { exact: true }).count(), 0, 'it is not called E-STOP');
  await tab.context.close();
});

test('new alarms are announced at once, the state politely', async () => {
  const tab = await openTab(all.browser, all.server);
  assert.equal(await tab.page.locator('.alarmlive').getAttribute('aria-live'), 'assertive');
  assert.equal(await tab.page.locator('.statebar .state').getAttribute('aria-live'), 'polite');
  await tab.context.close();
});

test('every lamp has a letter and a name besides its colour', async () => {
  const tab = await openTab(all.browser, all.server);
  const lamps = await tab.page.evaluate(() =>
    [...document.querySelectorAll('.led')].map((one) => [one.textContent, one.getAttribute('aria-label')]),
  );
  assert.ok(lamps.length > 8);
  for (const [letter, name] of lamps) assert.ok(letter.length > 0 && /: (on|off)$/.test(name), `${letter} ${name}`);
  await tab.context.close();
});

test('a phone of 360 pixels gets the monitor and STOP only, without a scroll bar to the side', async () => {
  const tab = await openTab(all.browser, all.server, { width: 360, height: 720 });
  const names = (await targets(tab, 'button, input, select, textarea')).map((one) => one.text);
  assert.deepEqual(names, ['STOP']);
  await tab.page.getByText('SIMULATION').waitFor();
  await tab.page.getByRole('status').first().waitFor();
  assert.ok(await tab.page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'nothing sticks out');
  await tab.context.close();
});

for (const width of [600, 768, 1024, 1280, 1440, 1920])
  test(`nothing sticks out at ${width} pixels`, async () => {
    const tab = await openTab(all.browser, all.server, { width });
    for (const view of VIEWS) {
      await go(tab, view);
      assert.ok(
        await tab.page.evaluate(() => document.documentElement.scrollWidth <= innerWidth),
        `${view} sticks out`,
      );
    }
    await tab.context.close();
  });

test('the page has no animation if the user prefers reduced motion', async () => {
  const tab = await openTab(all.browser, all.server, { reduced: true });
  const moving = await tab.page.evaluate(
    () =>
      [...document.querySelectorAll('*')].filter((one) => {
        const style = getComputedStyle(one);
        return (parseFloat(style.transitionDuration) || 0) > 0 || style.animationName !== 'none';
      }).length,
  );
  assert.equal(moving, 0);
  await tab.context.close();
});

test('the digits of the axes do not jump: all have one width', async () => {
  const tab = await openTab(all.browser, all.server);
  assert.match(
    await tab.page
      .locator('.commanded')
      .first()
      .evaluate((one) => getComputedStyle(one).fontVariantNumeric + getComputedStyle(one).fontFeatureSettings),
    /tabular-nums|tnum/,
  );
  await tab.context.close();
});

test('dark and light follow the system, and a button changes them', async () => {
  const tab = await openTab(all.browser, all.server, { scheme: 'light' });
  const theme = () => tab.page.evaluate(() => document.documentElement.dataset.theme);
  assert.equal(await theme(), 'light');
  await tab.page.getByRole('button', { name: 'Dark colours' }).click();
  await until(async () => (await theme()) === 'dark', 'dark colours');
  await tab.context.close();
});
