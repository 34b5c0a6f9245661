// The panels of the demonstration rack: each shows the values of its card or of the machine. A picture of each is
// stored in the build folder.
import assert from 'node:assert/strict';
import test from 'node:test';
import { answered, call } from './library.mjs';
import {
  openTab,
  picture,
  RACKS,
  show,
  startPart,
  state,
  stopAndRelease,
  suite,
  takeControl,
  until,
} from './support.mjs';

const all = suite(test, RACKS.all);

async function at(view, options) {
  const tab = await openTab(all.browser, all.server, { hash: `#/${view}`, ...options });
  await takeControl(tab);
  return tab;
}

async function done(tab) {
  await stopAndRelease(tab);
  assert.deepEqual(tab.troubles, []);
  await tab.context.close();
}

const panel = (tab, name) => tab.page.getByRole('region', { name });
const number = (text) => Number(text.replace(/\u2009/g, '').replace('\u2212', '-'));

test('axes are homed, with their phases and what was found; then they are valid', async () => {
  const tab = await at('operate');
  await tab.page.getByRole('button', { name: 'Home all' }).click();
  await tab.page.getByRole('list', { name: 'Phases of homing' }).waitFor();
  await state(tab, 'homing');
  await until(() => tab.status.state === 'standstill', 'all axes are homed', 60000);
  await until(() => tab.status.axes.every((axis) => axis.position_valid), 'all positions are valid');
  await until(async () => (await tab.page.locator('.homed.yes').count()) === 4, 'all axes are shown as homed');
  await tab.page.getByText('Homed; results').click();
  await tab.page.locator('.homing td').first().waitFor();
  await done(tab);
});

test('a checked program shows its time, extents and path; a bad one its problems with their lines', async () => {
  const tab = await at('operate');
  await tab.page.getByRole('button', { name: 'Edit' }).click();
  await tab.page.getByLabel('Program text').fill('G21 G90\nG1 F1200 X20 Y10\nX10\nM2\n');
  await tab.page.getByRole('button', { name: 'Check' }).click();
  await tab.page.locator('.findings').getByText('takes').waitFor();
  await tab.page.getByText('planned: the checked program').waitFor();
  await tab.page.getByLabel('Program text').fill('G21\nG1 X9999 F100\n');
  await tab.page.getByRole('button', { name: 'Check' }).click();
  await tab.page
    .locator('.problems')
    .getByText(/Line 2/)
    .waitFor();
  await done(tab);
});

/** Sets the clock by its panel; switches to the view `operate`. */
async function setClock(tab, name) {
  await show(tab, 'operate');
  await panel(tab, 'Clock and E-stop input').getByRole('button', { name, exact: true }).click();
  await until(() => tab.status.clock.factor === (name === 'Real' ? 1 : parseFloat(name)), `the clock at ${name}`);
}

test('the MCX314 shows its counters, and they count', async () => {
  const tab = await at('operate');
  // At 0.1 x the acceleration lasts a second of real time, so that a slow browser shows it, too.
  await setClock(tab, '0.1 ×');
  await show(tab, 'cards/motion');
  await until(() => tab.subscribed?.rate_hz === 100, 'the counters are asked for every 0.01 s');
  for (const counter of ['LP', 'EP', 'CV', 'CA']) assert.ok(tab.subscribed.channels.includes(`motion.x.${counter}`));
  const seen = { EP: new Set(), CV: new Set(), CA: new Set() };
  const cells = panel(tab, /^motion:/)
    .locator('tbody tr')
    .first()
    .locator('td');
  const lp = () =>
    panel(tab, /^motion:/)
      .locator('tbody tr')
      .first()
      .locator('td')
      .first()
      .innerText();
  await until(async () => Number.isFinite(number(await lp())), 'LP of x');
  const before = number(await lp());
  const moves = panel(tab, 'Moves and homing');
  await moves.getByLabel('Speed').fill('100');
  await moves.getByRole('button', { name: 'Move +' }).click();
  await until(async () => number(await lp()) > before, 'LP counts up');
  await until(async () => {
    const [, ep, cv, ca] = await cells.allInnerTexts();
    for (const [name, text] of Object.entries({ EP: ep, CV: cv, CA: ca })) seen[name].add(number(text));
    return [...seen.CV].some((speed) => speed > 0) && [...seen.CA].some((rate) => rate > 0) && seen.EP.size > 1;
  }, 'real position, speed and acceleration while it moves');
  await state(tab, 'standstill');
  assert.ok((await panel(tab, 'Inputs and outputs').locator('li').count()) > 8);
  await picture(tab, 'card_mcx314', 1360);
  await setClock(tab, 'Real');
  await done(tab);
});

test('the DataBoard 4002 answers at its ports by hand and by its functions, and shows its status', async () => {
  const tab = await at('cards/positioner');
  const ports = panel(tab, 'Ports');
  await ports.getByLabel('Where').selectOption({ label: '01h CS/STAT' });
  await ports.getByRole('button', { name: 'Read' }).click();
  await ports
    .getByRole('log')
    .getByText(/^[0-9A-F]{2}h$/)
    .waitFor();
  await tab.page.getByRole('group', { name: /^STAT/ }).getByText('READY').waitFor();
  await ports.getByLabel('Where').selectOption({ label: '03h C2' });
  await ports.getByLabel('Value').fill("'G'");
  await ports.getByRole('button', { name: 'Write' }).click();
  await ports.getByRole('log').getByText('write C2').waitFor();
  const ofCommands = tab.page.getByRole('region', { name: 'Commands', exact: true });
  assert.equal(await ofCommands.count(), 0, 'each command once: as a function');
  await call(tab, 'set_target', { counts: 40 });
  await answered(tab, /^set_target/);
  await call(tab, 'version');
  await answered(tab, /version of its program/);
  await call(tab, 'set_rate', { rate: 99999 });
  await tab.page
    .getByText(/must be 0 to/)
    .first()
    .waitFor();
  await picture(tab, 'card_databoard4002', 960);
  await done(tab);
});

test('the IOFLEX02 shows four positions and is calibrated', async () => {
  const tab = await at('cards/glass');
  const rows = panel(tab, /^glass:/).locator('tbody tr');
  await until(
    async () => Number.isFinite(number(await rows.first().locator('td').first().innerText())),
    'the position of axis 0',
  );
  assert.equal(await rows.count(), 4);
  await rows.first().getByRole('button', { name: 'cRes, axis 0' }).click();
  await until(async () => (await rows.first().locator('td').first().innerText()) === '0', 'position 0');
  const lamp = (axis, shows) =>
    rows
      .nth(axis)
      .getByRole('img', { name: `Axis ${axis} calibrated: ${shows}` })
      .waitFor();
  const four = tab.page.getByRole('group', { name: 'Commands of all axes' });
  const writeCmd = four.getByRole('button', { name: 'WriteCmd' });
  await four.getByLabel('Cmd2').selectOption('cResNm: zero at the index');
  await four.getByLabel('Cmd3').selectOption('cResNmSig: zero at index and signal');
  await writeCmd.click();
  for (const axis of [2, 3]) await lamp(axis, 'off');
  await rows.nth(2).getByRole('button', { name: 'cRes, axis 2' }).click();
  await lamp(2, 'on');
  await lamp(3, 'off');
  for (const axis of [2, 3]) await four.getByLabel(`Cmd${axis}`).selectOption('cNop: no calibration');
  await writeCmd.click();
  await lamp(3, 'on');
  const output = tab.page.getByRole('button', { name: /^Output 9, low/ });
  await output.click();
  await tab.page.getByRole('button', { name: /^Output 9, high/ }).waitFor();
  await panel(tab, /^glass:/)
    .getByText(/^Time of the card: [0-9.]+ s/)
    .waitFor();
  await picture(tab, 'card_ioflex02', 960);
  await done(tab);
});

test('the grating bus shows the frames of all its cards, and that they agree', async () => {
  const tab = await at('cards/host');
  const frames = panel(tab, 'Frames of all cards');
  await frames.getByText('All cards hold the same frame').waitFor();
  assert.ok((await frames.locator('tbody tr').count()) >= 3);
  await picture(tab, 'card_grating_bus', 960);
  await done(tab);
});

test('a stage that a stop has brought to rest goes on from the page of the bus', async () => {
  const tab = await at('cards/host');
  const start = tab.page.getByRole('button', { name: 'Start mask_x' });
  await stopAndRelease(tab);
  await start.waitFor();
  await picture(tab, 'card_grating_bus_stopped', 960);
  await takeControl(tab);
  await start.click();
  await start.waitFor({ state: 'detached' });
  await done(tab);
});

test('the RTC5 marks, and the work piece is drawn', async () => {
  const tab = await at('cards/scan');
  await panel(tab, /^Work piece/)
    .getByRole('button', { name: 'Start line' })
    .click();
  await panel(tab, 'Mark').getByRole('button', { name: 'each part' }).click();
  await panel(tab, 'Mark').getByRole('button', { name: 'Mark', exact: true }).click();
  const piece = panel(tab, /^Work piece/);
  await until(
    async () => ((await piece.locator('path.marks').getAttribute('d')) ?? '').length > 100,
    'marks on the work piece',
    30000,
  );
  await picture(tab, 'card_rtc5', 1500);
  await panel(tab, 'Mark').getByRole('button', { name: 'Stop marking' }).click();
  await done(tab);
});

test('registers are shown with the names of their bits, and looking sends no command', async () => {
  const tab = await at('registers/motion');
  const before = tab.sent.filter((one) => one.command !== 'renew_control').length;
  await tab.page.getByRole('button', { name: /^RR0/ }).click();
  await until(async () => (await tab.page.locator('.bits li').count()) > 4, 'fields of RR0');
  await tab.page.getByLabel('Find').fill('LP');
  await tab.page.getByText('x.LP').waitFor();
  assert.equal(tab.sent.filter((one) => one.command !== 'renew_control').length, before);
  await picture(tab, 'registers');
  await done(tab);
});

test('an axis is disabled alone, is not moved then, and is enabled again', async () => {
  const tab = await at('operate');
  const drive = tab.page.getByRole('button', { name: 'Axis Y enabled' });
  await drive.click();
  await until(() => tab.status.axes[1].enabled === false, 'Y is disabled');
  await until(async () => (await drive.getAttribute('aria-pressed')) === 'false', 'the button shows it');
  assert.equal(tab.status.state, 'standstill');
  await tab.page.getByRole('button', { name: 'Home axis Y' }).click();
  await tab.page.getByText('Not homed: axis Y is disabled; enable it first.').first().waitFor();
  await drive.click();
  await until(() => tab.status.axes[1].enabled === true, 'Y is enabled');
  await done(tab);
});

test('a wire is driven by hand and released; a fault is made and mended', async () => {
  const tab = await at('faults');
  await tab.page.getByLabel('Find').fill('Y.limit_plus');
  const wire = tab.page.locator('.wirelist li').filter({ hasText: 'Y.limit_plus' }).first();
  await wire.getByRole('button', { name: /to 0/ }).click();
  await wire.getByText('by hand').waitFor();
  await until(() => tab.status.axes[1].leds.hard_plus === true, 'the limit switch of Y acts');
  await picture(tab, 'faults');
  await wire.getByRole('button', { name: /Release/ }).click();
  await until(() => tab.status.axes[1].leds.hard_plus === false, 'it does not any more');
  await tab.page.getByLabel('Of', { exact: true }).selectOption('X');
  const fault = tab.page.locator('.faultlist li').first();
  await fault.getByRole('button', { name: 'Break' }).click();
  await fault.getByRole('button', { name: 'Mend' }).click();
  await fault.getByRole('button', { name: 'Break' }).waitFor();
  await done(tab);
});

test('the scope records numbers and edges, with two cursors and an export', async () => {
  await startPart(all.server, 'line');
  const tab = await at('scope');
  for (const name of ['scan.enc0_a', 'X.commanded']) {
    await tab.page.getByLabel('Add a channel').fill(name);
    await tab.page.locator('.picker .found').getByRole('button', { name }).first().click();
  }
  await tab.page.getByLabel('Trigger', { exact: true }).selectOption('scan.enc0_a');
  await tab.page.getByRole('button', { name: 'Single' }).click();
  await tab.page.locator('.chart canvas').waitFor({ timeout: 15000 });
  await tab.page.getByText('recorded', { exact: true }).waitFor();
  await tab.page.getByLabel(/^Cursor B/).fill('5');
  await tab.page.locator('.cursors tbody tr').nth(2).waitFor();
  const file = tab.page.waitForEvent('download');
  await tab.page.getByRole('button', { name: 'CSV' }).click();
  assert.equal((await file).suggestedFilename(), 'scope.csv');
  await picture(tab, 'scope');
  await done(tab);
});

test('the clock is paused, stepped and let go', async () => {
  const tab = await at('operate');
  const clock = panel(tab, 'Clock and E-stop input');
  await clock.getByRole('button', { name: 'Pause' }).click();
  await until(() => tab.status.clock.mode === 'paused', 'the clock stands');
  const before = tab.status.at;
  await clock.getByLabel('Step').fill('0.01');
  await clock.getByRole('button', { name: 'Step', exact: true }).click();
  await until(() => tab.status.at > before, 'a step');
  assert.ok(tab.status.at - before < 0.05);
  await clock.getByRole('button', { name: 'Real' }).click();
  await until(() => tab.status.clock.mode === 'real', 'the clock goes');
  await done(tab);
});

test('an alarm is told, survives a reload, and is acknowledged', async () => {
  const tab = await at('operate');
  await tab.page.keyboard.press('F1');
  await state(tab, 'error stop');
  await tab.page
    .getByRole('alert')
    .getByText(/emergency stop/i)
    .waitFor();
  await tab.page.reload();
  await tab.page.locator('main .view').first().waitFor();
  await tab.page
    .getByRole('alert')
    .getByText(/emergency stop/i)
    .waitFor();
  await show(tab, 'events');
  await panel(tab, 'Alarms').getByText('active, unacknowledged').waitFor();
  // Each event is displayed as a row of the table, for every name of its kind.
  const rows = await panel(tab, 'Events')
    .locator('tbody tr')
    .evaluateAll((all) => all.map((row) => getComputedStyle(row).display));
  assert.ok(rows.length > 3 && rows.every((display) => display === 'table-row'), rows.join());
  await picture(tab, 'events');
  await tab.page.keyboard.press('F1');
  await until(() => !tab.status.estop.pressed, 'released');
  await tab.page.getByRole('button', { name: /Take/ }).click();
  await tab.page.getByText('You hold control').waitFor();
  await tab.page.getByRole('group', { name: 'Motion' }).getByRole('button', { name: 'Reset' }).click();
  await panel(tab, 'Alarms').getByRole('button', { name: 'Acknowledge' }).first().click();
  await until(() => tab.status.alarms.every((alarm) => alarm.acknowledged), 'acknowledged');
  await tab.page
    .getByRole('alert')
    .getByText(/emergency stop/i)
    .waitFor({ state: 'detached' });
  await state(tab, 'standstill', 'disabled');
  await tab.context.close();
});

for (const scheme of ['dark', 'light'])
  test(`pictures of the operating view, ${scheme}`, async () => {
    const tab = await at('operate', { scheme });
    await picture(tab, `operate_${scheme}`);
    await done(tab);
  });

test('a picture of the phone', async () => {
  const tab = await openTab(all.browser, all.server, { width: 360, height: 740 });
  const lamps = await tab.page.locator('.lamps').first().boundingBox();
  assert.ok(lamps.height < 60, `the lamps of an axis take ${lamps.height} px`);
  await picture(tab, 'phone', 740);
  await tab.context.close();
});
