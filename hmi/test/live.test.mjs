// A real card on the page, with a virtual one in its place that another process serves: its address, its panel in
// service and without service, and STOP.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import test from 'node:test';
import { answered, call, driveX, panel } from './library.mjs';
import {
  LIVE_SERVER,
  openBrowser,
  openTab,
  picture,
  RACKS,
  show,
  startServer,
  state,
  stopAndRelease,
  takeControl,
} from './support.mjs';

const none = existsSync(LIVE_SERVER) ? false : 'live_server is not built: cmake -DMOTIONRACK_TESTS=ON';

/** Starts the server; returns null if this computer does not let programs serve files. */
async function started() {
  try {
    return await startServer(RACKS.bench, { live: 'bench' });
  } catch (why) {
    if (/Nothing was tested/.test(why.message)) return null;
    throw why;
  }
}

async function pictures(tab) {
  for (const scheme of ['light', 'dark'])
    for (const width of [1280, 760, 390]) {
      await tab.page.emulateMedia({ colorScheme: scheme });
      await tab.page.setViewportSize({ width, height: 900 });
      await picture(tab, `live-${scheme}-${width}`, 1800);
    }
  await tab.page.setViewportSize({ width: 1440, height: 900 });
}

test('a real card shows its address, moves in service only, and STOP ends its pulses', { skip: none }, async (t) => {
  const server = await started();
  if (server === null) return t.skip('this computer lets no program serve files');
  const browser = await openBrowser();
  try {
    const tab = await openTab(browser, server);
    await takeControl(tab);
    await show(tab, 'cards');
    const tile = tab.page.getByRole('link', { name: /bench/ });
    await tile.getByText(/real card at port:/).waitFor();
    await picture(tab, 'live-cards');
    await tile.click();
    const card = tab.page.getByRole('region', { name: /^bench: / });
    await card.getByText('REAL CARD', { exact: true }).waitFor();
    await card.getByText(/is read while it is in service only/).waitFor();
    assert.equal(await card.getByRole('table').count(), 0, 'no numbers without a service');
    assert.equal(await tab.page.getByRole('region', { name: 'Inputs and outputs' }).count(), 0);
    await tab.page.getByText('SIMULATION').waitFor();

    await call(tab, 'SetRange', { data: 800000 });
    await state(tab, 'service');
    await answered(tab, 'Written.');
    await driveX(tab);
    await card.getByRole('row', { name: /^x 500 / }).waitFor();
    await card.getByText('REAL CARD, IN SERVICE').waitFor();
    const badge = tab.page.getByTitle('Card bench is a real one: its motors move.');
    assert.equal(await badge.textContent(), 'REAL CARD bench');
    await pictures(tab);
    await tab.page.getByRole('link', { name: 'registers' }).last().click();
    await tab.page.getByText(/^A real card at port:/).waitFor();
    await tab.page.getByRole('button', { name: /^x\.RR1/ }).waitFor();
    await picture(tab, 'live-registers');
    await tab.page.goBack();

    await call(tab, 'TCurve_C');
    await answered(tab, /^TCurve_C/);
    await panel(tab).getByText('A real card is in service', { exact: false }).waitFor();
    await tab.page.keyboard.press('Escape');
    await state(tab, 'error stop');
    await card.getByText(/is read while it is in service only/).waitFor();
    await tab.page.getByText('SIMULATION').waitFor();
    assert.deepEqual(
      tab.status.alarms.filter((one) => one.source === 'card bench'),
      [],
      'it stands',
    );
    await stopAndRelease(tab);
    await tab.context.close();
  } finally {
    await browser.close();
    await server.stop();
  }
});
