// Jogging: a lease renewed at least every 100 ms, and ended by every event after which the key may not be held.
import assert from 'node:assert/strict';
import test from 'node:test';
import {
  arm,
  chooseStep,
  named,
  openTab,
  pause,
  state,
  stopAndRelease,
  suite,
  takeControl,
  until,
} from './support.mjs';

const all = suite(test);

async function armed(step = 'hold', options = {}) {
  const tab = await openTab(all.browser, all.server, options);
  await takeControl(tab);
  await chooseStep(tab, step);
  await arm(tab);
  return tab;
}

async function done(tab) {
  await stopAndRelease(tab);
  await tab.context.close();
}

/** Holds the right arrow until the axis jogs. */
async function hold(tab, key = 'ArrowRight') {
  const before = named(tab, 'jog').length;
  await tab.page.keyboard.down(key);
  await until(() => named(tab, 'jog').length > before + 2, 'renewed jogs');
  await state(tab, 'jogging');
}

async function ended(tab, stops = 1) {
  await until(() => named(tab, 'jog_stop').length >= stops, 'a jog_stop');
  const count = named(tab, 'jog').length;
  await pause(300);
  assert.equal(named(tab, 'jog').length, count, 'no jog after the end');
}

test('a held arrow jogs, is renewed every 100 ms at most, and stops on keyup', async () => {
  const tab = await armed();
  await tab.page.clock.install();
  await tab.page.clock.pauseAt(Date.now() + 1000);
  await tab.page.keyboard.down('ArrowRight');
  await until(() => named(tab, 'jog').length === 1, 'the first jog');
  await tab.page.clock.runFor(1000);
  await until(() => named(tab, 'jog').length > 10, 'more than ten jogs in a second of the page');
  await tab.page.keyboard.up('ArrowRight');
  await until(() => named(tab, 'jog_stop').length === 1, 'a jog_stop');
  const count = named(tab, 'jog').length;
  await tab.page.clock.runFor(1000);
  assert.equal(named(tab, 'jog').length, count, 'no jog after the end');
  assert.ok(named(tab, 'jog').every((one) => one.axis === 'X' && one.speed > 0));
  await tab.page.clock.resume();
  await state(tab, 'standstill');
  await done(tab);
});

for (const [key, axis, sign] of [
  ['ArrowLeft', 'X', -1],
  ['ArrowUp', 'Y', 1],
  ['ArrowDown', 'Y', -1],
  ['PageUp', 'Z', 1],
  ['PageDown', 'Z', -1],
  ['[', 'A', -1],
  [']', 'A', 1],
])
  test(`${key} jogs ${axis} ${sign < 0 ? '-' : '+'}`, async () => {
    const tab = await armed();
    await tab.page.keyboard.down(key);
    await until(() => named(tab, 'jog').length > 0, 'a jog');
    await tab.page.keyboard.up(key);
    await ended(tab);
    assert.equal(named(tab, 'jog')[0].axis, axis);
    assert.equal(Math.sign(named(tab, 'jog')[0].speed), sign);
    await done(tab);
  });

test('with Shift it jogs at the maximum velocity', async () => {
  const tab = await armed();
  await tab.page.keyboard.down('Shift');
  await tab.page.keyboard.down('ArrowRight');
  await until(() => named(tab, 'jog').length > 0, 'a jog');
  assert.equal(named(tab, 'jog')[0].speed, tab.status.axes[0].max_velocity);
  await tab.page.keyboard.up('ArrowRight');
  await tab.page.keyboard.up('Shift');
  await done(tab);
});

test('keydown.repeat is ignored', async () => {
  const tab = await armed('1');
  await tab.page.keyboard.down('ArrowRight');
  for (let i = 0; i < 5; ++i) await tab.page.keyboard.down('ArrowRight');
  await tab.page.keyboard.up('ArrowRight');
  await pause(200);
  assert.equal(named(tab, 'jog_by').length, 1);
  await done(tab);
});

test('step mode moves once per press', async () => {
  const tab = await armed('0.1');
  for (let i = 1; i <= 3; ++i) {
    await tab.page.keyboard.press('ArrowRight');
    await until(() => named(tab, 'jog_by').length === i, `move ${i}`);
    await state(tab, 'standstill');
    await pause(100);
  }
  assert.deepEqual(
    named(tab, 'jog_by').map((one) => [one.axis, one.distance]),
    [
      ['X', 0.1],
      ['X', 0.1],
      ['X', 0.1],
    ],
  );
  assert.equal(named(tab, 'jog').length, 0);
  await done(tab);
});

for (const [what, end] of [
  ['blur', (tab) => tab.page.evaluate(() => window.dispatchEvent(new Event('blur')))],
  [
    'visibilitychange',
    (tab) =>
      tab.page.evaluate(() => {
        Object.defineProperty(document, 'hidden', { value: true, configurable: true });
        document.dispatchEvent(new Event('visibilitychange'));
        delete document.hidden;
      }),
  ],
  ['pagehide', (tab) => tab.page.evaluate(() => window.dispatchEvent(new Event('pagehide')))],
  ['the arm switch off', (tab) => arm(tab)],
])
  test(`${what} ends a jog whose key is still down`, async () => {
    const tab = await armed();
    await hold(tab);
    await end(tab);
    await ended(tab);
    await tab.page.keyboard.up('ArrowRight');
    await done(tab);
  });

test('a lost connection ends a jog, which does not continue after reconnecting', async () => {
  const context = await all.browser.newContext();
  const { tabOf } = await import('./support.mjs');
  const routes = [];
  await context.routeWebSocket(/\/api\/stream/, (route) => {
    route.connectToServer();
    routes.push(route);
  });
  const tab = await tabOf(context, all.server);
  await takeControl(tab);
  await chooseStep(tab, 'hold');
  await arm(tab);
  await tab.page.keyboard.down('ArrowRight');
  await tab.page.locator('.jog.held').waitFor();
  await routes[0].close();
  await tab.page.locator('.jog.held').waitFor({ state: 'detached' });
  await until(() => routes.length > 1, 'a new connection');
  await tab.page.getByText(/live/).waitFor();
  assert.equal(await tab.page.locator('.jog.held').count(), 0);
  await tab.page.keyboard.up('ArrowRight');
  await context.close();
});

test('a jog button moves while the mouse holds it', async () => {
  const tab = await armed();
  await tab.page.getByRole('button', { name: 'Jog Y +' }).hover();
  await tab.page.mouse.down();
  await until(() => named(tab, 'jog').length > 2, 'renewed jogs');
  await tab.page.mouse.up();
  await ended(tab);
  assert.equal(named(tab, 'jog')[0].axis, 'Y');
  await done(tab);
});

test('a jog button moves while a finger holds it', async () => {
  const tab = await armed('hold', { touch: true });
  const box = await tab.page.getByRole('button', { name: 'Jog X +' }).boundingBox();
  const at = [{ x: box.x + box.width / 2, y: box.y + box.height / 2 }];
  const client = await tab.context.newCDPSession(tab.page);
  await client.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: at });
  await until(() => named(tab, 'jog').length > 2, 'renewed jogs');
  await client.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  await ended(tab);
  await done(tab);
});

test('a jog button moves while Enter holds it: by keyboard alone', async () => {
  const tab = await armed();
  await tab.page.getByRole('button', { name: 'Jog X +' }).focus();
  await tab.page.keyboard.down('Enter');
  await until(() => named(tab, 'jog').length > 2, 'renewed jogs');
  await tab.page.keyboard.up('Enter');
  await ended(tab);
  await done(tab);
});
