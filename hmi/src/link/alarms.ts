// Alarms as ISA-18.2 has them: active or not, acknowledged or not.
import type { Alarm } from './contract';

/** The four states of an alarm, in words. */
export function alarmState(alarm: Alarm): { word: string; tone: string } {
  if (alarm.active)
    return alarm.acknowledged
      ? { word: 'active, acknowledged', tone: 'attention' }
      : { word: 'active, unacknowledged', tone: 'alarm' };
  return alarm.acknowledged ? { word: 'over', tone: 'calm' } : { word: 'returned, unacknowledged', tone: 'attention' };
}
