// Alarm states of ISA-18.2: active or not, acknowledged or not.
import type { Alarm } from './contract';

/** Words for the four states of an alarm. */
export function alarmState(alarm: Alarm): { word: string; tone: string } {
  if (alarm.active)
    return alarm.acknowledged
      ? { word: 'active, acknowledged', tone: 'attention' }
      : { word: 'active, unacknowledged', tone: 'alarm' };
  return alarm.acknowledged ? { word: 'over', tone: 'calm' } : { word: 'returned, unacknowledged', tone: 'attention' };
}
