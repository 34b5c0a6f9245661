// Pairing: exchanges the code from the program's start (in the address, or typed) for a token stored in this browser.
import { signal } from '@preact/signals';
import { Refusal, type ErrorBody } from './contract';
import { notice, sentence } from './commands';
import { showToken, TOKEN_KEY } from './socket';
import { decoded } from '../view';

export const dialogOpen = signal(false);
export const inviteOpen = signal(false);
/** Code in the dialog. */
export const codeText = signal('');
export const nameText = signal(localStorage.getItem('motionrack.name') ?? '');
export const whyNotPaired = signal('');

/** A unique name for a user who entered none. */
const freshName = (): string => `browser-${crypto.getRandomValues(new Uint16Array(1))[0]?.toString(16) ?? ''}`;

export async function pair(code: string, name: string): Promise<void> {
  const answer = await fetch('api/pair', {
    method: 'POST',
    headers: { 'content-type': 'application/json' },
    body: JSON.stringify({ code: code.trim().toUpperCase(), name: name.trim() }),
  });
  const body = (await answer.json()) as { token?: string; error?: ErrorBody };
  if (!answer.ok || body.token === undefined)
    throw new Refusal(
      body.error ?? {
        kind: 'denied',
        message: `The program answered ${answer.status}; this browser is not paired.`,
      },
    );
  localStorage.setItem(TOKEN_KEY, body.token);
  await showToken();
}

/** Revokes the token. If the program does not answer, the token stays valid there until it expires. */
export async function forget(): Promise<void> {
  const token = localStorage.getItem(TOKEN_KEY);
  localStorage.removeItem(TOKEN_KEY);
  try {
    await fetch('api/forget', { method: 'POST', headers: { authorization: `Bearer ${token ?? ''}` }, body: '{}' });
  } catch {
    // The program is not reachable.
  }
  location.reload();
}

/** Reads "#pair=CODE" and removes it from the address at once, so that it is neither bookmarked nor shared. */
export async function pairFromAddress(): Promise<void> {
  const found = /(?:^#|&)pair=([^&]+)/.exec(location.hash);
  if (found === null) return;
  history.replaceState(null, '', location.pathname + location.search);
  const code = decoded(found[1] ?? '');
  try {
    await pair(code, nameText.value || freshName());
    notice('done', 'This browser is paired.');
  } catch (why) {
    codeText.value = code;
    whyNotPaired.value = sentence(why);
    dialogOpen.value = true;
  }
}
