// Lines by hand, with what was sent before: up and down bring it back.
import { signal } from '@preact/signals';
import type { JSX } from 'preact';
import { useRef } from 'preact/hooks';
import { mayOperate, sentence } from '../link/orders';
import { ask } from '../link/socket';
import { Icon } from '../parts/icons';
import { Button, Empty, Panel } from '../parts/ui';

interface Sent {
  text: string;
  answer: string;
  good: boolean;
}

const KEY = 'motionrack.mdi';
const KEPT = 100;
const log = signal<Sent[]>([]);
const history = signal<string[]>(JSON.parse(localStorage.getItem(KEY) ?? '[]') as string[]);
const draft = signal('');
const place = signal(-1);

async function send(): Promise<void> {
  const text = draft.value.trim();
  if (text === '') return;
  draft.value = '';
  place.value = -1;
  history.value = [text, ...history.value.filter((one) => one !== text)].slice(0, KEPT);
  localStorage.setItem(KEY, JSON.stringify(history.value));
  const one: Sent = { text, answer: '…', good: true };
  log.value = [...log.value, one].slice(-KEPT);
  const answer = await ask({ order: 'line', text }).then(
    () => ({ answer: 'ok', good: true }),
    (why: unknown) => ({ answer: sentence(why), good: false }),
  );
  log.value = log.value.map((other) => (other === one ? { ...one, ...answer } : other));
}

function walk(by: number): void {
  const next = Math.min(history.value.length - 1, Math.max(-1, place.value + by));
  place.value = next;
  draft.value = next < 0 ? '' : (history.value[next] ?? '');
}

export function Mdi(): JSX.Element {
  const field = useRef<HTMLInputElement>(null);
  const why = mayOperate();
  const down = (event: KeyboardEvent): void => {
    if (event.key === 'Enter' && why === '') void send();
    else if (event.key === 'ArrowUp') walk(1);
    else if (event.key === 'ArrowDown') walk(-1);
    else return;
    event.preventDefault();
  };
  return (
    <Panel title="Console" class="mdi">
      <div class="log" role="log" aria-label="Lines sent and their answers" tabIndex={0}>
        {log.value.length === 0 && <Empty>Lines of G-code, driven one by one: G0 X10, G92 X0, M3 S1000.</Empty>}
        {log.value.slice(-30).map((one, i) => (
          <p key={i} class={one.good ? 'good' : 'bad'}>
            <code>{one.text}</code>
            <span>
              {!one.good && <Icon name="alarm" size={13} />}
              {one.answer}
            </span>
          </p>
        ))}
      </div>
      <div class="entry-row">
        <input
          ref={field}
          type="text"
          class="mdi-line"
          aria-label="Line of G-code"
          placeholder="G-code line"
          autocomplete="off"
          spellcheck={false}
          value={draft.value}
          onInput={(event) => (draft.value = event.currentTarget.value)}
          onKeyDown={down}
        />
        <Button why={why} machine onClick={() => void send()}>
          Send
        </Button>
      </div>
    </Panel>
  );
}
