// The link to the program: ages, tabs, reloads, roles, pairing, the content policy.
import assert from 'node:assert/strict';
import test from 'node:test';
import { named, openTab, pause, show, state, stopAndRelease, suite, tabOf, takeControl, until } from './support.mjs';

const all = suite(test);
const PROGRAM = 'G21 G90\nG1 F600 X100\nG1 X0\nG1 X100\nM2\n';

async function running() {
  const tab = await openTab(all.browser, all.server);
  await takeControl(tab);
  await tab.page.getByRole('button', { name: 'Edit' }).click();
  await tab.page.getByLabel('Program text').fill(PROGRAM);
  await tab.page.getByRole('button', { name: 'Run', exact: true }).click();
  await state(tab, 'moving');
  return tab;
}

async function done(tab) {
  await stopAndRelease(tab);
  await tab.context.close();
}

test('values older than 500 ms are slanted, without colour, and show their age; fresh ones are not', async () => {
  const context = await all.browser.newContext({ viewport: { width: 1440, height: 900 } });
  let silent = false;
  await context.routeWebSocket(/\/api\/stream/, (route) => {
    const server = route.connectToServer();
    server.onMessage((message) => !silent && route.send(message));
  });
  await context.clock.install();
  const tab = await tabOf(context, all.server);
  const look = () =>
    tab.page
      .locator('.commanded')
      .first()
      .evaluate((one) => [getComputedStyle(one).fontStyle, getComputedStyle(one).filter]);
  const fresh = ['normal', 'none'];
  await tab.page.clock.pauseAt(Date.now() + 1000);
  const sequence = tab.status.sequence;
  await until(() => tab.status.sequence > sequence + 5, 'fresh values');
  silent = true;
  await pause(100);
  await tab.page.clock.runFor(400);
  assert.deepEqual(await look(), fresh, 'not before 500 ms');
  await tab.page.clock.runFor(200);
  assert.deepEqual(await look(), ['italic', 'grayscale(1)'], 'after 500 ms');
  await tab.page.getByText(/these values are \d+\.\d s old/).waitFor();
  silent = false;
  await tab.page.clock.resume();
  await until(async () => (await look())[0] === 'normal', 'fresh again');
  await context.close();
});

test('a connection that was lost comes back by itself', async () => {
  const context = await all.browser.newContext();
  const routes = [];
  await context.routeWebSocket(/\/api\/stream/, (route) => {
    route.connectToServer();
    routes.push(route);
  });
  const tab = await tabOf(context, all.server);
  await routes[0].close();
  await tab.page.getByText(/lost/).first().waitFor();
  await until(() => routes.length > 1, 'a second connection');
  await tab.page.getByText(/live/).waitFor();
  await context.close();
});

test('STOP works while the stream is down, by HTTP', async () => {
  const context = await all.browser.newContext();
  await context.routeWebSocket(/\/api\/stream/, (route) => route.close());
  const page = await context.newPage();
  await page.goto(all.server.address);
  const answered = page.waitForResponse((response) => response.url().endsWith('/api/stop'));
  await page.getByRole('button', { name: 'STOP', exact: true }).click();
  assert.equal((await answered).status(), 200);
  await context.close();
});

test('a second tab changes nothing and does not take control', async () => {
  const tab = await running();
  const second = await openTab(all.browser, all.server);
  await second.page.getByText(/holds control/).waitFor();
  await pause(500);
  assert.deepEqual(second.sent, [], 'the second tab sent no command');
  assert.ok(['moving', 'hold'].includes(second.status.state));
  assert.equal(await tab.page.getByText('You hold control').count(), 1);
  const take = second.page.getByRole('button', { name: 'Take over' });
  assert.match(await take.getAttribute('title'), /standstill/, 'taking over waits for standstill');
  await second.context.close();
  await pause(200);
  assert.equal(tab.status.state, 'moving');
  await done(tab);
});

test('a reload keeps the job running and shows it', async () => {
  const tab = await running();
  const before = tab.status.program.line;
  await tab.page.reload();
  await tab.page.locator('main .view').first().waitFor();
  tab.status = null; // accepts only statuses received after the reload
  await state(tab, 'moving');
  assert.ok(tab.status.program.runs && tab.status.program.line >= before);
  await tab.page.locator('.progress').getByText(tab.status.program.name).waitFor();
  assert.equal(named(tab, 'stop').length, 0);
  await done(tab);
});

test('the program is typed, checked and run; the current line is marked', async () => {
  const tab = await running();
  await tab.page.getByRole('button', { name: 'Edit' }).click();
  await tab.page.locator('.listing .current').waitFor();
  await done(tab);
});

test('a rejection is shown with the message of the program', async () => {
  const tab = await openTab(all.browser, all.server);
  await tab.page.getByRole('button', { name: 'Feed hold' }).click();
  await tab.page.getByText(/A hold is not possible: the machine is in state/).waitFor();
  await tab.context.close();
});

test('the console sends lines, shows answers, and brings back what was sent', async () => {
  const tab = await openTab(all.browser, all.server);
  await takeControl(tab);
  const field = tab.page.getByLabel('Line of G-code');
  await field.fill('G4 P0.01');
  await field.press('Enter');
  await tab.page.locator('.mdi .log p.good').getByText('ok').waitFor();
  await field.fill('G999');
  await field.press('Enter');
  await tab.page.locator('.mdi .log p.bad').waitFor();
  await field.press('ArrowUp');
  await field.press('ArrowUp');
  assert.equal(await field.inputValue(), 'G4 P0.01');
  await done(tab);
});

test('SIMULATION is on every view and on the phone', async () => {
  const tab = await openTab(all.browser, all.server);
  for (const view of ['operate', 'scope', 'cards', 'registers', 'faults', 'events']) {
    await show(tab, view);
    assert.ok(await tab.page.getByText('SIMULATION', { exact: true }).isVisible(), view);
  }
  await tab.context.close();
});

test('no request leaves the machine, and the content policy is kept', async () => {
  const tab = await openTab(all.browser, all.server);
  for (const view of ['scope', 'cards', 'registers', 'faults', 'events', 'operate']) {
    await show(tab, view);
    await tab.page.waitForTimeout(300);
  }
  await tab.page.getByRole('button', { name: '3D' }).click();
  await tab.page.locator('canvas.space').waitFor();
  const policy = (await tab.page.request.get(all.server.address)).headers()['content-security-policy'];
  assert.ok(policy && !/unsafe/.test(policy), `the policy is ${policy}`);
  const origin = new URL(all.server.address).origin;
  for (const url of tab.requests) assert.ok(url.startsWith(origin), url);
  assert.deepEqual(
    tab.troubles.filter((one) => /Content Security Policy|Refused/.test(one)),
    [],
  );
  await tab.context.close();
});

test('three is loaded only when the path is shown in 3D', async () => {
  const tab = await openTab(all.browser, all.server);
  assert.equal(tab.requests.filter((url) => /space-/.test(url)).length, 0);
  await tab.page.getByRole('button', { name: '3D' }).click();
  await until(() => tab.requests.some((url) => /space-.*\.js/.test(url)), 'the chunk of the space view');
  await tab.context.close();
});
