// MDI lines with history: up and down recall earlier lines.
import type { JSX } from 'preact';
import { useRef } from 'preact/hooks';
import { mayOperate } from '../link/commands';
import { Icon } from '../parts/icons';
import { Button, Empty, Panel } from '../parts/ui';
import { draft, log, send, walk } from './lines';

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
    <Panel title="MDI" class="mdi">
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
