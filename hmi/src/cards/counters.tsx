// Counters of an MCX314's channels, shared by the pages of virtual and real cards.
import type { JSX } from 'preact';

export const COUNTERS = [
  { name: 'LP', text: 'pulses sent' },
  { name: 'EP', text: 'encoder counts' },
  { name: 'CV', text: 'present speed' },
  { name: 'CA', text: 'present acceleration' },
] as const;

/** First cells of the table head. */
export function CounterHeads(): JSX.Element {
  return (
    <>
      <th scope="col">Channel</th>
      {COUNTERS.map((one) => (
        <th key={one.name} scope="col" title={one.text}>
          {one.name}
          <small>{one.text}</small>
        </th>
      ))}
    </>
  );
}
