// Messages of the program according to the panel's contract: greeting, status, events, errors.

export type Role = 'none' | 'observe' | 'operate' | 'maintain';
export const ROLES: readonly Role[] = ['none', 'observe', 'operate', 'maintain'];

export interface Hello {
  version: string;
  rack: string;
  boot: string;
  role: Role;
  simulation: boolean;
  session?: string;
  user?: string;
}

/** State names as written; blanks and underscores are equivalent. */
export type StateName =
  'disabled' | 'standstill' | 'homing' | 'moving' | 'jogging' | 'hold' | 'stopping' | 'error stop' | 'service';

export const LEDS = [
  'soft_minus',
  'soft_plus',
  'hard_minus',
  'hard_plus',
  'home',
  'cam',
  'index',
  'capture',
  'compare',
  'in_position',
  'alarm',
] as const;
export type LedName = (typeof LEDS)[number];

export interface AxisStatus {
  letter: string;
  unit: string;
  position_valid: boolean;
  enabled: boolean;
  can_home: boolean;
  commanded: number;
  actual: number;
  error: number;
  velocity: number;
  pulses: number;
  counts: number;
  min: number;
  max: number;
  max_velocity: number;
  leds: Partial<Record<LedName, boolean>>;
}

export interface Alarm {
  number: number;
  at: number;
  text: string;
  source?: string;
  active: boolean;
  acknowledged: boolean;
}

export interface Status {
  at: number;
  sequence: number;
  state: string;
  reason: string;
  /** Card whose functions are called manually; empty: none. */
  service?: string;
  simulation: boolean;
  clock: { mode: 'real' | 'unthrottled' | 'paused'; factor: number; late_ms: number };
  estop: { wired: boolean; pressed: boolean };
  control: { holder: string | null; holder_session?: string; since?: number };
  axes: AxisStatus[];
  program: {
    name: string;
    runs: boolean;
    line: number;
    lines: number;
    remaining_s: number | null;
    single_block: boolean;
  };
  overrides: { feed: number; rapid: number };
  alarms: Alarm[];
  homing?: { runs: boolean; phases: Record<string, string> };
  link?: { sender: string; clients: number };
}

export interface Picture {
  seq: number;
  lost: number;
  at: number;
  status: Status;
  values?: (number | null)[];
}

export interface MachineEvent {
  number: number;
  at: number;
  kind: string;
  text: string;
  data?: unknown;
}

export interface ErrorBody {
  kind: string;
  message: string;
  line?: number;
  column?: number;
}

/** A rejection by the program, with its sentence. */
export class Refusal extends Error {
  constructor(readonly body: ErrorBody) {
    super(body.message);
  }
}

export type Fields = Record<string, unknown>;
export type Reply = Record<string, unknown>;
