// The RTC5's panel: the work piece as it was marked, the field over it, the beam, the card's flags.
import type { JSX } from 'preact';
import { rack, type CardInfo } from '../link/rack';
import { fixed } from '../parts/numbers';
import { usePoll } from '../parts/poll';
import { Empty, Panel } from '../parts/ui';
import { Flags, Quantities, wordOf, type CardAnswer } from './peek';

interface PieceAnswer {
  scanner?: string;
  unit?: string;
  field?: { least: [number, number]; greatest: [number, number] };
  marks?: [number, number][][];
  part?: { name?: string; position?: number; speed?: number } | null;
  beam?: [number, number];
  laser?: boolean;
}

/** What is to be in sight: the field, or the marks where they reach farther. */
function sight(piece: PieceAnswer): [number, number, number, number] {
  const points = [...(piece.marks ?? []).flat(), ...(piece.field === undefined ? [] : [piece.field.least, piece.field.greatest])];
  if (points.length === 0) return [-50, -50, 100, 100];
  const xs = points.map(([x]) => x);
  const ys = points.map(([, y]) => y);
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const pad = Math.max(1, 0.04 * Math.max(x1 - x0, y1 - y0));
  return [x0 - pad, -y1 - pad, x1 - x0 + 2 * pad, y1 - y0 + 2 * pad];
}

function Picture({ piece }: { piece: PieceAnswer }): JSX.Element {
  const box = sight(piece);
  const line = (marks: [number, number][]): string => marks.map(([x, y], i) => `${i === 0 ? 'M' : 'L'}${x} ${-y}`).join('');
  const field = piece.field;
  return (
    <svg class="piece" viewBox={box.join(' ')} preserveAspectRatio="xMidYMid meet" role="img" aria-label={`Work piece of ${piece.scanner ?? 'the scan head'}: ${(piece.marks ?? []).length} marks`}>
      {field !== undefined && <rect class="field-box" x={field.least[0]} y={-field.greatest[1]} width={field.greatest[0] - field.least[0]} height={field.greatest[1] - field.least[1]} vector-effect="non-scaling-stroke" />}
      <path class="marks" d={(piece.marks ?? []).map(line).join('')} vector-effect="non-scaling-stroke" />
      {piece.beam !== undefined && <circle class={`beam ${piece.laser === true ? 'on' : ''}`} cx={piece.beam[0]} cy={-piece.beam[1]} r={box[2] / 90} vector-effect="non-scaling-stroke" />}
    </svg>
  );
}

function WorkPiece({ scanner }: { scanner: string }): JSX.Element {
  const { data, why } = usePoll<PieceAnswer>('workpiece', { scanner }, 300);
  const piece = data.value;
  return (
    <Panel title={`Work piece under ${scanner}`} class="wide workpiece">
      {piece === null ? <Empty>{why.value || 'Asking for the work piece …'}</Empty> : (
        <>
          <Picture piece={piece} />
          <dl class="facts-list">
            <div><dt>marks</dt><dd class="tabular">{(piece.marks ?? []).length}</dd></div>
            {piece.beam !== undefined && <div><dt>beam</dt><dd class="tabular">{fixed(piece.beam[0], 3)}, {fixed(piece.beam[1], 3)} {piece.unit ?? 'mm'}</dd></div>}
            <div><dt>laser</dt><dd>{piece.laser === true ? 'on' : 'off'}</dd></div>
            {piece.part != null && <div><dt>{piece.part.name ?? 'part'}</dt><dd class="tabular">{fixed(piece.part.position, 2)} at {fixed(piece.part.speed, 1)} /s</dd></div>}
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
      {(rack.value?.scanners ?? []).map((scanner) => <WorkPiece key={scanner} scanner={scanner} />)}
      <Panel title={`${card.name}: ${card.title}`} class="wide">
        {shown.map((one) => <Flags key={one.name} register={one} word={wordOf(data.value, one.name)} />)}
        <Quantities card={card} />
      </Panel>
    </>
  );
}
