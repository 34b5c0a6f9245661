// Icons: outlines on a grid of 24, in the colour of the text.
import type { JSX } from 'preact';

const PATHS = {
  stop: 'M8 3h8l5 5v8l-5 5H8l-5-5V8z',
  hold: 'M8 5v14M16 5v14',
  resume: 'M7 4.5v15M11 5l9 7-9 7z',
  run: 'M7 4.5l12 7.5-12 7.5z',
  step: 'M6 5l8 7-8 7zM18 5v14',
  reset: 'M4 12a8 8 0 1 0 2.6-5.9M4 4v4.5h4.5',
  home: 'M4 11.5L12 4l8 7.5M6.5 10v9.5h11V10',
  power: 'M12 3v8M6.6 6.6a8 8 0 1 0 10.8 0',
  alarm: 'M12 3.5L22 20.5H2zM12 10v5M12 17.4v.6',
  check: 'M4.5 12.5l5 5 10-11',
  moving: 'M3 12h16M13 6l6 6-6 6',
  standstill: 'M5 5h14v14H5z',
  jogging: 'M12 3v18M3 12h18M12 3l-3 3M12 3l3 3M12 21l-3-3M12 21l3-3M3 12l3-3M3 12l3 3M21 12l-3-3M21 12l-3 3',
  disabled: 'M12 4a8 8 0 1 0 0 16a8 8 0 1 0 0-16M6.5 6.5l11 11',
  stopping: 'M4 12h9M13 5v14M17 5v14',
  link: 'M3 16a13 13 0 0 1 18 0M6.5 12a8.5 8.5 0 0 1 11 0M10 8.4a4 4 0 0 1 4 0M12 20v.1',
  lost: 'M4 4l16 16M3 16a13 13 0 0 1 9-4M14 12.4a13 13 0 0 1 7 3.6M12 20v.1',
  hand: 'M8 12V5.5a1.5 1.5 0 0 1 3 0V11V4a1.5 1.5 0 0 1 3 0v7V5.5a1.5 1.5 0 0 1 3 0V15a6 6 0 0 1-6 6c-3 0-4.500-1.500-6-4.500L4 14a1.600 1.600 0 0 1 2.600-1.600L8 14z',
  clock: 'M12 4a8 8 0 1 0 0 16a8 8 0 1 0 0-16M12 7.500V12l3 2',
  user: 'M12 4a4 4 0 1 0 0 8a4 4 0 1 0 0-8M4.500 20.500a7.500 7.500 0 0 1 15 0',
  sun: 'M12 8a4 4 0 1 0 0 8a4 4 0 1 0 0-8M12 2v2.500M12 19.500V22M2 12h2.500M19.500 12H22M5 5l1.700 1.700M17.300 17.300L19 19M19 5l-1.700 1.700M6.700 17.300L5 19',
  moon: 'M20 14.500A8.500 8.500 0 1 1 9.500 4A7 7 0 0 0 20 14.500z',
  keys: 'M3 7h18v10H3zM7 10.500v.1M11 10.500v.1M15 10.500v.1M17.500 13.500v.1M8 13.800h7',
  close: 'M5.500 5.500l13 13M18.500 5.500l-13 13',
  left: 'M15 5l-7 7 7 7',
  right: 'M9 5l7 7-7 7',
  up: 'M5 15l7-7 7 7',
  down: 'M5 9l7 7 7-7',
  open: 'M3 19V5h6l2 2.500h10V19z',
  save: 'M12 4v11M7 10.500l5 5 5-5M4 20h16',
  large: 'M4 19L9 6l5 13M5.700 15h6.600M16 19v-8M16 11h4',
  pause: 'M9 6v12M15 6v12',
  zero: 'M12 3v18M3 12h18M12 8a4 4 0 1 0 0 8a4 4 0 1 0 0-8',
} as const;

export type IconName = keyof typeof PATHS;

const SOLID: ReadonlySet<IconName> = new Set(['stop', 'run', 'standstill']);

export function Icon({ name, size = 18 }: { name: IconName; size?: number }): JSX.Element {
  return (
    <svg
      class="icon"
      width={size}
      height={size}
      viewBox="0 0 24 24"
      aria-hidden="true"
      focusable="false"
      fill={SOLID.has(name) ? 'currentColor' : 'none'}
      stroke="currentColor"
      stroke-width="2"
      stroke-linecap="round"
      stroke-linejoin="round">
      <path d={PATHS[name]} />
    </svg>
  );
}
