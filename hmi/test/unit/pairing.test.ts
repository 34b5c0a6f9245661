// Pairing: exchanges a code for a token that the browser stores.
import { expect, test } from 'vitest';
import { openBrowser, settled } from './browser';
import { connected } from './program';

const pairing = async (): Promise<typeof import('../../src/link/pairing')> => import('../../src/link/pairing');
const good = { ok: true, status: 200, body: { token: 'T1' } };

test('a typed code is sent in capitals with the name, both without surrounding blanks', async () => {
  const { browser, program } = await connected();
  browser.http = good;
  program.answers.token = { role: 'operate', user: 'carl' };
  await (await pairing()).pair(' abcd-efgh ', ' carl ');
  expect(browser.posts).toEqual([{ path: 'api/pair', body: { code: 'ABCD-EFGH', name: 'carl' } }]);
  expect(browser.store.get('motionrack.token')).toBe('T1');
  expect(program.asked('token')).toEqual([{ token: 'T1' }]);
  expect((await import('../../src/link/state')).user.value).toBe('carl');
});

test('a refused code leaves the browser without a token and shows the reason', async () => {
  const browser = openBrowser();
  browser.http = {
    ok: false,
    status: 403,
    body: { error: { kind: 'denied', message: 'The code was used already.' } },
  };
  await expect((await pairing()).pair('X', 'carl')).rejects.toThrow('The code was used already.');
  expect(browser.store.has('motionrack.token')).toBe(false);
});

test('an answer without a sentence gets one', async () => {
  const browser = openBrowser();
  browser.http = { ok: false, status: 500, body: {} };
  await expect((await pairing()).pair('X', 'carl')).rejects.toThrow('answered 500; this browser is not paired.');
});

test('a code in the address is removed from it at once, and used', async () => {
  const browser = openBrowser({ hash: '#pair=ABCD%2DEFGH', stored: { 'motionrack.name': 'carl' } });
  browser.http = good;
  const done = (await pairing()).pairFromAddress();
  expect(browser.location.hash).toBe('');
  await done;
  expect(browser.posts[0]?.body).toEqual({ code: 'ABCD-EFGH', name: 'carl' });
  expect((await import('../../src/link/commands')).notices.value).toMatchObject([{ kind: 'done' }]);
});

test('a browser without a name gets one of its own', async () => {
  const browser = openBrowser({ hash: '#/scope&pair=ABCD' });
  browser.http = good;
  await (await pairing()).pairFromAddress();
  expect(browser.posts[0]?.body).toEqual({ code: 'ABCD', name: 'browser-2f1e' });
});

test('a rejected code of the address is shown in the dialog with the reason', async () => {
  const browser = openBrowser({ hash: '#pair=ABCD' });
  browser.http = { ok: false, status: 403, body: { error: { kind: 'denied', message: 'Too late.' } } };
  const { codeText, dialogOpen, pairFromAddress, whyNotPaired } = await pairing();
  await pairFromAddress();
  expect([dialogOpen.value, codeText.value, whyNotPaired.value]).toEqual([true, 'ABCD', 'Too late.']);
});

test('a malformed code in the address does not break the page', async () => {
  const browser = openBrowser({ hash: '#pair=%E0%A4%A' });
  browser.http = new Error('offline');
  const { codeText, pairFromAddress } = await pairing();
  await pairFromAddress();
  expect(codeText.value).toBe('%E0%A4%A');
});

test('an address without a code pairs nothing and stays as it is', async () => {
  const browser = openBrowser({ hash: '#/scope' });
  await (await pairing()).pairFromAddress();
  await settled();
  expect([browser.posts, browser.location.hash]).toEqual([[], '#/scope']);
});

test('a revoked browser has no token after the reload', async () => {
  const browser = openBrowser({ stored: { 'motionrack.token': 'T1' } });
  browser.http = { ok: true, status: 200, body: { done: true } };
  await (await pairing()).forget();
  expect(browser.store.has('motionrack.token')).toBe(false);
  expect(browser.posts).toEqual([{ path: 'api/forget', body: {}, authorization: 'Bearer T1' }]);
  expect(browser.location.reload).toHaveBeenCalledOnce();
});

test('a browser revoked without a connection has no token either', async () => {
  const browser = openBrowser({ stored: { 'motionrack.token': 'T1' } });
  browser.http = new Error('offline');
  await (await pairing()).forget();
  expect(browser.store.has('motionrack.token')).toBe(false);
  expect(browser.location.reload).toHaveBeenCalledOnce();
});
