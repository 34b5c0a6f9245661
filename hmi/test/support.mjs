// Shared parts of the browser tests: the program that serves the page, a browser, the page's messages, user actions.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

const here = dirname(fileURLToPath(import.meta.url));
const BUILD = process.env.MOTIONRACK_BUILD ?? join(here, '../../build/release');
export const PROGRAM = join(BUILD, 'bin/motionrack');
/** Program that serves a virtual card in place of a real one; exists if the tests of the tree are built. */
export const LIVE_SERVER = join(BUILD, 'tests/live/live_server');
const CHROMIUM = process.env.CHROMIUM ?? '/usr/bin/chromium';
export const PICTURES = join(BUILD, 'pictures');
/** Racks: four axes with valid positions from the start; every card type; one axis and a card without axes; no axis. */
export const RACKS = {
  axes: join(here, 'rack.toml'),
  all: join(here, '../../examples/15_panel/demonstration.toml'),
  bench: join(here, 'bench.toml'),
  cards: join(here, 'cards.toml'),
};

/** Runs `motionrack serve`. Without pairing, every client has all rights. `live`: card in whose place a served one acts
 * as a real card. */
export async function startServer(rack = RACKS.axes, { pairing = false, live = '' } = {}) {
  const folder = mkdtempSync(join(tmpdir(), 'motionrack-page-'));
  const command = [
    PROGRAM,
    'serve',
    rack,
    '--port',
    '0',
    '--page',
    join(BUILD, 'share/motionrack/page'),
    '--users',
    join(folder, 'users.json'),
    ...(pairing ? [] : ['--no-auth']),
  ];
  const served = ['port', '--real-time', '/bin/sh', '-c', `exec "$0" "$@" --live "${live}=$MOTIONRACK_LIVE_PORT"`];
  const program = live === '' ? spawn(command[0], command.slice(1)) : spawn(LIVE_SERVER, [...served, ...command]);
  process.once('exit', () => program.kill());
  let said = '';
  program.stderr.on('data', (text) => (said += text));
  const server = { address: '', code: '', said: () => said };
  await new Promise((done, failed) => {
    program.once('error', failed);
    program.once('exit', (code) => failed(new Error(`the program ended with ${code}: ${said}`)));
    program.stdout.on('data', (text) => {
      said += text;
      const found = /page +(http:\/\/[^\s#]+)(?:#pair=(\S+))?/.exec(said);
      if (found === null || !said.includes('Ctrl-C')) return;
      [server.address, server.code] = [found[1], found[2] ?? ''];
      done();
    });
  });
  server.stop = async () => {
    const ended = new Promise((done) => program.once('exit', done));
    program.kill('SIGTERM');
    await ended;
    rmSync(folder, { recursive: true, force: true });
  };
  return server;
}

export const openBrowser = () => chromium.launch({ executablePath: CHROMIUM, args: ['--no-sandbox'] });

/** Opens a tab on the panel. `sent`: commands of this tab with their times; `subscribed`: its last subscription;
 * `troubles`: errors of the browser. */
export async function openTab(
  browser,
  server,
  { hash = '', width = 1440, height = 900, scheme = 'dark', touch = false, reduced = false } = {},
) {
  const context = await browser.newContext({
    viewport: { width, height },
    colorScheme: scheme,
    hasTouch: touch,
    reducedMotion: reduced ? 'reduce' : 'no-preference',
  });
  return tabOf(context, server, hash);
}

export async function tabOf(context, server, hash = '') {
  const page = await context.newPage();
  const tab = { page, context, sent: [], troubles: [], requests: [], status: null, subscribed: null };
  page.on('websocket', (socket) => {
    socket.on('framesent', ({ payload }) => {
      const message = JSON.parse(payload);
      if (message.subscribe) tab.subscribed = message.subscribe;
      if (message.command) tab.sent.push({ at: performance.now(), ...message });
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

/** Waits until `look` returns a true value and returns it; fails with `what` after `ms`. */
export async function until(look, what, ms = 5000) {
  const end = performance.now() + ms;
  for (;;) {
    const seen = await look();
    if (seen) return seen;
    assert.ok(performance.now() < end, `not within ${ms} ms: ${what}`);
    await new Promise((done) => setTimeout(done, 20));
  }
}

/** Opens a view by its address. */
export const show = (tab, view) => tab.page.evaluate((to) => (location.hash = `#/${to}`), view);

export const pause = (ms) => new Promise((done) => setTimeout(done, ms));
export const named = (tab, command) => tab.sent.filter((one) => one.command === command);
/** Waits for one of these states of the machine. */
export const state = (tab, ...names) =>
  until(() => names.includes(tab.status?.state), `state ${names.join(' or ')}, it is ${tab.status?.state}`);

/** Sends a command over HTTP, independent of the page; returns the answer. `token`: '' for a server without pairing. */
export async function command(server, name, fields = {}, token = '') {
  const answer = await fetch(`${server.address}api/${name}`, {
    method: 'POST',
    headers: { 'content-type': 'application/json', ...(token && { authorization: `Bearer ${token}` }) },
    body: JSON.stringify(fields),
  });
  const body = await answer.json();
  assert.equal(answer.status, 200, `${name}: ${JSON.stringify(body)}`);
  return body;
}

/** Restarts a belt after a STOP. */
export async function startPart(server, part) {
  await command(server, 'take_control', { force: true });
  await command(server, 'reset');
  await pause(200);
  await command(server, 'start_part', { part });
  await command(server, 'release_control');
}

/** Sends STOP, resets it and releases control. Takes control first if another session has it, such as that of a tab
 * before its reload. */
export async function stopAndRelease(tab) {
  await tab.page.keyboard.press('Escape');
  await until(() => tab.status?.state === 'error stop', 'STOP holds the machine');
  const reset = tab.page.getByRole('group', { name: 'Motion' }).getByRole('button', { name: 'Reset' });
  const take = tab.page.getByRole('button', { name: /Take control|Take over/ });
  const mayReset = async () => (await reset.getAttribute('aria-disabled')) !== 'true';
  await until(async () => (await mayReset()) || (await take.count()) > 0, 'control, or a button for it');
  if (!(await mayReset())) await take.click();
  await reset.click();
  await state(tab, 'standstill', 'disabled');
  const release = tab.page.getByRole('button', { name: 'Release', exact: true });
  if (await release.count()) await release.click();
}

/** Takes control and enables the drives. */
export async function takeControl(tab) {
  await tab.page.getByRole('button', { name: /Take control|Take over/ }).click();
  await tab.page.getByText('You hold control').waitFor();
  if (tab.status.state === 'error stop')
    await tab.page.getByRole('group', { name: 'Motion' }).getByRole('button', { name: 'Reset' }).click();
  await state(tab, 'disabled', 'standstill');
  if (tab.status.state === 'disabled') await tab.page.getByRole('button', { name: 'Enable drives' }).click();
  await state(tab, 'standstill');
}

export const arm = (tab) => tab.page.getByRole('switch', { name: 'Keyboard' }).click();
export const chooseStep = (tab, text) =>
  tab.page.getByRole('group', { name: 'Jog step' }).getByRole('button', { name: text, exact: true }).click();

/** Stores a picture of the tab in the build folder, for inspection. */
export async function picture(tab, name, height = 900) {
  mkdirSync(PICTURES, { recursive: true });
  await tab.page.setViewportSize({ width: tab.page.viewportSize().width, height });
  await tab.page.screenshot({ path: join(PICTURES, `${name}.png`) });
}

/** Starts a server and a browser for the tests of a file, and a tab for each test. */
export function suite(test, rack, options) {
  const all = {};
  test.before(async () => {
    all.server = await startServer(rack, options);
    all.browser = await openBrowser();
  });
  test.after(async () => {
    await all.browser?.close();
    await all.server?.stop();
  });
  return all;
}
