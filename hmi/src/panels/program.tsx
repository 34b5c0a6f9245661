// Program: open, edit, dry run, start, single block, feed hold, stop, and the current line.
import { useSignal, type Signal } from '@preact/signals';
import type { JSX } from 'preact';
import { useRef } from 'preact/hooks';
import { actions, perform } from '../actions';
import { mayOperate, notice, command, sentence, whyNot } from '../link/commands';
import { ask } from '../link/socket';
import { status } from '../link/state';
import { duration, fixed } from '../parts/numbers';
import { ActionButton, Button, Panel, Switch } from '../parts/ui';
import { checked, type Check } from '../path/checked';
import { program, programName } from '../program/text';
import { Listing } from '../program/listing';

/** The program accepts longer messages only from operators. */
const SHORT = 60_000;
const mayCheck = (): string => whyNot(program.value.length > SHORT ? 'operate' : 'observe');

async function check(): Promise<void> {
  try {
    checked.value = (await ask({ command: 'check', name: programName.value, text: program.value })) as unknown as Check;
  } catch (why) {
    checked.value = null;
    notice('refused', sentence(why));
  }
}

async function open(file: File | undefined): Promise<void> {
  if (file === undefined) return;
  programName.value = file.name;
  program.value = await file.text();
  checked.value = null;
}

function Findings({ result }: { result: Check }): JSX.Element {
  const problems = result.problems;
  return (
    <div class="findings">
      {problems.length === 0 ? (
        <dl class="facts-list">
          <div>
            <dt>lines</dt>
            <dd class="tabular">{result.lines}</dd>
          </div>
          <div>
            <dt>takes</dt>
            <dd class="tabular">{duration(result.duration_s)}</dd>
          </div>
          <div>
            <dt>path</dt>
            <dd class="tabular">{fixed(result.length_mm, 1)} mm</dd>
          </div>
          {Object.entries(result.min ?? {}).map(([letter, min]) => (
            <div key={letter}>
              <dt>{letter}</dt>
              <dd class="tabular">
                {fixed(min, 3)} … {fixed(result.max?.[letter], 3)}
              </dd>
            </div>
          ))}
        </dl>
      ) : (
        <ul class="problems" tabIndex={0} aria-label="Problems of the program">
          {problems.map((one, i) => (
            <li key={i}>
              {one.line > 0 ? <strong>Line {one.line}: </strong> : null}
              {one.message}
            </li>
          ))}
          {(result.more_problems ?? 0) > 0 && <li>and {result.more_problems} more</li>}
        </ul>
      )}
    </div>
  );
}

export function Progress(): JSX.Element | null {
  const now = status.value?.program;
  if (now === undefined || now.name === '') return null;
  const part = now.lines > 0 ? Math.min(1, now.line / now.lines) : 0;
  return (
    <div class="progress">
      <div class="words">
        <strong>{now.name}</strong>
        <span class="tabular">
          line {now.line} of {now.lines}
        </span>
        <span class="tabular">
          {now.remaining_s === null ? (now.runs ? 'runs' : 'ended') : `${duration(now.remaining_s)} left`}
        </span>
      </div>
      <progress max="1" value={part} aria-label="Lines of the program that were driven" />
    </div>
  );
}
function Motion(): JSX.Element {
  const runs = status.value?.program.runs === true;
  return (
    <div class="row">
      <ActionButton action={actions.run} icon="run" kind={runs ? 'plain' : 'main'} />
      <ActionButton action={actions.step} icon="step">
        Step
      </ActionButton>
      <ActionButton action={actions.hold} icon="hold">
        Hold
      </ActionButton>
      <Button machine icon="stop" onClick={() => perform(actions.stop)}>
        Stop
      </Button>
    </div>
  );
}

function Editor(): JSX.Element {
  const write = (text: string): void => {
    program.value = text;
    checked.value = null;
  };
  return (
    <textarea
      class="editor"
      aria-label="Program text"
      spellcheck={false}
      value={program.value}
      onInput={(event) => write(event.currentTarget.value)}
    />
  );
}

/** Opens another text, edits, runs the dry check, and selects single block. */
function Work({ editing }: { editing: Signal<boolean> }): JSX.Element {
  const file = useRef<HTMLInputElement>(null);
  const single = status.value?.program.single_block === true;
  return (
    <div class="row">
      <input
        ref={file}
        class="hidden"
        type="file"
        accept=".ngc,.nc,.gcode,.tap,.txt"
        tabIndex={-1}
        aria-label="Program file"
        onChange={(event) => void open(event.currentTarget.files?.[0])}
      />
      <Button icon="open" onClick={() => file.current?.click()}>
        Open
      </Button>
      <Button pressed={editing.value} onClick={() => (editing.value = !editing.value)}>
        Edit
      </Button>
      <Button icon="check" why={mayCheck()} onClick={() => void check()}>
        Check
      </Button>
      <Switch
        on={single}
        label="Single block"
        why={mayOperate()}
        onChange={(on) => void command('set_single_block', { on })}
      />
    </div>
  );
}

export function Program(): JSX.Element {
  const editing = useSignal(false);
  return (
    <Panel
      title="Program"
      class="program"
      tools={
        <span class="file" title={programName.value}>
          {programName.value}
        </span>
      }>
      <Motion />
      <Progress />
      {editing.value ? <Editor /> : <Listing />}
      {checked.value !== null && <Findings result={checked.value} />}
      <Work editing={editing} />
    </Panel>
  );
}
