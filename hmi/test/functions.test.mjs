// Calls of a card's library functions from the page: the service, a form, its answers, and STOP while a function waits.
import assert from 'node:assert/strict';
import test from 'node:test';
import { answered, call, choose, driveX, panel } from './library.mjs';
import { named, openTab, picture, show, state, stopAndRelease, suite, takeControl, until } from './support.mjs';

const all = suite(test);

test('functions are called in the service of the card, and STOP ends one that waits', async () => {
  const tab = await openTab(all.browser, all.server);
  await takeControl(tab);
  await show(tab, 'cards/motion');
  await choose(tab, 'SetRange');
  const button = panel(tab).getByRole('button', { name: 'Call SetRange', exact: true });
  assert.equal(await button.getAttribute('aria-disabled'), 'true', 'not before the service');
  await panel(tab).getByRole('button', { name: 'Begin service' }).click();
  await state(tab, 'service');
  await answered(tab, /only its functions drive it/);
  const home = tab.page.getByRole('region', { name: 'Moves and homing' }).getByRole('button', { name: 'Home X' });
  assert.match(await home.getAttribute('title'), /^Card motion is in service/, 'nothing else drives the machine');
  await call(tab, 'SetRange', { data: 800000 });
  await answered(tab, 'Written.');
  await call(tab, 'SetV', { data: 9000 });
  await tab.page
    .getByText(/must be 1 to/)
    .first()
    .waitFor();
  await driveX(tab);
  for (const scheme of ['light', 'dark'])
    for (const width of [1280, 760]) {
      await tab.page.emulateMedia({ colorScheme: scheme });
      await tab.page.setViewportSize({ width, height: 900 });
      await choose(tab, 'Line3D_S');
      await panel(tab).scrollIntoViewIfNeeded();
      await picture(tab, `functions-${scheme}-${width}`, 2200);
    }
  await call(tab, 'TCurve_C');
  await answered(tab, /^TCurve_C/);
  await call(tab, 'wait', { milliseconds: 60000 });
  await until(() => named(tab, 'call').at(-1).function === 'wait', 'it waits');
  await tab.page.keyboard.press('Escape');
  await state(tab, 'error stop');
  await answered(tab, /Stopped on request/);
  assert.equal(tab.status.service, '');
  await stopAndRelease(tab);
  assert.deepEqual(
    tab.troubles.filter((one) => !one.includes('409')),
    [],
  );
  await tab.context.close();
});
