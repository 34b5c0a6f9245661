// Pairing: a code from the program's start (in the address, or typed) becomes a token that this browser keeps.
import { signal } from '@preact/signals';
import { Refusal, type ErrorBody } from './contract';
import { notice, sentence } from './commands';
import { showToken, TOKEN_KEY } from './socket';
import { decoded } from '../view';

export const dialogOpen = signal(false);
export const inviteOpen = signal(false);
/** What is in the dialog. */
export const codeText = signal('');
export const nameText = signal(localStorage.getItem('motionrack.name') ?? '');
export const whyNotPaired = signal('');

/** A name that nobody else has, for who did not say one. */
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
        trouble: 'denied',
        message: `The program answered ${answer.status}; this browser is not paired.`,
      },
    );
  localStorage.setItem(TOKEN_KEY, body.token);
  await showToken();
}

/** Gives the token back, which is void from then on. A program that does not answer keeps it until it expires. */
export async function forget(): Promise<void> {
  const token = localStorage.getItem(TOKEN_KEY);
  localStorage.removeItem(TOKEN_KEY);
  try {
    await fetch('api/forget', { method: 'POST', headers: { authorization: `Bearer ${token ?? ''}` }, body: '{}' });
  } catch {
    // There is no program to tell.
  }
  location.reload();
}

/** "#pair=CODE" in the address: taken out of it at once, so that it is neither bookmarked nor sent on. */
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
