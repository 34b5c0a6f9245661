// Program lines around the current one. Renders only visible lines, so that long programs scroll.
import { computed, useSignal } from '@preact/signals';
import type { JSX } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import { status } from '../link/state';
import { Empty } from '../parts/ui';
import { program, running } from './text';

const ROW = 22;
const MORE = 8;

const shown = computed(() => running.value?.text ?? program.value);
const lines = computed(() => shown.value.split(/\r?\n/));
/** 1-based; 0: not in this text. */
const current = computed(() => {
  const now = status.value?.program;
  return now?.runs === true && running.value !== null ? now.line : 0;
});

export function Listing(): JSX.Element {
  const box = useRef<HTMLDivElement>(null);
  const top = useSignal(0);
  const height = useSignal(300);
  useEffect(() => {
    const element = box.current;
    if (element === null) return undefined;
    const watch = new ResizeObserver(() => (height.value = element.clientHeight));
    watch.observe(element);
    return () => watch.disconnect();
  }, [height]);
  const line = current.value;
  useEffect(() => {
    const element = box.current;
    if (element !== null && line > 0) element.scrollTop = Math.max(0, (line - 1) * ROW - element.clientHeight / 2);
  }, [line]);
  if (shown.value === '') return <Empty>No program. Open a file, or press Edit and type one.</Empty>;
  const first = Math.max(0, Math.floor(top.value / ROW) - MORE);
  const last = Math.min(lines.value.length, Math.ceil((top.value + height.value) / ROW) + MORE);
  return (
    <div
      class="listing"
      ref={box}
      tabIndex={0}
      role="region"
      aria-label="Program lines"
      onScroll={(event) => (top.value = event.currentTarget.scrollTop)}>
      <div class="whole" style={{ height: `${lines.value.length * ROW}px` }}>
        <ol style={{ transform: `translateY(${first * ROW}px)` }}>
          {lines.value.slice(first, last).map((text, i) => (
            <li
              key={first + i}
              class={first + i + 1 === line ? 'current' : ''}
              aria-current={first + i + 1 === line ? 'step' : undefined}>
              <span class="number">{first + i + 1}</span>
              <code>{text}</code>
            </li>
          ))}
        </ol>
      </div>
    </div>
  );
}
