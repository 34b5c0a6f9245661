// What all browser tests need: a program that serves the page, a browser, what the page sent, and the ways of a user.
import assert from 'node:assert/strict';
import { mkdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';
import { Fake } from './fake_server.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const PAGE = process.env.MOTIONRACK_PAGE ?? join(here, '../../build/test/share/motionrack/page');
export const PICTURES = process.env.MOTIONRACK_PICTURES ?? join(here, '../../build/pictures');
const CHROMIUM = process.env.CHROMIUM ?? '/usr/bin/chromium';

export async function startServer() {
  return new Fake().start(PAGE);
}

export const openBrowser = () => chromium.launch({ executablePath: CHROMIUM, args: ['--no-sandbox'] });

/** A tab on the panel. `sent`: orders of this tab with their times; `troubles`: what the browser complained of. */
export async function openTab(browser, server, { hash = '', width = 1440, height = 900, scheme = 'dark', touch = false, reduced = false } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: scheme, hasTouch: touch, reducedMotion: reduced ? 'reduce' : 'no-preference' });
  return tabOf(context, server, hash);
}

export async function tabOf(context, server, hash = '') {
  const page = await context.newPage();
  const tab = { page, context, sent: [], troubles: [], requests: [], status: null };
  page.on('websocket', (socket) => {
    socket.on('framesent', ({ payload }) => {
      const message = JSON.parse(payload);
      if (message.order) tab.sent.push({ at: performance.now(), ...message });
    });
    socket.on('framereceived', ({ payload }) => {
      const message = JSON.parse(payload);
      if (message.status) tab.status = message.status;
    });
  });
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && tab.troubles.push(message.text()));
  page.on('pageerror', (error) => tab.troubles.push(error.message));
  page.on('request', (request) => tab.requests.push(request.url()));
  await page.goto(server.address + hash);
  await page.getByRole('button', { name: 'STOP', exact: true }).waitFor();
  await page.locator('main .view').first().waitFor();
  return tab;
}

/** Waits until `look` gives something true; says `what` if it never does. */
export async function until(look, what, ms = 5000) {
  const end = performance.now() + ms;
  for (;;) {
    const seen = await look();
    if (seen) return seen;
    assert.ok(performance.now() < end, `not within ${ms} ms: ${what}`);
    await new Promise((done) => setTimeout(done, 20));
  }
}

export const pause = (ms) => new Promise((done) => setTimeout(done, ms));
export const named = (tab, order) => tab.sent.filter((one) => one.order === order);
export const state = (tab, ...names) => until(() => names.includes(tab.status?.state), `state ${names.join(' or ')}, it is ${tab.status?.state}`);

export async function takeControl(tab) {
  await tab.page.getByRole('button', { name: /Take control|Take over/ }).click();
  await tab.page.getByText('You hold control').waitFor();
}

export const arm = (tab) => tab.page.getByRole('switch', { name: 'Keyboard' }).click();
export const chooseStep = (tab, text) => tab.page.getByRole('group', { name: 'Jog step' }).getByRole('button', { name: text, exact: true }).click();

export async function picture(tab, name, whole = false) {
  mkdirSync(PICTURES, { recursive: true });
  await tab.page.screenshot({ path: join(PICTURES, `${name}.png`), fullPage: whole });
}

/** Starts a server and a browser for the tests of a file, and a tab for each test. */
export function suite(test) {
  const all = {};
  test.before(async () => {
    all.server = await startServer();
    all.browser = await openBrowser();
  });
  test.after(async () => {
    await all.browser?.close();
    await all.server?.stop();
  });
  return all;
}
