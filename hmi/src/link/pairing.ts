// Pairing: a code from the program's start (in the address, or typed) becomes a token that this browser keeps.
import { signal } from '@preact/signals';
import { Refusal, type ErrorBody } from './contract';
import { notice, sentence } from './orders';
import { showToken, TOKEN_KEY } from './socket';

export const dialogOpen = signal(false);

export async function pair(code: string, name: string): Promise<void> {
  const answer = await fetch('api/pair', {
    method: 'POST',
    headers: { 'content-type': 'application/json' },
    body: JSON.stringify({ code: code.trim().toUpperCase(), name: name.trim() }),
  });
  const body = (await answer.json()) as { token?: string; error?: ErrorBody };
  if (!answer.ok || body.token === undefined)
    throw new Refusal(body.error ?? { trouble: 'denied', message: `The program answered ${answer.status}; this browser is not paired.` });
  localStorage.setItem(TOKEN_KEY, body.token);
  await showToken();
}

export function forget(): void {
  localStorage.removeItem(TOKEN_KEY);
  location.reload();
}

/** "#pair=CODE" in the address: taken out of it at once, so that it is neither bookmarked nor sent on. */
export async function pairFromAddress(): Promise<void> {
  const found = /(?:^#|&)pair=([^&]+)/.exec(location.hash);
  if (found === null) return;
  history.replaceState(null, '', location.pathname + location.search);
  try {
    await pair(decodeURIComponent(found[1] ?? ''), localStorage.getItem('motionrack.name') ?? 'browser');
    notice('done', 'This browser is paired.');
  } catch (why) {
    notice('refused', sentence(why));
  }
}
