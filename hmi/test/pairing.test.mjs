// Pairing and roles: a code in the address, a typed code, a wrong code; forbidden actions are disabled with a reason.
import assert from 'node:assert/strict';
import test from 'node:test';
import { openTab, command, RACKS, suite, tabOf, until } from './support.mjs';

const all = suite(test, RACKS.axes, { pairing: true });
let token = '';

/** Returns a pairing code of the program for this role. */
async function invite(role) {
  if (token === '') token = (await command(all.server, 'pair', { code: all.server.code, name: 'test' })).token;
  return (await command(all.server, 'invite', { role }, token)).code;
}

test('a code in the address pairs by itself and is removed from the address', async () => {
  const tab = await openTab(all.browser, all.server, { hash: `#pair=${await invite('maintain')}` });
  await tab.page.getByText('This browser is paired.').waitFor();
  assert.ok(!tab.page.url().includes('pair'), tab.page.url());
  assert.ok(await tab.page.evaluate(() => localStorage.getItem('motionrack.token')));
  await tab.page.getByText(/, maintain$/).waitFor();
  await tab.page.reload();
  await tab.page.getByText(/, maintain$/).waitFor();
  await tab.context.close();
});

test('a code is typed into a small dialog; a wrong one is refused with a sentence', async () => {
  const code = await invite('operate');
  const tab = await openTab(all.browser, all.server);
  await tab.page.getByRole('button', { name: 'Pair', exact: true }).click();
  const dialog = tab.page.getByRole('dialog', { name: 'Pair this browser' });
  await dialog.getByLabel('Code').fill('AAAA-BBBB');
  await dialog.getByLabel('Your name').fill('bert');
  await dialog.getByRole('button', { name: 'Pair', exact: true }).click();
  await dialog.getByRole('alert').getByText(/code/i).waitFor();
  await dialog.getByLabel('Code').fill(code);
  await dialog.getByLabel('Your name').press('Enter');
  await dialog.waitFor({ state: 'detached', timeout: 15000 });
  await tab.page.getByText('bert, operate').waitFor();
  await tab.context.close();
});

test('an observer has controls disabled with the reason, and STOP enabled', async () => {
  const tab = await openTab(all.browser, all.server);
  const hold = tab.page.getByRole('group', { name: 'Motion' }).getByRole('button', { name: 'Feed hold' });
  assert.equal(await hold.getAttribute('aria-disabled'), 'true');
  assert.match(await hold.getAttribute('title'), /needs the role operate/);
  await hold.focus();
  await tab.page.keyboard.press('Enter');
  await tab.page
    .locator('.notice')
    .getByText(/needs the role operate/)
    .waitFor();
  const stopped = tab.page.waitForResponse((response) => response.url().endsWith('/api/stop'));
  await tab.page.getByRole('button', { name: 'STOP', exact: true }).click();
  assert.equal((await stopped).status(), 200);
  await tab.context.close();
});

test('a revoked token is discarded', async () => {
  const context = await all.browser.newContext();
  await context.addInitScript(() => localStorage.setItem('motionrack.token', 'nonsense'));
  const tab = await tabOf(context, all.server);
  await until(() => tab.page.evaluate(() => localStorage.getItem('motionrack.token') === null), 'the token is gone');
  await context.close();
});

test('a maintainer creates an invitation code', async () => {
  const tab = await openTab(all.browser, all.server, { hash: `#pair=${await invite('maintain')}` });
  await tab.page.getByRole('button', { name: 'Invite' }).click();
  await tab.page.getByRole('button', { name: 'Make a code' }).click();
  await tab.page
    .getByRole('dialog')
    .getByText(/^[A-Z0-9]{4}-[A-Z0-9]{4}$/)
    .waitFor();
  await tab.context.close();
});

test('a user who reloads takes control again without waiting', async () => {
  const tab = await openTab(all.browser, all.server, { hash: `#pair=${await invite('operate')}` });
  await tab.page.getByText('This browser is paired.').waitFor();
  await tab.page.getByRole('button', { name: 'Take control' }).click();
  await tab.page.getByText('You hold control').waitFor();
  await tab.page.reload();
  await tab.page.getByRole('button', { name: /Take/ }).click();
  await tab.page.getByText('You hold control').waitFor();
  await tab.context.close();
});
