// Panel of a real card: its address and what its service reads. Independent of the virtual card.
import type { ComponentChildren, JSX } from 'preact';
import { status } from '../link/state';
import type { CardInfo } from '../link/rack';
import { usePoll } from '../parts/poll';
import { Empty, Panel } from '../parts/ui';
import type { CardAnswer } from './peek';

const EVERY_MS = 250;

/** `children`: renders the values that were read last. */
export function LiveCard(props: {
  card: CardInfo;
  place: string;
  children: (seen: CardAnswer) => ComponentChildren;
}): JSX.Element {
  const { card } = props;
  const { data, why } = usePoll<CardAnswer>('card', { name: card.name }, EVERY_MS);
  const seen = data.value;
  const none = why.value !== '' ? why.value : (seen?.reason ?? '');
  const moves = status.value?.service === card.name;
  return (
    <Panel
      title={`${card.name}: ${card.title}`}
      class="wide"
      note="Read through its port after each call and twice a second while it is in service."
      tools={
        <strong class={`livecard ${moves ? 'moves' : ''}`}>{moves ? 'REAL CARD, IN SERVICE' : 'REAL CARD'}</strong>
      }>
      <p>
        At <code>{props.place}</code>. Its motors are real: provide a hard-wired emergency stop. Its limit switches and
        inputs act in the card only and do not stop the machine of the rack.
      </p>
      {seen === null || none !== '' ? <Empty>{none !== '' ? none : 'Reading the card.'}</Empty> : props.children(seen)}
    </Panel>
  );
}
