// A rack without axes: its cards can be operated, and the page has no controls to move an axis.
import assert from 'node:assert/strict';
import test from 'node:test';
import { answered, call } from './library.mjs';
import { openTab, pause, picture, RACKS, suite } from './support.mjs';

const all = suite(test, RACKS.cards);

test('a rack without axes shows its cards in place of axes, and each works', async () => {
  const tab = await openTab(all.browser, all.server);
  await tab.page.getByText('This rack has no axes').waitFor();
  for (const title of ['Axes', 'Jog', 'Program', 'MDI', 'Overrides'])
    assert.equal(await tab.page.getByRole('region', { name: title, exact: true }).count(), 0, title);
  for (const scheme of ['light', 'dark'])
    for (const width of [1440, 760, 420]) {
      await tab.page.emulateMedia({ colorScheme: scheme });
      await tab.page.setViewportSize({ width, height: 900 });
      await pause(400); // until the transition of colours has ended
      await picture(tab, `cards-alone-${scheme}-${width}`);
    }
  await tab.page.setViewportSize({ width: 1440, height: 900 });
  await tab.page.getByRole('button', { name: 'Take control' }).click();
  await tab.page.getByText('You hold control').waitFor();
  await tab.page.getByRole('link', { name: /bench/ }).click();
  await call(tab, 'SetRange', { data: 800000 });
  await answered(tab, 'Written.');
  assert.deepEqual(tab.troubles, []);
  await tab.context.close();
});
