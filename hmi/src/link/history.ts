// Events from before the page was opened, so that a reload loses none.
import type { MachineEvent } from './contract';
import { query } from './commands';
import { addEvent } from './socket';

export async function loadHistory(): Promise<void> {
  try {
    const answer = await query<{ events?: MachineEvent[] }>('events', { limit: 200 });
    for (const event of answer.events ?? []) addEvent(event);
  } catch {
    // The list then starts with the next events.
  }
}
