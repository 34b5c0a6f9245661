// Panel of the RTC5: the marked workpiece, the field above it, the beam, the card's flags.
import type { JSX } from 'preact';
import { rack, type CardInfo } from '../link/rack';
import { fixed } from '../parts/numbers';
import { usePoll } from '../parts/poll';
import { Empty, Panel } from '../parts/ui';
import { Carrier } from './carrier';
import { Marking } from './marking';
import { Flags, Quantities, wordOf, type CardAnswer } from './peek';
import { pathOf, sight, strokesOf, type PieceAnswer } from './piece';

function Picture({ piece }: { piece: PieceAnswer }): JSX.Element {
  const box = sight(piece);
  const { beam, field } = piece;
  const strokes = strokesOf(piece);
  return (
    <svg
      class="piece"
      viewBox={box.join(' ')}
      preserveAspectRatio="xMidYMid meet"
      role="img"
      aria-label={`Work piece under ${piece.scanner}: ${strokes.length} marks`}>
      <rect
        class="field-box"
        x={field.min[0]}
        y={-field.max[1]}
        width={field.max[0] - field.min[0]}
        height={field.max[1] - field.min[1]}
        vector-effect="non-scaling-stroke"
      />
      <path class="marks" d={pathOf(strokes)} vector-effect="non-scaling-stroke" />
      <circle
        class={`beam ${piece.laser ? 'on' : ''}`}
        cx={beam[0]}
        cy={-beam[1]}
        r={box[2] / 90}
        vector-effect="non-scaling-stroke"
      />
    </svg>
  );
}

function WorkPiece({ scanner }: { scanner: string }): JSX.Element {
  const { data, why } = usePoll<PieceAnswer>('workpiece', { scanner }, 300);
  const piece = data.value;
  return (
    <Panel title={`Work piece under ${scanner}`} class="wide workpiece">
      {piece === null ? (
        <Empty>{why.value || 'Asking for the work piece …'}</Empty>
      ) : (
        <>
          <Picture piece={piece} />
          <dl class="facts-list">
            <div>
              <dt>marks</dt>
              <dd class="tabular">
                {piece.marks.length}, {fixed(piece.marked_mm, 1)} mm
              </dd>
            </div>
            <div>
              <dt>beam</dt>
              <dd class="tabular">
                {fixed(piece.beam[0], 3)}, {fixed(piece.beam[1], 3)} mm
              </dd>
            </div>
            <div>
              <dt>laser</dt>
              <dd>{piece.laser ? 'on' : 'off'}</dd>
            </div>
            <div>
              <dt>field</dt>
              <dd class="tabular">{fixed(piece.field.max[0] - piece.field.min[0], 1)} mm square</dd>
            </div>
            {piece.part !== undefined && <Carrier part={piece.part} />}
            {piece.lost_points > 0 && (
              <div>
                <dt>not kept</dt>
                <dd class="tabular">{piece.lost_points} points</dd>
              </div>
            )}
          </dl>
        </>
      )}
    </Panel>
  );
}

export function Laser({ card }: { card: CardInfo }): JSX.Element {
  const { data } = usePoll<CardAnswer>('card', { name: card.name }, 200);
  const shown = card.registers.filter((one) => wordOf(data.value, one.name) !== null && one.fields.length > 0);
  return (
    <>
      {(rack.value?.parts ?? [])
        .filter((one) => one.kind === 'scanner' && one.card === card.name)
        .map((one) => (
          <WorkPiece key={one.name} scanner={one.name} />
        ))}
      <Marking card={card} />
      <Panel title={`${card.name}: ${card.title}`}>
        {shown.map((one) => (
          <Flags key={one.name} register={one} word={wordOf(data.value, one.name)} />
        ))}
        <Quantities card={card} />
      </Panel>
    </>
  );
}
