// Every key of the keyboard table, and the places in which keys have no effect.
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
const PROGRAM = 'G21 G90\nG1 F2000 X100\nG1 X0\nG1 X100\nG1 X0\nM2\n';

async function fresh(options) {
  const tab = await openTab(all.browser, all.server, options);
  await takeControl(tab);
  return tab;
}

async function withProgram() {
  const tab = await fresh();
  await tab.page.getByRole('button', { name: 'Edit' }).click();
  await tab.page.getByLabel('Program text').fill(PROGRAM);
  await tab.page.getByRole('button', { name: 'Edit' }).click();
  return tab;
}

async function rest(tab) {
  await stopAndRelease(tab);
  await tab.context.close();
}

test('Esc stops, also while a field is typed in', async () => {
  const tab = await fresh();
  await tab.page.keyboard.press('Escape');
  await until(() => named(tab, 'stop').length === 1, 'a stop');
  await tab.page.getByLabel('Line of G-code').focus();
  await tab.page.keyboard.press('Escape');
  await until(() => named(tab, 'stop').length === 2, 'a second stop');
  assert.ok(
    tab.requests.some((url) => url.endsWith('/api/stop')),
    'STOP goes by HTTP, too',
  );
  await rest(tab);
});

test('a malformed address shows the page, and Esc stops', async () => {
  const tab = await openTab(all.browser, all.server, { hash: '#/cards/100%' });
  const before = named(tab, 'stop').length;
  await tab.page.keyboard.press('Escape');
  await until(() => named(tab, 'stop').length === before + 1, 'a stop');
  await tab.context.close();
});

test('Space with the focus on Run holds and does not click Run; a second Space does not resume', async () => {
  const tab = await withProgram();
  await tab.page.keyboard.press('r');
  await state(tab, 'moving');
  await tab.page.getByRole('button', { name: 'Run', exact: true }).focus();
  await tab.page.keyboard.press('Space');
  await state(tab, 'hold');
  await tab.page.keyboard.press('Space');
  await pause(300);
  assert.equal(tab.status.state, 'hold');
  assert.equal(named(tab, 'start_program').length, 1);
  assert.equal(named(tab, 'resume').length, 0);
  await rest(tab);
});

test('Space is a blank in a field', async () => {
  const tab = await fresh();
  await tab.page.getByLabel('Line of G-code').focus();
  await tab.page.keyboard.type('G0 X1');
  assert.equal(await tab.page.getByLabel('Line of G-code').inputValue(), 'G0 X1');
  assert.equal(named(tab, 'hold').length, 0);
  await rest(tab);
});

test('r or ~ runs, p or ! pauses, s resumes, t does one step', async () => {
  const tab = await withProgram();
  await tab.page.keyboard.press('~');
  await state(tab, 'moving');
  assert.equal(named(tab, 'start_program')[0].text, PROGRAM);
  await tab.page.keyboard.press('!');
  await state(tab, 'hold');
  await tab.page.keyboard.press('s');
  await state(tab, 'moving');
  await tab.page.keyboard.press('p');
  await state(tab, 'hold');
  await tab.page.keyboard.press('t');
  await until(() => named(tab, 'set_single_block').some((one) => one.on === true), 'single block on');
  await until(() => named(tab, 'resume').length === 2, 'the step goes on from the hold');
  await tab.page.getByRole('switch', { name: 'Single block' }).click();
  await rest(tab);
});

test('digits are the feed override: 1 to 9 for 10 to 90 %, 0 for 100 %, ` for 0 %', async () => {
  const tab = await fresh();
  for (const key of ['1', '5', '9', '0', '`']) await tab.page.keyboard.press(key);
  await until(() => named(tab, 'set_overrides').length === 5, 'five commands');
  assert.deepEqual(
    named(tab, 'set_overrides').map((one) => one.feed),
    [0.1, 0.5, 0.9, 1, 0],
  );
  await tab.page.keyboard.press('0');
  await rest(tab);
});

test('F1 toggles the E-stop input, F2 enables; the browser shows no help', async () => {
  const tab = await fresh();
  await tab.page.evaluate(() =>
    window.addEventListener('keydown', (event) => (window.prevented = event.defaultPrevented), true),
  );
  await tab.page.keyboard.press('F1');
  await until(() => tab.status.estop.pressed, 'the E-stop input is pressed');
  await tab.page.getByText('PRESSED', { exact: true }).waitFor();
  await tab.page.keyboard.press('F1');
  await until(() => !tab.status.estop.pressed, 'the E-stop input is released');
  await tab.page.getByRole('group', { name: 'Motion' }).getByRole('button', { name: 'Reset' }).click();
  const before = named(tab, 'enable').length;
  await tab.page.keyboard.press('F2');
  await until(() => named(tab, 'enable').length === before + 1, 'a command enable');
  await pause(200);
  if (tab.status.state === 'disabled') await tab.page.keyboard.press('F2');
  await rest(tab);
});

test('Ctrl+Home homes, Home alone does not; End touches off the chosen axis', async () => {
  const tab = await fresh();
  await tab.page.keyboard.press('Home');
  await tab.page.keyboard.press('End');
  await until(() => named(tab, 'touch_off').length === 1, 'touch off');
  assert.deepEqual([named(tab, 'touch_off')[0].axis, named(tab, 'touch_off')[0].value], ['X', 0]);
  assert.equal(named(tab, 'home').length, 0);
  await tab.page.keyboard.press('Control+Home');
  await until(() => named(tab, 'home').length === 1, 'home');
  await rest(tab);
});

test('i is the next jog increment, c continuous', async () => {
  const tab = await fresh();
  await chooseStep(tab, '0.01');
  const pressed = () => tab.page.getByRole('group', { name: 'Jog step' }).locator('[aria-pressed=true]').innerText();
  await tab.page.keyboard.press('i');
  await until(async () => (await pressed()) === '0.1', 'the next step');
  await tab.page.keyboard.press('c');
  await until(async () => (await pressed()) === 'hold', 'continuous');
  await rest(tab);
});

test('? shows the table of keys, made from the same declaration, and a link to the documentation', async () => {
  const tab = await fresh();
  await tab.page.keyboard.press('?');
  const help = tab.page.getByRole('dialog', { name: 'Help' });
  for (const text of ['Esc', 'Space', 'F1', 'F2', 'Ctrl + Home', 'End', 'r or ~', 'p or !', '1 … 9', 'PgDn PgUp'])
    await help.getByText(text, { exact: true }).waitFor();
  const docs = await help.getByRole('link', { name: 'Documentation' }).getAttribute('href');
  assert.equal((await tab.page.request.get(new URL(docs, tab.page.url()).href)).status(), 200);
  await tab.page.keyboard.press('?');
  await help.waitFor({ state: 'detached' });
  await rest(tab);
});

test('jog keys and letters do nothing while a field is typed in', async () => {
  const tab = await fresh();
  await arm(tab);
  await tab.page.getByLabel('Line of G-code').focus();
  for (const key of ['ArrowRight', 'r', 't', 'p', 's', '5', 'i', 'c', '[', 'PageUp', 'End'])
    await tab.page.keyboard.press(key);
  await pause(200);
  assert.deepEqual(
    tab.sent.map((one) => one.command).filter((one) => !['take_control', 'renew_control'].includes(one)),
    [],
  );
  await rest(tab);
});

test('jog keys do nothing until the keyboard is armed', async () => {
  const tab = await fresh();
  await chooseStep(tab, '1');
  await tab.page.keyboard.press('ArrowRight');
  await pause(200);
  assert.equal(named(tab, 'jog_by').length + named(tab, 'jog').length, 0);
  await rest(tab);
});

test('without control a key reports the reason', async () => {
  const tab = await openTab(all.browser, all.server);
  await tab.page.keyboard.press('r');
  await tab.page.getByText('Run: Take control first.').waitFor();
  assert.equal(named(tab, 'start_program').length, 0);
  await tab.context.close();
});

test('Esc closes a dialog and stops as well', async () => {
  const tab = await fresh();
  await tab.page.keyboard.press('?');
  await tab.page.getByRole('dialog', { name: 'Help' }).waitFor();
  await tab.page.keyboard.press('Escape');
  await tab.page.getByRole('dialog', { name: 'Help' }).waitFor({ state: 'detached' });
  await until(() => named(tab, 'stop').length === 1, 'a stop');
  await rest(tab);
});
