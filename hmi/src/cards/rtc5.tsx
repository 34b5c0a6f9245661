// The RTC5's panel: the work piece as it was marked, the field over it, the beam, the card's flags.
import type { JSX } from 'preact';
import { rack, type CardInfo } from '../link/rack';
import { fixed, unitName } from '../parts/numbers';
import { usePoll } from '../parts/poll';
import { Empty, Panel } from '../parts/ui';
import { Marking } from './marking';
import { Flags, Quantities, wordOf, type CardAnswer } from './peek';

type Place = [number, number];
interface PieceAnswer {
  scanner: string;
  marks: Place[][];
  marking?: [Place, Place];
  points: number;
  lost_points: number;
  marked_mm: number;
  beam: Place;
  laser: boolean;
  /** A square, mm. */
  field: { least: Place; greatest: Place };
  part?: { name: string; unit: string; position: number; speed: number };
}

/** What is to be in sight: the marks; without any, the field. */
function sight(piece: PieceAnswer): [number, number, number, number] {
  const marks = piece.marks.flat();
  const points = marks.length > 0 ? marks : [piece.field.least, piece.field.greatest];
  const xs = points.map(([x]) => x);
  const ys = points.map(([, y]) => y);
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const pad = Math.max(1, 0.04 * Math.max(x1 - x0, y1 - y0));
  return [x0 - pad, -y1 - pad, x1 - x0 + 2 * pad, y1 - y0 + 2 * pad];
}

function Picture({ piece }: { piece: PieceAnswer }): JSX.Element {
  const box = sight(piece);
  const line = (marks: readonly Place[]): string =>
    marks.map(([x, y], i) => `${i === 0 ? 'M' : 'L'}${x} ${-y}`).join('');
  const { beam, field } = piece;
  const strokes = piece.marking === undefined ? piece.marks : [...piece.marks, piece.marking];
  return (
    <svg
      class="piece"
      viewBox={box.join(' ')}
      preserveAspectRatio="xMidYMid meet"
      role="img"
      aria-label={`Work piece under ${piece.scanner}: ${strokes.length} marks`}>
      <rect
        class="field-box"
        x={field.least[0]}
        y={-field.greatest[1]}
        width={field.greatest[0] - field.least[0]}
        height={field.greatest[1] - field.least[1]}
        vector-effect="non-scaling-stroke"
      />
      <path class="marks" d={strokes.map(line).join('')} vector-effect="non-scaling-stroke" />
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
              <dd class="tabular">{fixed(piece.field.greatest[0] - piece.field.least[0], 1)} mm square</dd>
            </div>
            {piece.part !== undefined && (
              <div>
                <dt>{piece.part.name}</dt>
                <dd class="tabular">
                  {fixed(piece.part.position, 2)} {unitName(piece.part.unit)}, {fixed(piece.part.speed, 1)}{' '}
                  {unitName(piece.part.unit)}/s
                </dd>
              </div>
            )}
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
