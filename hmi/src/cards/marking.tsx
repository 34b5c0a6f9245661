// Marking with a scan head of the rack: a job as text, run at once or on each arriving part.
import { signal } from '@preact/signals';
import type { JSX } from 'preact';
import { useId } from 'preact/hooks';
import { mayOperate, notice, command, commandFor } from '../link/commands';
import type { CardInfo } from '../link/rack';
import { Button, Choice, Panel } from '../parts/ui';

const EXAMPLE = `[[drawing]]
text = "Motionrack"
height_mm = 5

[pace]
mark_speed_mm_s = 500
jump_speed_mm_s = 3000

[fly]
mode = "encoder"
`;
const job = signal(localStorage.getItem('motionrack.job') ?? EXAMPLE);
const start = signal<'now' | 'parts'>('parts');

async function mark(card: string): Promise<void> {
  localStorage.setItem('motionrack.job', job.value);
  const reply = await commandFor('mark', { card, job: job.value, start: start.value });
  if (reply === null) return;
  const notes = Array.isArray(reply.notes) ? (reply.notes as string[]) : [];
  notice(
    'done',
    [`${(reply.commands as number | undefined) ?? ''} commands are in the card's list.`, ...notes].join(' '),
  );
}

export function Marking({ card }: { card: CardInfo }): JSX.Element {
  const id = useId();
  const why = mayOperate();
  return (
    <Panel title="Mark" class="marking">
      <label class="hint" for={id}>
        Marking job (TOML); optics, laser and belt are the rack's
      </label>
      <textarea
        id={id}
        class="editor"
        spellcheck={false}
        value={job.value}
        onInput={(event) => (job.value = event.currentTarget.value)}
      />
      <div class="row">
        <Choice
          label="When"
          value={start.value}
          onChange={(to) => (start.value = to)}
          options={[
            { value: 'now', text: 'at once' },
            { value: 'parts', text: 'each part' },
          ]}
        />
        <Button why={why} kind="main" icon="run" onClick={() => void mark(card.name)}>
          Mark
        </Button>
        <Button why={why} icon="standstill" onClick={() => void command('mark_stop', { card: card.name })}>
          Stop marking
        </Button>
      </div>
    </Panel>
  );
}
