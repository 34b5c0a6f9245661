// What happened before the page was opened: a reload loses nothing.
import type { MachineEvent } from './contract';
import { query } from './commands';
import { addEvent } from './socket';

export async function loadHistory(): Promise<void> {
  try {
    const answer = await query<{ events?: MachineEvent[] }>('events', { limit: 200 });
    for (const event of answer.events ?? []) addEvent(event);
  } catch {
    // The list then begins with what comes.
  }
}
