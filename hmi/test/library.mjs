// Actions of a user in the panel of a card's function library.
export const panel = (tab) => tab.page.getByRole('region', { name: 'Functions of its library' });
const calls = (tab) => panel(tab).getByRole('log', { name: 'Calls' });

export async function choose(tab, name) {
  await panel(tab).getByLabel('Search functions').fill(name);
  await panel(tab)
    .getByRole('region', { name: 'List of functions' })
    .getByRole('button', { name, exact: true })
    .click();
  await panel(tab).getByRole('form', { name, exact: true }).waitFor();
}
export async function call(tab, name, texts = {}) {
  await choose(tab, name);
  for (const [label, text] of Object.entries(texts))
    await panel(tab).getByLabel(label, { exact: true }).fill(String(text));
  await panel(tab)
    .getByRole('button', { name: `Call ${name}`, exact: true })
    .click();
}
export const answered = (tab, text) => calls(tab).getByText(text).first().waitFor();
/** Drives X by 500 pulses and waits for the end. */
export async function driveX(tab) {
  await call(tab, 'TCurve_F', { m_Pulse: 500 });
  await answered(tab, 'X drives.');
  await call(tab, 'wait');
  await answered(tab, 'X is at standstill, as commanded.');
  await call(tab, 'ReadLPS');
  await answered(tab, '500 pulses');
}
