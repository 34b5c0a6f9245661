"""The C++ side of the package; made by python/tools/stubs.py."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt


class RackHandle:
    """A rack; use motionrack.Rack."""
    def config(self) -> dict[str, Any]: ...
    def closed(self) -> bool: ...
    def started(self) -> bool: ...
    def ticks(self) -> int: ...
    def events(self) -> int: ...
    def trace_hash(self) -> str: ...
    def state_hash(self) -> str: ...
    def conditions(self) -> list[Any]: ...
    def wire(self, name: str) -> float: ...
    def wires(self) -> dict[str, Any]: ...
    def quantity(self, name: str) -> float: ...
    def quantities(self) -> dict[str, Any]: ...
    def fault_targets(self) -> dict[str, Any]: ...
    def not_done(self) -> list[str]: ...
    def close(self) -> None: ...
    def start(self) -> None: ...
    def advance(self, ticks: int) -> None: ...
    def wait_wire(self, name: str, level: int, ticks: int) -> bool: ...
    def set_wire(self, name: str, value: float) -> None: ...
    def release_wire(self, name: str) -> None: ...
    def set_quantity(self, name: str, value: float) -> None: ...
    def fault(self, fault: str, target: str) -> None: ...
    def plan_faults(self, texts: Sequence[str]) -> None: ...
    def set_card(self, card: str, key: str, value: float) -> None: ...
    def begin_samples(self, names: Sequence[str], period: int, max_samples: int) -> None: ...
    def end_samples(self) -> tuple[Any, ...]: ...
    def begin_waves(self, path: str, signals: Sequence[str]) -> None: ...
    def end_waves(self) -> None: ...
    def copy(self) -> RackHandle: ...
    def new_instance(self) -> RackHandle: ...
    def copy_from(self, other: RackHandle) -> None: ...

def open_file(path: str) -> tuple[Any, ...]: ...
def open_text(text: str, name: str) -> tuple[Any, ...]: ...
def template_text(name: str) -> str: ...
def template_names() -> list[str]: ...

class Ran:
    """Result of a program run; programs use motionrack.Outcome."""
    def error(self) -> Any: ...
    def data(self) -> dict[str, Any]: ...
    def samples(self) -> tuple[Any, ...]: ...
    def summary(self) -> str: ...
    def json(self) -> str: ...
    def svg(self, perspective: bool) -> str: ...
    def write_report(self, path: str) -> None: ...
    def write_csv(self, path: str) -> None: ...
    def write_events(self, path: str) -> None: ...


class Program:
    """A part program's text and what goes with it."""
    def __init__(self, text: str, name: str, folder: str, tools: str, tools_name: str, block_delete: bool) -> None: ...

def run(world: RackHandle, program: Program, sample_ticks: int, profile: str | None, faults: Sequence[str], progress: Any) -> Ran: ...
def check(world: RackHandle, program: Program) -> None: ...
def home(world: RackHandle, axes: str, type: int | None, ticks: int) -> tuple[Any, ...]: ...

class SteppedMachine:
    """A machine; use motionrack.Machine."""
    def __init__(self, world: RackHandle) -> None: ...
    def hold(self) -> None: ...
    def resume(self) -> None: ...
    def stop(self) -> None: ...
    def reset(self) -> None: ...
    def enable(self, on: bool, axes: str) -> None: ...
    def start_program(self, program: str, name: str) -> None: ...
    def set_overrides(self, feed: float, rapid: float) -> None: ...
    def acknowledge_alarm(self, alarm: int) -> bool: ...
    def home(self, axes: str) -> None: ...
    def jog(self, axis: str, speed: float) -> None: ...
    def jog_by(self, axis: str, distance: float, speed: float) -> None: ...
    def set_position(self, axis: str, position: float) -> None: ...
    def advance(self, ticks: int) -> None: ...
    def status(self) -> dict[str, Any]: ...
    def trace_hash(self) -> str: ...
    def wire(self, name: str) -> float: ...
    def set_wire(self, name: str, value: float | None) -> None: ...
    def quantity(self, name: str) -> float: ...
    def fault(self, fault: str, target: str) -> None: ...

def describe_card(world: RackHandle, card: str) -> dict[str, Any]: ...
def peek(world: RackHandle, card: str, name: str) -> int: ...
def read(world: RackHandle, card: str, bits: int, address: int) -> int: ...
def write(world: RackHandle, card: str, bits: int, address: int, value: int) -> None: ...
def wait_interrupt(world: RackHandle, card: str, ticks: int) -> bool: ...
def view(world: RackHandle, card: str, clearing: bool) -> str: ...
def svg_timeline(title: str, seconds: npt.ArrayLike, charts: Sequence[tuple[str, Sequence[tuple[str, str, npt.ArrayLike]]]], spans: Sequence[tuple[str, float, float]], width: int, height: int) -> str: ...

class LivePort:
    """A real card behind a live port, with a stop that holds; motionrack.LiveCard has its registers by their names."""
    def __init__(self, place: str, type: str, select: int = 13) -> None:
        """Opens the port; no register is written. InvalidInput, FileError, Refused."""
    def map(self) -> dict[str, Any]:
        """Declaration of the card: registers, bits, states."""
    def now(self) -> float:
        """Seconds of the computer's clock since it was opened. Refused once it was closed."""
    def read(self, offset: int) -> int:
        """Reads a register at its offset, with all side effects."""
    def write(self, offset: int, value: int) -> None:
        """Writes a register at its offset, with all side effects; value 0 to 65535, or 0 to 255 at a byte port."""
    def view(self, clearing: bool) -> str:
        """Describes the value of every register."""
    def wait_interrupt(self, timeout: float) -> bool:
        """Whether its interrupt came within timeout s."""
    def quick_stop(self) -> None:
        """All axes stop, and nothing is written until reset_stop."""
    def reset_stop(self) -> None:
        """Releases the stop; nothing moves by that."""
    def stopped(self) -> bool:
        """Whether a stop is active."""
    def close(self) -> None:
        """Stops all axes and closes the card."""
    def closed(self) -> bool:
        """Whether the card was closed."""


class Mcx314:
    """The MCX314's function library, under its source's names and in its register units. `axes` is a mask: X 1, Y 2, Z 4, U 8 and their sums; `axis` is a channel: 0 X, 1 Y, 2 Z, 3 U."""
    def __init__(self, world: RackHandle, card: str) -> None: ...
    @staticmethod
    def of_live_port(card: LivePort) -> Mcx314:
        """Of a real card. Refused where it has a driver."""
    def RESET(self) -> None:
        """Software reset of the chip; waits its 875 ns."""
    def initialise(self) -> None:
        """RESET, then every mode register, AO, LP and EP written 0."""
    def SetPulseMode(self, axes: int, mode: int) -> None:
        """Pulse output: mode 0 two pulse trains, 1 pulse and direction."""
    def SetMultiple(self, axes: int, value: int) -> None:
        """The multiple M, 1 to 500: pulses a second = V * M. Writes R = 8,000,000 / M. Not while driving."""
    def SetRange(self, axes: int, value: int) -> None:
        """R, 16,000 to 8,000,000: pulses a second = V * 8,000,000 / R. Not while driving."""
    def SetMaxSpeed(self, axes: int, value: int) -> None:
        """The smallest whole multiple with which V <= 8,000 reaches this speed, 1 to 4,000,000 pulses a second."""
    def SetSV(self, axes: int, value: int) -> None:
        """Initial speed, 1 to 8,000 units of the multiple."""
    def SetV(self, axes: int, value: int) -> None:
        """Drive speed, 1 to 8,000 units of the multiple; also while driving."""
    def SetA(self, axes: int, value: int) -> None:
        """Acceleration, 1 to 8,000 units of 125 * M pulses/s2."""
    def SetD(self, axes: int, value: int) -> None:
        """Deceleration, 1 to 8,000 units of 125 * M pulses/s2; used where SetAsymmetric is on."""
    def SetAA(self, axes: int, value: int) -> None:
        """K, 1 to 65,535: the jerk is 62.5e6 / K * M pulses/s3."""
    def SetAO(self, axes: int, value: int | None) -> None:
        """Pulses reserved for the end at SV, 0 to 65,535; None (default): computed for each drive."""
    def Pulse(self, axes: int, value: int) -> None:
        """Output pulses of a fixed drive, -268,435,455 to 268,435,455."""
    def AutoDec(self, axes: int = 15) -> None:
        """Makes the chip compute the deceleration point; not for arcs."""
    def ManualDec(self, axes: int, value: int) -> None:
        """Sets the pulses after which fixed drives decelerate, 0 to 268,435,455."""
    def SetAsymmetric(self, axes: int, on: bool) -> None:
        """Decelerations use D instead of A."""
    def LPS(self, axes: int, value: int) -> None:
        """Sets the logical position, pulses, 32 bits with sign."""
    def EPS(self, axes: int, value: int) -> None:
        """Sets the real (encoder) position, counts, 32 bits with sign."""
    def SetCompP(self, axes: int, value: int) -> None:
        """COMP+, pulses or counts, 32 bits with sign."""
    def SetCompM(self, axes: int, value: int) -> None:
        """COMP-, pulses or counts, 32 bits with sign."""
    def TCurve_F(self, axes: int, sv: int, v: int, a: int, pulses: int) -> None:
        """Fixed drive with a T-curve: SV, V 1 to 8,000 units of the multiple, A 1 to 8,000 units of 125 * M; pulses -268,435,455 to 268,435,455, the sign is the direction."""
    def TCurve_C(self, axes: int, sv: int, v: int, a: int, negative: bool = False) -> None:
        """Continuous drive with a T-curve, until it is stopped; units as of TCurve_F."""
    def SCurve_F(self, axes: int, sv: int, v: int, a: int, k: int, pulses: int) -> None:
        """Fixed drive with an S-curve: as TCurve_F, and K 1 to 65,535 (jerk 62.5e6 / K * M pulses/s3)."""
    def SCurve_C(self, axes: int, sv: int, v: int, a: int, k: int, negative: bool = False) -> None:
        """Continuous drive with an S-curve, until it is stopped; units as of SCurve_F."""
    def DriveFixed(self, axes: int) -> None:
        """Starts the drives set by Pulse, each axis in its direction, all at the same tick."""
    def stop(self, axes: int, quick: bool = False) -> None:
        """Stops the axes, with everything that is interpolated with them: decelerating to SV, or at once."""
    def change_speed(self, axes: int, v: int) -> None:
        """Another V, 1 to 8,000, while driving. Refused where it would have no effect."""
    def change_pulses(self, axis: int, pulses: int, margin: float = 0.001) -> None:
        """Another number of pulses for the fixed drive of an axis (0 X to 3 U), counted from its start; margin in s."""
    def wait(self, axes: int = 15, timeout: float = 60.0) -> None:
        """Waits until none of the axes drives. Raises Timeout after timeout s, MachineFault if one was stopped by a limit, an alarm or the emergency input."""
    def HomeType1(self, axes: int, WR1Reg: int, SV: int, V: int, A: int) -> list[str]:
        """Homes all axes of the mask at once, in - direction; WR1Reg: WR1 with the home input enabled at its level. A sentence for each axis."""
    def HomeType2(self, axes: int, WR1Reg: int, SV: int, V: int, A: int) -> list[str]:
        """Homes all axes of the mask at once, in - direction; WR1Reg: WR1 with the home input enabled at its level. A sentence for each axis."""
    def HomeType3(self, axes: int, WR1Reg: int, SV: int, V: int, A: int) -> list[str]:
        """Homes all axes of the mask at once, in - direction; WR1Reg: WR1 with the home input enabled at its level. A sentence for each axis."""
    def HomeType4(self, axes: int, WR1Reg: int, SV: int, V: int, A: int) -> list[str]:
        """Homes all axes of the mask at once, in - direction; WR1Reg: WR1 with the home input enabled at its level. A sentence for each axis."""
    def Line2D_C(self, axes: int, P: Sequence[int], V: int, SV: int = 0, A: int = 0, D: int = 0, K: int = 0) -> None:
        """A line of two axes at constant speed V. P: finish of X, Y, Z, U in pulses from the present place, -8,388,608 to 8,388,607."""
    def Line2D_T(self, axes: int, P: Sequence[int], V: int, SV: int = 0, A: int = 0, D: int = 0, K: int = 0) -> None:
        """A line of two axes with trapezoid: SV, V, A (D: 0 as A) 1 to 8,000."""
    def Line2D_S(self, axes: int, P: Sequence[int], V: int, SV: int = 0, A: int = 0, D: int = 0, K: int = 0) -> None:
        """A line of two axes with S-curve: and K 1 to 65,535."""
    def Line3D_C(self, axes: int, P: Sequence[int], V: int, SV: int = 0, A: int = 0, D: int = 0, K: int = 0) -> None:
        """A line of three axes at constant speed; see Line2D_C."""
    def Line3D_T(self, axes: int, P: Sequence[int], V: int, SV: int = 0, A: int = 0, D: int = 0, K: int = 0) -> None:
        """A line of three axes with trapezoid; see Line2D_T."""
    def Line3D_S(self, axes: int, P: Sequence[int], V: int, SV: int = 0, A: int = 0, D: int = 0, K: int = 0) -> None:
        """A line of three axes with S-curve; see Line2D_S."""
    def CircleCW_C(self, axes: int, P: Sequence[int], C: Sequence[int], V: int, SV: int = 0, A: int = 0, D: int = 0) -> None:
        """An arc clockwise at constant speed. P finish (0, 0: a full circle), C centre, in pulses from the start."""
    def CircleCCW_C(self, axes: int, P: Sequence[int], C: Sequence[int], V: int, SV: int = 0, A: int = 0, D: int = 0) -> None:
        """An arc counter-clockwise at constant speed; see CircleCW_C."""
    def CircleCW_T(self, axes: int, P: Sequence[int], C: Sequence[int], V: int, SV: int = 0, A: int = 0, D: int = 0) -> None:
        """An arc clockwise with trapezoid: SV, V, A (D: 0 as A) 1 to 8,000."""
    def CircleCCW_T(self, axes: int, P: Sequence[int], C: Sequence[int], V: int, SV: int = 0, A: int = 0, D: int = 0) -> None:
        """An arc counter-clockwise with trapezoid; see CircleCW_T."""
    def SetVectorSpeed(self, axes_count: int) -> None:
        """Keeps the speed along the path: 1 off, 2 two axes, 3 three axes."""
    def ContStart(self, V: int, SV: int = 0, A: int = 0, D: int = 0) -> None:
        """Begins a chain: V 1 to 8,000; A 0: constant speed."""
    def ContLine(self, axes: int, P: Sequence[int], v: int = 0, timeout: float = 60.0) -> None:
        """A line of the chain, P in pulses; v: speed from here on, 0: unchanged; timeout in s."""
    def ContArc(self, axes: int, P: Sequence[int], C: Sequence[int], clockwise: bool, v: int = 0, timeout: float = 60.0) -> None:
        """An arc of the chain; see ContLine."""
    def ContEnd(self, timeout: float = 60.0) -> tuple[int, int]:
        """Executes the last segment and waits for the end, timeout in s: (segments, V units at the last pulse as planned)."""
    def BP2D(self, axes: int, V: int, SV: int = 0, A: int = 0, DecPoint: int = 0) -> None:
        """Begins a bit pattern of two axes: V steps a second, times the multiple; A 0: constant speed."""
    def BP3D(self, axes: int, V: int, SV: int = 0, A: int = 0, DecPoint: int = 0) -> None:
        """Begins a bit pattern of three axes; see BP2D."""
    def BPStack(self, plus: Sequence[int], minus: Sequence[int], timeout: float = 60.0) -> None:
        """Sixteen steps, the lowest bit first, of each axis; in both at once: the drive ends there. timeout in s."""
    def BPStart(self) -> None:
        """Starts the pattern."""
    def BPEnd(self, timeout: float = 60.0) -> None:
        """Releases the registers and waits for the end, timeout in s."""
    def HLMTP(self, n: int, axes: int = 15) -> None:
        """The + limit switch acts at: 0 Low, 1 High."""
    def HLMTM(self, n: int, axes: int = 15) -> None:
        """The - limit switch acts at: 0 Low, 1 High."""
    def HLMTSig(self, n: int, axes: int = 15) -> None:
        """Limit switches stop: 0 at once, 1 decelerating."""
    def SLMTP(self, n: int, axes: int = 15) -> None:
        """COMP+ as software limit: 0 off, 1 on."""
    def SLMTM(self, n: int, axes: int = 15) -> None:
        """COMP- as software limit: 0 off, 1 on."""
    def SLMTSig(self, n: int, axes: int = 15) -> None:
        """COMP+ and COMP- are compared with: 0 LP, 1 EP."""
    def EncoderMode(self, n: int, axes: int = 15) -> None:
        """Encoder input: 0 A/B quadrature, 1 up and down pulses."""
    def EncoderCWCCW(self, n: int, axes: int = 15) -> None:
        """A/B edges counted: 0 all, 1 every second, 2 every fourth."""
    def EnableALM(self, n: int, axes: int = 15) -> None:
        """Alarm input: 0 off, 1 on."""
    def EnableInPos(self, n: int, axes: int = 15) -> None:
        """In-position input: 0 off, 1 on."""
    def ALMSig(self, n: int, axes: int = 15) -> None:
        """The alarm acts at: 0 Low, 1 High."""
    def InPosSig(self, n: int, axes: int = 15) -> None:
        """In-position acts at: 0 Low, 1 High."""
    def SetOutput(self, axes: int, output: int, high: bool) -> None:
        """nOUT0 to nOUT7: 4 to 7 while they are not used for the drive's status."""
    def EnableInterrupt(self, axes: int, causes: int) -> None:
        """Enables causes of interrupts, bits as in RR3: 1 to 255."""
    def DisableInterrupt(self, axes: int, causes: int = 255) -> None:
        """Disables causes of interrupts."""
    def read_interrupts(self, axis: int) -> int:
        """Reads and clears what came since the last call, bits as in RR3."""
    def ReadLPS(self, axis: int) -> int:
        """Logical position of a channel (0 X to 3 U), pulses."""
    def ReadEPS(self, axis: int) -> int:
        """Real position of a channel (0 X to 3 U), encoder counts."""
    def ReadCV(self, axis: int) -> int:
        """Present speed of a channel, units of the multiple; 0 at standstill."""
    def ReadCA(self, axis: int) -> int:
        """Present acceleration of a channel, units of 125 * M; at constant speed the last one."""
    def moving(self, axes: int = 15) -> bool:
        """Whether one of the axes drives."""
    def report(self, axis: int) -> str:
        """State and position of a channel with the reason, as a sentence."""
    def error_text(self, axes: int = 15) -> str:
        """The reports of the axes that have an error or were stopped by an input; "" if none."""
    def axis_speeds(self) -> list[float]:
        """Speed of every axis, pulses a second, signed, also in interpolations."""
    def multiple(self, axis: int) -> float:
        """Pulses a second of one V unit of a channel; 0 before R was written."""
    @staticmethod
    def plan(pulses: int | None, R: int, SV: int, V: int, A: int, D: int | None = None, K: int | None = None, AO: int | None = None) -> dict[str, Any]:
        """Plans a drive; nothing moves. Exact to the tick: times in s, speeds in pulses/s. K: an S-curve; D: another deceleration; AO: None, as the library sets it."""


class Mcx314Library:
    """The 57 functions of the MCX314's source under their names and with their arguments, then those that it names without listing them; the same on a virtual card and on a real one. Arguments are whole numbers, by place or by name. `axis` is a mask, X 1, Y 2, Z 4, U 8 and their sums, also where one axis is asked for.

InvalidInput: an argument is missing, not known, or out of its range. Refused: the card cannot take it now, such as while an axis drives, or another thread uses the card. Stopped: a stop came, or holds. MachineFault: a limit, an alarm or the emergency input stopped an axis. FileError: the computer refuses an access to a real card. The first two are raised before anything is written."""
    def __init__(self, world: RackHandle, card: str) -> None:
        """Of a virtual card. Not beside another driver of it."""
    @staticmethod
    def of_live_port(card: LivePort) -> Mcx314Library:
        """Of a real card. Refused where it has a driver."""
    def SetPulseMode(self, axis: int, mode: int) -> str:
        """Pulse output: two pulse trains, or pulse and direction. Source: 4.3 Initial.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
mode: pulse output; 0 (two pulse trains), 1 (pulse and direction).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SetMultiple(self, axis: int, data: int) -> str:
        """The multiple M: pulses a second = V x M. One of these three comes before the first drive. Source: 4.3 Initial.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: the multiple M = 8,000,000 / R; 1 to 500.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SetRange(self, data: int) -> str:
        """R of all axes; R = 800,000 is M = 10. Source: 4.3 Initial.

data: R of all axes: M = 8,000,000 / R; 16000 to 8000000.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SetMaxSpeed(self, data: int) -> str:
        """The smallest multiple with which V reaches this speed, of all axes. Source: 4.3 Initial.

data: maximum speed of V; 1 to 4000000 pulses/s.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SetSV(self, axis: int, data: int) -> str:
        """Initial speed. Source: 4.4 Basic motion.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: speed; 1 to 8000 x M pulses/s.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SetV(self, axis: int, data: int) -> str:
        """Drive speed; acts also while driving. Source: 4.4 Basic motion.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: speed; 1 to 8000 x M pulses/s.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SetA(self, axis: int, data: int) -> str:
        """Acceleration. Source: 4.4 Basic motion.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: acceleration; 1 to 8000 x 125 M pulses/s2.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SetD(self, axis: int, data: int) -> str:
        """Sets the deceleration D and selects it instead of A. Source: 4.4 Basic motion.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: acceleration; 1 to 8000 x 125 M pulses/s2.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SetAA(self, axis: int, data: int) -> str:
        """K, the acceleration's rate. Source: 4.4 Basic motion.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: the acceleration's rate: the jerk is 62,500,000 / K x M pulses/s3; 1 to 65535.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SetAO(self, axis: int, data: int) -> str:
        """Pulses reserved for the end at SV. Source: 4.4 Basic motion.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: reserved for the end at SV; 0 to 65535 pulses.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def Pulse(self, axis: int, data: int) -> str:
        """Output pulses of a fixed drive. Source: 4.4 Basic motion.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: the sign is the direction; -268435455 to 268435455 pulses.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def AutoDec(self) -> str:
        """The chip finds the deceleration of all axes itself. Source: 4.4 Basic motion.

Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def ManualDec(self, axis: int, DecPulse: int) -> str:
        """Sets the pulses after which fixed drives decelerate. Source: 4.4 Basic motion.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
DecPulse: of the drive, then it decelerates; 0 to 268435455 pulses.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def ManDec(self, axis: int, DecPulse: int) -> str:
        """As ManualDec; the source has both names. Source: 4.4 Basic motion.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
DecPulse: of the drive, then it decelerates; 0 to 268435455 pulses.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def TCurve_F(self, axis: int, m_SV: int, m_V: int, m_A: int, m_Pulse: int) -> str:
        """Fixed drive with T-curve. Source: 4.4 Basic motion.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
m_SV: initial speed; 1 to 8000 x M pulses/s.
m_V: drive speed; 1 to 8000 x M pulses/s.
m_A: acceleration; 1 to 8000 x 125 M pulses/s2.
m_Pulse: the sign is the direction; -268435455 to 268435455 pulses.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def TCurve_C(self, axis: int, m_SV: int, m_V: int, m_A: int) -> str:
        """Continuous drive with T-curve in + direction, until it is stopped. Source: 4.4 Basic motion.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
m_SV: initial speed; 1 to 8000 x M pulses/s.
m_V: drive speed; 1 to 8000 x M pulses/s.
m_A: acceleration; 1 to 8000 x 125 M pulses/s2.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SCurve_F(self, axis: int, m_SV: int, m_V: int, m_A: int, m_K: int, m_Pulse: int) -> str:
        """Fixed drive with S-curve. Source: 4.4 Basic motion.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
m_SV: initial speed; 1 to 8000 x M pulses/s.
m_V: drive speed; 1 to 8000 x M pulses/s.
m_A: acceleration; 1 to 8000 x 125 M pulses/s2.
m_K: the acceleration's rate: the jerk is 62,500,000 / K x M pulses/s3; 1 to 65535.
m_Pulse: the sign is the direction; -268435455 to 268435455 pulses.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SCurve_C(self, axis: int, m_SV: int, m_V: int, m_A: int, m_K: int) -> str:
        """Continuous drive with S-curve in + direction, until it is stopped. Source: 4.4 Basic motion.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
m_SV: initial speed; 1 to 8000 x M pulses/s.
m_V: drive speed; 1 to 8000 x M pulses/s.
m_A: acceleration; 1 to 8000 x 125 M pulses/s2.
m_K: the acceleration's rate: the jerk is 62,500,000 / K x M pulses/s3; 1 to 65535.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def Line2D_C(self, V: int, PX: int, PY: int, PZ: int, PU: int, axis: int) -> str:
        """Line of two axes at constant speed. Source: 4.5.1 Lines.

V: drive speed; 1 to 8000 x M pulses/s.
PX: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PY: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PZ: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PU: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
axis: the two axes; 3 (X Y), 5 (X Z), 9 (X U), 6 (Y Z), 10 (Y U), 12 (Z U).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def Line3D_C(self, V: int, PX: int, PY: int, PZ: int, PU: int, axis: int) -> str:
        """Line of three axes at constant speed. Source: 4.5.1 Lines.

V: drive speed; 1 to 8000 x M pulses/s.
PX: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PY: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PZ: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PU: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
axis: the three axes; 7 (X Y Z), 11 (X Y U), 13 (X Z U), 14 (Y Z U).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def Line2D_T(self, SV: int, V: int, A: int, D: int, PX: int, PY: int, PZ: int, PU: int, axis: int) -> str:
        """Line of two axes with T-curve. Source: 4.5.1 Lines.

SV: initial speed; 1 to 8000 x M pulses/s.
V: drive speed; 1 to 8000 x M pulses/s.
A: acceleration; 1 to 8000 x 125 M pulses/s2.
D: deceleration; 0: as the acceleration; 0 to 8000 x 125 M pulses/s2.
PX: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PY: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PZ: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PU: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
axis: the two axes; 3 (X Y), 5 (X Z), 9 (X U), 6 (Y Z), 10 (Y U), 12 (Z U).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def Line3D_T(self, SV: int, V: int, A: int, D: int, PX: int, PY: int, PZ: int, PU: int, axis: int) -> str:
        """Line of three axes with T-curve. Source: 4.5.1 Lines.

SV: initial speed; 1 to 8000 x M pulses/s.
V: drive speed; 1 to 8000 x M pulses/s.
A: acceleration; 1 to 8000 x 125 M pulses/s2.
D: deceleration; 0: as the acceleration; 0 to 8000 x 125 M pulses/s2.
PX: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PY: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PZ: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PU: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
axis: the three axes; 7 (X Y Z), 11 (X Y U), 13 (X Z U), 14 (Y Z U).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def Line2D_S(self, SV: int, V: int, A: int, D: int, K: int, PX: int, PY: int, PZ: int, PU: int, axis: int) -> str:
        """Line of two axes with S-curve. Source: 4.5.1 Lines.

SV: initial speed; 1 to 8000 x M pulses/s.
V: drive speed; 1 to 8000 x M pulses/s.
A: acceleration; 1 to 8000 x 125 M pulses/s2.
D: deceleration; 0: as the acceleration; 0 to 8000 x 125 M pulses/s2.
K: the acceleration's rate: the jerk is 62,500,000 / K x M pulses/s3; 1 to 65535.
PX: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PY: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PZ: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PU: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
axis: the two axes; 3 (X Y), 5 (X Z), 9 (X U), 6 (Y Z), 10 (Y U), 12 (Z U).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def Line3D_S(self, SV: int, V: int, A: int, D: int, K: int, PX: int, PY: int, PZ: int, PU: int, axis: int) -> str:
        """Line of three axes with S-curve. Source: 4.5.1 Lines.

SV: initial speed; 1 to 8000 x M pulses/s.
V: drive speed; 1 to 8000 x M pulses/s.
A: acceleration; 1 to 8000 x 125 M pulses/s2.
D: deceleration; 0: as the acceleration; 0 to 8000 x 125 M pulses/s2.
K: the acceleration's rate: the jerk is 62,500,000 / K x M pulses/s3; 1 to 65535.
PX: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PY: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PZ: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
PU: finish point, from the start; all 0: that of SetFP; -8388608 to 8388607 pulses.
axis: the three axes; 7 (X Y Z), 11 (X Y U), 13 (X Z U), 14 (Y Z U).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def CircleCW_C(self, V: int, PX: int, PY: int, PZ: int, PU: int, CX: int, CY: int, CZ: int, CU: int, axis: int) -> str:
        """Arc clockwise at constant speed; the first axis points right, the second up. Source: 4.5.2 Arcs.

V: drive speed; 1 to 8000 x M pulses/s.
PX: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
PY: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
PZ: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
PU: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
CX: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
CY: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
CZ: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
CU: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
axis: the two axes; 3 (X Y), 5 (X Z), 9 (X U), 6 (Y Z), 10 (Y U), 12 (Z U).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def CircleCCW_C(self, V: int, PX: int, PY: int, PZ: int, PU: int, CX: int, CY: int, CZ: int, CU: int, axis: int) -> str:
        """Arc counterclockwise at constant speed. Source: 4.5.2 Arcs.

V: drive speed; 1 to 8000 x M pulses/s.
PX: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
PY: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
PZ: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
PU: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
CX: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
CY: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
CZ: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
CU: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
axis: the two axes; 3 (X Y), 5 (X Z), 9 (X U), 6 (Y Z), 10 (Y U), 12 (Z U).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def CircleCW_T(self, SV: int, V: int, A: int, D: int, PX: int, PY: int, PZ: int, PU: int, CX: int, CY: int, CZ: int, CU: int, axis: int) -> str:
        """Arc clockwise with T-curve. Source: 4.5.2 Arcs.

SV: initial speed; 1 to 8000 x M pulses/s.
V: drive speed; 1 to 8000 x M pulses/s.
A: acceleration; 1 to 8000 x 125 M pulses/s2.
D: deceleration; 0: as the acceleration; 0 to 8000 x 125 M pulses/s2.
PX: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
PY: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
PZ: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
PU: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
CX: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
CY: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
CZ: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
CU: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
axis: the two axes; 3 (X Y), 5 (X Z), 9 (X U), 6 (Y Z), 10 (Y U), 12 (Z U).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def CircleCCW_T(self, SV: int, V: int, A: int, D: int, PX: int, PY: int, PZ: int, PU: int, CX: int, CY: int, CZ: int, CU: int, axis: int) -> str:
        """Arc counterclockwise with T-curve. Source: 4.5.2 Arcs.

SV: initial speed; 1 to 8000 x M pulses/s.
V: drive speed; 1 to 8000 x M pulses/s.
A: acceleration; 1 to 8000 x 125 M pulses/s2.
D: deceleration; 0: as the acceleration; 0 to 8000 x 125 M pulses/s2.
PX: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
PY: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
PZ: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
PU: finish point, from the start; all 0: a full circle; -8388608 to 8388607 pulses.
CX: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
CY: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
CZ: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
CU: centre, from the start; all 0: finish and centre of SetFP and SetCP; -8388608 to 8388607 pulses.
axis: the two axes; 3 (X Y), 5 (X Z), 9 (X U), 6 (Y Z), 10 (Y U), 12 (Z U).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SetCP(self, axis: int, data: int) -> str:
        """Centre of arcs whose own centre is 0. Source: 4.5.2 Arcs.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: centre of arcs, from the start; -8388608 to 8388607 pulses.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SetC(self, axis: int, data: int) -> str:
        """As SetCP; the source has both names. Source: 4.5.2 Arcs.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: centre of arcs, from the start; -8388608 to 8388607 pulses.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SetFP(self, axis: int, data: int) -> str:
        """Finish point of lines and arcs whose own is 0. Source: 4.5.2 Arcs.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: finish point of lines and arcs, from the start; -8388608 to 8388607 pulses.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SetP(self, axis: int, data: int) -> str:
        """As SetFP; the source has both names. Source: 4.5.2 Arcs.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: finish point of lines and arcs, from the start; -8388608 to 8388607 pulses.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def HLMTP(self, n: int, axis: int) -> str:
        """Level at which the + limit switch acts. Source: 4.6 Signals.

n: the input acts at; 0 (Low), 1 (High).
axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def HLMTM(self, n: int, axis: int) -> str:
        """Level at which the - limit switch acts. Source: 4.6 Signals.

n: the input acts at; 0 (Low), 1 (High).
axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def HLMTSig(self, n: int, axis: int) -> str:
        """How limit switches stop. Source: 4.6 Signals.

n: a limit switch stops; 0 (at once), 1 (decelerating).
axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SLMTP(self, n: int) -> str:
        """Software limit at COMP+. Source: 4.6 Signals.

n: of all axes; 0 (off), 1 (on).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SLMTM(self, n: int) -> str:
        """Software limit at COMP-. Source: 4.6 Signals.

n: of all axes; 0 (off), 1 (on).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SLMTSig(self, n: int) -> str:
        """Counter that the software limits are compared with. Source: 4.6 Signals.

n: counter that COMP+ and COMP- are compared with, on all axes; 0 (the logical position LP), 1 (the real position EP).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def EncoderMode(self, n: int, axis: int) -> str:
        """Kind of the encoder inputs. Source: 4.6 Signals.

n: encoder inputs; 0 (quadrature A/B), 1 (up and down pulses).
axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def EncoderCWCCW(self, n: int, axis: int) -> str:
        """Counted edges of A/B. Source: 4.6 Signals.

n: counted edges of A/B; 0 (all), 1 (every second), 2 (every fourth).
axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def EnableALM(self, n: int) -> str:
        """Alarm inputs. Source: 4.6 Signals.

n: of all axes; 0 (off), 1 (on).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def EnableInPos(self, n: int) -> str:
        """In-position inputs. Source: 4.6 Signals.

n: of all axes; 0 (off), 1 (on).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def ALMSig(self, n: int, axis: int) -> str:
        """Level at which the alarm input acts. Source: 4.6 Signals.

n: the input acts at; 0 (Low), 1 (High).
axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def InPosSig(self, n: int, axis: int) -> str:
        """Level at which the in-position input acts. Source: 4.6 Signals.

n: the input acts at; 0 (Low), 1 (High).
axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def HomeType1(self, WR1Reg: int, SV: int, V: int, A: int) -> str:
        """Decelerates at the home switch. The axes are those of home_axes. Source: 4.7 Home.

WR1Reg: WR1: the home switch enabled, at its level; IN2's level for Z, or IN3's if IN2 alone is enabled; 1 (IN0 at High), 2 (IN0 stops), 4 (IN1 at High), 8 (IN1 stops), 16 (IN2 (Z) at High), 32 (IN2 stops), 64 (IN3 at High), 128 (IN3 stops) or a sum of these.
SV: initial speed; 1 to 8000 x M pulses/s.
V: drive speed; 1 to 8000 x M pulses/s.
A: acceleration; 1 to 8000 x 125 M pulses/s2.
Returns: a sentence.
Errors: InvalidInput, Refused, Timeout or MachineFault where it does not end well, Stopped, FileError."""
    def HomeType2(self, WR1Reg: int, SV: int, V: int, A: int) -> str:
        """HomeType1, then back at SV and slowly to the switch again. Source: 4.7 Home.

WR1Reg: WR1: the home switch enabled, at its level; IN2's level for Z, or IN3's if IN2 alone is enabled; 1 (IN0 at High), 2 (IN0 stops), 4 (IN1 at High), 8 (IN1 stops), 16 (IN2 (Z) at High), 32 (IN2 stops), 64 (IN3 at High), 128 (IN3 stops) or a sum of these.
SV: initial speed; 1 to 8000 x M pulses/s.
V: drive speed; 1 to 8000 x M pulses/s.
A: acceleration; 1 to 8000 x 125 M pulses/s2.
Returns: a sentence.
Errors: InvalidInput, Refused, Timeout or MachineFault where it does not end well, Stopped, FileError."""
    def HomeType3(self, WR1Reg: int, SV: int, V: int, A: int) -> str:
        """HomeType1, then on at SV to the encoder's index Z. Source: 4.7 Home.

WR1Reg: WR1: the home switch enabled, at its level; IN2's level for Z, or IN3's if IN2 alone is enabled; 1 (IN0 at High), 2 (IN0 stops), 4 (IN1 at High), 8 (IN1 stops), 16 (IN2 (Z) at High), 32 (IN2 stops), 64 (IN3 at High), 128 (IN3 stops) or a sum of these.
SV: initial speed; 1 to 8000 x M pulses/s.
V: drive speed; 1 to 8000 x M pulses/s.
A: acceleration; 1 to 8000 x 125 M pulses/s2.
Returns: a sentence.
Errors: InvalidInput, Refused, Timeout or MachineFault where it does not end well, Stopped, FileError."""
    def HomeType4(self, WR1Reg: int, SV: int, V: int, A: int) -> str:
        """HomeType3 slowly, then HomeType2. Source: 4.7 Home.

WR1Reg: WR1: the home switch enabled, at its level; IN2's level for Z, or IN3's if IN2 alone is enabled; 1 (IN0 at High), 2 (IN0 stops), 4 (IN1 at High), 8 (IN1 stops), 16 (IN2 (Z) at High), 32 (IN2 stops), 64 (IN3 at High), 128 (IN3 stops) or a sum of these.
SV: initial speed; 1 to 8000 x M pulses/s.
V: drive speed; 1 to 8000 x M pulses/s.
A: acceleration; 1 to 8000 x 125 M pulses/s2.
Returns: a sentence.
Errors: InvalidInput, Refused, Timeout or MachineFault where it does not end well, Stopped, FileError."""
    def LPS(self, axis: int, data: int) -> str:
        """Sets the logical position. Source: 4.8 Positions.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: new logical position; -2147483648 to 2147483647 pulses.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def EPS(self, axis: int, data: int) -> str:
        """Sets the real (encoder) position. Source: 4.8 Positions.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: new real position; -2147483648 to 2147483647 counts.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def ReadLPS(self, axis: int) -> int:
        """The logical position of one axis. Source: 4.8 Positions.

axis: axis; 1 (X), 2 (Y), 4 (Z), 8 (U).
Returns: pulses.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def ReadEPS(self, axis: int) -> int:
        """The real position of one axis. Source: 4.8 Positions.

axis: axis; 1 (X), 2 (Y), 4 (Z), 8 (U).
Returns: counts.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def ReadCV(self, axis: int) -> int:
        """Present speed of one axis; 0 at standstill. Source: 4.8 Positions.

axis: axis; 1 (X), 2 (Y), 4 (Z), 8 (U).
Returns: x M pulses/s.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def ReadCA(self, axis: int) -> int:
        """Present acceleration of one axis. Source: 4.8 Positions.

axis: axis; 1 (X), 2 (Y), 4 (Z), 8 (U).
Returns: x 125 M pulses/s2.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SetCompP(self, axis: int, data: int) -> str:
        """COMP+, the + software limit. Source: 4.8 Positions.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: position of the software limit; -2147483648 to 2147483647 pulses.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def SetCompM(self, axis: int, data: int) -> str:
        """COMP-, the - software limit. Source: 4.8 Positions.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
data: position of the software limit; -2147483648 to 2147483647 pulses.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def RESET(self) -> str:
        """Resets the chip; all registers and the multiple have to be set again. Source: 4.8 Positions.

Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def home_axes(self, axis: int) -> str:
        """The axes that HomeType1 to HomeType4 home, all at once; X at first. The source names it without listing it.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def stop(self, axis: int) -> str:
        """Stops axes, decelerating, with everything that is interpolated with them. The source names it without listing it.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def stop_now(self, axis: int) -> str:
        """Stops axes at once. The source names it without listing it.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def wait(self, axis: int, milliseconds: int) -> str:
        """Waits until none of the axes drives. The source names it without listing it.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
milliseconds: maximum time; 0 to 60000 ms.
Returns: a sentence.
Errors: InvalidInput, Refused, Timeout or MachineFault where it does not end well, Stopped, FileError."""
    def moving(self, axis: int) -> int:
        """Mask of the axes that drive. The source names it without listing it.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
Returns: mask of axes.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def at_limit(self, axis: int) -> int:
        """Mask of the axes at a limit switch or beyond a software limit. The source names it without listing it.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
Returns: mask of axes.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def report(self, axis: int) -> str:
        """Reports state, position and stop reason of axes. The source names it without listing it.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def asymmetric(self, axis: int, on: int) -> str:
        """Selects D instead of A for decelerations. The source names it without listing it.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
on: decelerations use D instead of A; 0 (off), 1 (on).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def set_output(self, axis: int, output: int, level: int) -> str:
        """Sets a general output: servo on, brakes. The source names it without listing it.

axis: axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
output: OUT0 to OUT7; 0 to 7.
level: level; 0 (Low), 1 (High).
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def contour_begin(self, SV: int, V: int, A: int, D: int) -> str:
        """Opens a contour with its speeds. The source names it without listing it.

SV: initial speed; 1 to 8000 x M pulses/s.
V: drive speed; 1 to 8000 x M pulses/s.
A: 0: constant speed V; 0 to 8000 x 125 M pulses/s2.
D: deceleration; 0: as the acceleration; 0 to 8000 x 125 M pulses/s2.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def contour_line(self, axis: int, PX: int, PY: int, PZ: int, PU: int, V: int) -> str:
        """Adds the next line; waits until the chip accepts it. The source names it without listing it.

axis: two or three axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
PX: from the segment's start; -8388608 to 8388607 pulses.
PY: from the segment's start; -8388608 to 8388607 pulses.
PZ: from the segment's start; -8388608 to 8388607 pulses.
PU: from the segment's start; -8388608 to 8388607 pulses.
V: velocity from here on; 0: unchanged; 0 to 8000 x M pulses/s.
Returns: a sentence.
Errors: InvalidInput, Refused, Timeout or MachineFault where it does not end well, Stopped, FileError."""
    def contour_arc(self, axis: int, PX: int, PY: int, PZ: int, PU: int, CX: int, CY: int, CZ: int, CU: int, clockwise: int, V: int) -> str:
        """Adds the next arc; waits until the chip accepts it. The source names it without listing it.

axis: the two axes; 3 (X Y), 5 (X Z), 9 (X U), 6 (Y Z), 10 (Y U), 12 (Z U).
PX: from the segment's start; -8388608 to 8388607 pulses.
PY: from the segment's start; -8388608 to 8388607 pulses.
PZ: from the segment's start; -8388608 to 8388607 pulses.
PU: from the segment's start; -8388608 to 8388607 pulses.
CX: from the segment's start; -8388608 to 8388607 pulses.
CY: from the segment's start; -8388608 to 8388607 pulses.
CZ: from the segment's start; -8388608 to 8388607 pulses.
CU: from the segment's start; -8388608 to 8388607 pulses.
clockwise: direction; 0 (counterclockwise), 1 (clockwise).
V: velocity from here on; 0: unchanged; 0 to 8000 x M pulses/s.
Returns: a sentence.
Errors: InvalidInput, Refused, Timeout or MachineFault where it does not end well, Stopped, FileError."""
    def contour_end(self) -> int:
        """Executes the last segment and waits for the end. The source names it without listing it.

Returns: segments.
Errors: InvalidInput, Refused, Timeout or MachineFault where it does not end well, Stopped, FileError."""
    def pattern_begin(self, SV: int, V: int, A: int, DecPoint: int, axis: int) -> str:
        """Opens a bit pattern of two or three axes. The source names it without listing it.

SV: initial speed; 1 to 8000 x M pulses/s.
V: drive speed; 1 to 8000 x M pulses/s.
A: 0: constant speed V; 0 to 8000 x 125 M pulses/s2.
DecPoint: then it decelerates; with A; 0 to 268435455 steps.
axis: two or three axes; 1 (X), 2 (Y), 4 (Z), 8 (U) or a sum of these.
Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def pattern_steps(self, plus1: int, minus1: int, plus2: int, minus2: int, plus3: int, minus3: int) -> str:
        """Adds sixteen steps of each axis; three words fit before the start. The source names it without listing it.

plus1: 16 steps in + direction, the lowest bit first; 0 to 65535.
minus1: 16 steps in - direction; a bit in both: the drive ends here; 0 to 65535.
plus2: 16 steps in + direction, the lowest bit first; 0 to 65535.
minus2: 16 steps in - direction; a bit in both: the drive ends here; 0 to 65535.
plus3: 16 steps in + direction, the lowest bit first; 0 to 65535.
minus3: 16 steps in - direction; a bit in both: the drive ends here; 0 to 65535.
Returns: a sentence.
Errors: InvalidInput, Refused, Timeout or MachineFault where it does not end well, Stopped, FileError."""
    def pattern_start(self) -> str:
        """Starts the pattern. The source names it without listing it.

Returns: a sentence.
Errors: InvalidInput, Refused, Stopped, FileError."""
    def pattern_end(self) -> str:
        """Waits for the end. The source names it without listing it.

Returns: a sentence.
Errors: InvalidInput, Refused, Timeout or MachineFault where it does not end well, Stopped, FileError."""


class SpeedScale:
    """Speed of the machine at a rate: counts per pulse of FOUT, or counts/s per volt. `trim`: the table that came with the card, rows of V and rate as in the rack file; empty: the printed one."""
    def __init__(self, counts_per_pulse: float | None = None, counts_per_volt: float | None = None, trim: str = '') -> None: ...
    def speed(self, rate: int) -> float:
        """Counts/s at a rate, 0 to 16383."""
    def rate_for(self, counts_s: float) -> int:
        """The highest rate of at most this speed, counts/s."""


class SlopeTable:
    """48 intervals (rate 0 to 16383, counts 0 to 16,777,215): deceleration 0 to 23, acceleration 24 to 47."""
    def __init__(self, entries: Sequence[tuple[int, int]]) -> None: ...
    @staticmethod
    def design(top_speed: float, acceleration: float, deceleration: float, scale: SpeedScale, load: float = 0.0, creep_speed: float = 0.0, lag_s: float = 0.0) -> SlopeTable:
        """A table for the limits of a machine: counts/s, counts/s2; load in inertias of the empty machine; creep_speed 0: a 24th of the top speed."""
    def entries(self) -> list[tuple[int, int]]:
        """The 48 intervals: (rate, counts)."""
    def motion(self, distance: int, rate: int, scale: SpeedScale) -> dict[str, Any]:
        """Computes a move of `distance` counts at `rate` with this table; nothing moves. Returns duration_s, top_speed (counts/s), legs."""


class Databoard4002:
    """The DataBoard 4002's function library. After the 127 ms in which the card must be Ready: MachineFault."""
    def __init__(self, world: RackHandle, card: str, counts_per_mm: float = 1000.0, select: int = 13) -> None: ...
    @staticmethod
    def of_live_port(card: LivePort, counts_per_mm: float = 1000.0) -> Databoard4002:
        """Of a real card. Refused where it has a driver."""
    def connect(self) -> int:
        """Checks for the card, clears its reset mark, returns its version. MachineFault if none answers."""
    def reset(self) -> None:
        """C3: hardware reset; position, rate and table are lost."""
    def status(self) -> int:
        """STAT as a word; its bits: card.STAT."""
    def stops(self) -> str:
        """"the right end stop is active"; "" if no stop is."""
    def emergency(self) -> bool:
        """Whether the emergency stop is active."""
    def athome(self) -> None:
        """A: the position becomes 0."""
    def set_deviation(self, counts: int) -> None:
        """D: deviation allowed by lock, 0 to 8,388,607 counts."""
    def deviation(self) -> int:
        """D: present minus requested, counts."""
    def go(self) -> None:
        """G: begins a positioning."""
    def initialise(self) -> None:
        """I."""
    def lock(self) -> None:
        """L: holds the position."""
    def manual(self) -> None:
        """M: releases the position."""
    def set_number(self, counts: int) -> None:
        """N, -8,388,608 to 8,388,607 counts."""
    def on_regulation(self) -> None:
        """O."""
    def set_target(self, counts: int) -> None:
        """P, -8,388,608 to 8,388,607 counts."""
    def position(self) -> int:
        """P: position, counts."""
    def quit(self) -> None:
        """Q: ends a positioning."""
    def set_rate(self, rate: int) -> None:
        """R, 0 to 16383; 0 switches the relay off."""
    def rate(self) -> int:
        """R: negative backwards, 0 while standing."""
    def set_slope(self, table: SlopeTable) -> None:
        """S: the 48 intervals of acceleration and deceleration."""
    def version(self) -> int:
        """V."""
    def clear_watch_out(self) -> None:
        """W."""
    def enable_events(self, enables: int) -> int:
        """C4: enables events and gives the EVENT word that was freed by it."""
    def wait_event(self, wanted: int, timeout: float, interrupt: bool = False) -> int:
        """Waits until one of the events 01h position, 02h zero, 04h reference, 20h stop has happened; the word. Timeout after timeout s."""
    def move_to(self, counts: int, timeout: float = 60.0, interrupt: bool = False) -> None:
        """Moves to a position, counts, with the present rate, mode and table. MachineFault if a stop holds the move, Timeout after timeout s."""
    def move_by(self, counts: int, timeout: float = 60.0, interrupt: bool = False) -> None:
        """Moves by this number of counts; see move_to."""
    def move_to_mm(self, mm: float, timeout: float = 60.0, interrupt: bool = False) -> None:
        """Moves to a position, mm by counts_per_mm; see move_to."""
    def position_mm(self) -> float:
        """Position, mm by counts_per_mm."""
    def find_zero(self, marks: int, far: int, rate: int, timeout: float = 60.0, interrupt: bool = False) -> None:
        """Moves slowly (rate) towards far counts until zero (02h), reference (04h) or both (06h) zero the counter."""


class SpeedMeter:
    """Speed of an axis from readings of an Ioflex02, with the error that it cannot exceed."""
    def __init__(self, edge_error: float = 0.0) -> None:
        """edge_error: maximum position error of an edge of the encoder, counts."""
    def update(self, raw: int, age: int, ticks: int) -> tuple[float, float] | None:
        """A reading (counts, and 1.2 us ticks); (counts/s, error) or None before the second one."""
    def restart(self) -> None:
        """Discards earlier samples."""


class Ioflex02:
    """The IOFLEX02's unit uFlex2Pos under its source's names, and one layer up. Before Init has succeeded every read gives 0."""
    def __init__(self, world: RackHandle, card: str) -> None: ...
    cVerNo: int
    cVer: str
    cNop: int
    cRes: int
    cResNm: int
    cResNmSig: int
    def Init(self, Addr: int) -> int:
        """Sets the base address, checks that one card answers there, and loads the array with the image that the rack file gives the card, or else the built-in one; takes seconds of the rack's time. 0: done, else see why."""
    @property
    def Result(self) -> int:
        """0 ok, 1 configuration failed, 2 no card or two, 3 another project."""
    @property
    def why(self) -> str:
        """Message for the code in Result; empty if Result is 0."""
    def GetIdent(self) -> int:
        """Version of the project in the array."""
    def ReadTime(self) -> int:
        """Time in ticks of 1.2 us, 0 to 16,777,215."""
    def ReadTimeClr(self) -> int:
        """The same, and the counter is cleared in the same access."""
    def ReadPosition0(self) -> int:
        """Position in counts since the calibration, -8,388,608 to 8,388,607."""
    def ReadPosition1(self) -> int:
        """Position in counts since the calibration, -8,388,608 to 8,388,607."""
    def ReadPosition2(self) -> int:
        """Position in counts since the calibration, -8,388,608 to 8,388,607."""
    def ReadPosition3(self) -> int:
        """Position in counts since the calibration, -8,388,608 to 8,388,607."""
    def ReadTimeClrPosition(self) -> tuple[int, int, int, int, int]:
        """Time (1.2 us, cleared) and the four positions (counts) of one instant."""
    def WriteCmd(self, Cmd0: int, Cmd1: int, Cmd2: int, Cmd3: int) -> None:
        """A calibration command for each axis: 0 cNop, 1 cRes, 2 cResNm, 3 cResNmSig."""
    def WriteCmdAxis(self, axis: int, Cmd: int) -> None:
        """A command for one axis 0 to 3; the others stay armed, while WriteCmd would end or restart them."""
    def ReadSts(self) -> tuple[bool, bool, bool, bool]:
        """Whether each axis is calibrated (sCal)."""
    def WriteOutL(self, Data: int) -> None:
        """Low 8 outputs of X5."""
    def WriteOutH(self, Data: int) -> None:
        """High 8 outputs of X5."""
    def ReadInL(self) -> int:
        """Low 8 of the 16 inputs: from bit 0 on A, B, Z, Cal of axes 0 and 1."""
    def ReadInH(self) -> int:
        """High 8 of the 16 inputs: A, B, Z, Cal of axes 2 and 3."""
    def read(self) -> tuple[int, list[dict[str, Any]]]:
        """All values of one instant: time since Init (ticks of 1.2 us, carried on), and of each axis position, raw (counts), age of the last count (1.2 us), down."""
    def set_mode(self, axis: int, reversed: bool = False, edges: int = 4, index_low: bool = False, filter: int = 0) -> None:
        """Sets how an axis (0 to 3) counts: edges 4, 2 or 1 a line; filter 0 to 15: a level counts after filter + 1 samples of 100 ns."""
    def wait_calibrated(self, axis: int, timeout: float = 60.0) -> None:
        """Waits until the axis is calibrated; Timeout after timeout s."""
    def clear_errors(self) -> None:
        """Clears the counters of errors."""
    def reset(self) -> None:
        """Positions and the card's time begin at 0."""
    def Configure(self, image: bytes, Addr: int | None = None) -> int:
        """Loads the array with a custom image (bytes, of make_image or motionrack image make), at a base address, or at the one before. 0, or 1 if the image is damaged, 3 if it is of another project or version."""
    @staticmethod
    def make_image(project: str = 'position', ident: int = 37, modes: Sequence[int] = [0, 0, 0, 0], bits: bytes = b'') -> bytes:
        """Returns a custom configuration image: the project's name, its version, the value of register MODE of each axis, and further bytes, which the gate array stores without using them."""
    @staticmethod
    def image_info(image: bytes) -> dict[str, Any]:
        """Show the header of an image: project, ident, payload (bytes), modes, and whether Init would take it (fits). InvalidInput for one that the card would refuse."""


class GratingCard:
    """The function library of a motion card on a grating bus: the positions of one instant."""
    def __init__(self, world: RackHandle, card: str) -> None: ...
    def open(self) -> dict[str, Any]:
        """Checks for the card and returns its settings, with the addresses of its own list; period in s."""
    def read(self) -> tuple[int, int, npt.NDArray[np.int64]]:
        """The last published frame: (sequence, ticks of 100 ps, counts of 64 bits). Refused if there is none, if it is stale, or its CRC is wrong."""
    def wait(self, timeout: float) -> tuple[int, int, npt.NDArray[np.int64]]:
        """Waits for a frame that was not read yet, and reads it; Timeout after timeout s."""
    def addresses(self) -> list[int]:
        """Scales of the last frame read: the address of each word, as set by the host; empty before the first."""
    def stale(self) -> bool:
        """Whether the last published frame is two periods old."""
    def errors(self) -> dict[str, Any]:
        """Errors on the bus since the last clear_errors, each at most 65,535."""
    def clear_errors(self) -> None:
        """Clears those counters."""
    def set_position(self, scale: int, count: int) -> None:
        """Sets the 64-bit count of the scale with that address, 0 to 127, near count; the next reading gives its low 32 bits."""

def bus_conflicts(world: RackHandle) -> int:
    """Conflicts on all lines of the grating bus so far."""
def refused_frames(world: RackHandle, card: str) -> int:
    """Frames that the card did not publish since the start."""
def frame_picture(world: RackHandle, frame: int) -> str:
    """One frame of the rack as waves (SVG); a rack of its own is run for it."""

class Rtc5:
    """The RTC5's commands under their documented names, in bits, bits/ms and 10 us: every one of rtc5sim.h. List commands go to the list that set_start_list has opened. A call that is out of range, or not possible now, is refused: nothing is changed, Refused has the sentence and get_last_error the board's bits. Source of the list commands: the maker's header of the RTC5 of 2013, and of those with position words the RTC5 manual 1.10 d (German), page 198."""
    def __init__(self, world: RackHandle, card: str) -> None: ...
    def set_end_of_list(self) -> None:
        """List command: the list ends."""
    def list_nop(self) -> None:
        """List command: one tick."""
    def long_delay(self, Delay: float) -> None:
        """List command: holds the position. Delay 0 to 4294967295 times 10 us."""
    def jump_abs(self, X: float, Y: float) -> None:
        """List command: straight, laser off, at the jump speed. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits."""
    def jump_rel(self, X: float, Y: float) -> None:
        """List command: as jump_abs, from the present position. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits."""
    def mark_abs(self, X: float, Y: float) -> None:
        """List command: straight, laser on, at the mark speed. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits."""
    def mark_rel(self, X: float, Y: float) -> None:
        """List command: as mark_abs, from the present position. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits."""
    def arc_abs(self, X: float, Y: float, Angle: float) -> None:
        """List command: about the centre X, Y, laser on; positive is clockwise. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits. Angle -3600 to 3600 degrees."""
    def arc_rel(self, X: float, Y: float, Angle: float) -> None:
        """List command: as arc_abs, the centre from the present position. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits. Angle -3600 to 3600 degrees."""
    def timed_jump_abs(self, X: float, Y: float, T: float) -> None:
        """List command: as jump_abs, in T rounded down to 10 us. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits. T 0 to 4294967295 us."""
    def timed_jump_rel(self, X: float, Y: float, T: float) -> None:
        """List command: as jump_rel, in T rounded down to 10 us. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits. T 0 to 4294967295 us."""
    def timed_mark_abs(self, X: float, Y: float, T: float) -> None:
        """List command: as mark_abs, in T rounded down to 10 us. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits. T 0 to 4294967295 us."""
    def timed_mark_rel(self, X: float, Y: float, T: float) -> None:
        """List command: as mark_rel, in T rounded down to 10 us. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits. T 0 to 4294967295 us."""
    def micro_vector_abs(self, X: float, Y: float, LasOn: float, LasOff: float) -> None:
        """List command: one tick; the laser is switched at these instants of it, if they are 0 to 19. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits. LasOn -2147483648 to 2147483647 times 0.5 us. LasOff -2147483648 to 2147483647 times 0.5 us."""
    def micro_vector_rel(self, X: float, Y: float, LasOn: float, LasOff: float) -> None:
        """List command: as micro_vector_abs, from the present position. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits. LasOn -2147483648 to 2147483647 times 0.5 us. LasOff -2147483648 to 2147483647 times 0.5 us."""
    def set_jump_speed(self, Speed: float) -> None:
        """List command: speed of later jumps. Speed 1.6 to 800000 bits/ms."""
    def set_mark_speed(self, Speed: float) -> None:
        """List command: speed of later marks and arcs. Speed 1.6 to 800000 bits/ms."""
    def set_scanner_delays(self, Jump: float, Mark: float, Polygon: float) -> None:
        """List command: delays after jumps, polylines and corners. Jump 0 to 4294967295 times 10 us. Mark 0 to 4294967295 times 10 us. Polygon 0 to 4294967295 times 10 us."""
    def set_laser_delays(self, LaserOnDelay: float, LaserOffDelay: float) -> None:
        """List command: delays of the laser at the begin and end of the path. LaserOnDelay -32768 to 65535 times 0.5 us. LaserOffDelay -32768 to 65535 times 0.5 us."""
    def laser_on_list(self, Period: float) -> None:
        """List command: laser on for the time, position held. Period 0 to 4294967295 times 10 us."""
    def laser_signal_on_list(self) -> None:
        """List command: laser on."""
    def laser_signal_off_list(self) -> None:
        """List command: laser off."""
    def write_io_port_list(self, Value: float) -> None:
        """List command: sets the 16 digital outputs. Value 0 to 65535."""
    def set_fly_x(self, ScaleX: float) -> None:
        """List command: X moves with Encoder0, which becomes 0; 0 is off. ScaleX -1000000000 to 1000000000."""
    def set_fly_y(self, ScaleY: float) -> None:
        """List command: Y moves with Encoder1, which becomes 0; 0 is off. ScaleY -1000000000 to 1000000000."""
    def set_fly_z(self, ScaleZ: float, EncoderNo: float) -> None:
        """List command: Z moves with the encoder, which becomes 0; 0 is off. ScaleZ -1000000000 to 1000000000. EncoderNo 0 to 255."""
    def set_fly_rot(self, Resolution: float) -> None:
        """List command: turns with Encoder0, which becomes 0; counts a turn, positive is counter-clockwise, under 100 is off. Resolution -1000000000 to 1000000000."""
    def set_fly_2d(self, ScaleX: float, ScaleY: float) -> None:
        """List command: X and Y move with both encoders and the compensation table. ScaleX -1000000000 to 1000000000. ScaleY -1000000000 to 1000000000."""
    def set_fly_x_pos(self, ScaleX: float) -> None:
        """List command: X moves with the McBSP word; 0 is off. ScaleX -1000000000 to 1000000000."""
    def set_fly_y_pos(self, ScaleY: float) -> None:
        """List command: Y moves with the McBSP word; 0 is off. ScaleY -1000000000 to 1000000000."""
    def set_fly_rot_pos(self, Resolution: float) -> None:
        """List command: turns with the McBSP word; under 100 is off. Resolution -1000000000 to 1000000000."""
    def activate_fly_xy(self, ScaleX: float, ScaleY: float) -> None:
        """List command: as set_fly_x and set_fly_y; the encoders keep their counts. ScaleX -1000000000 to 1000000000. ScaleY -1000000000 to 1000000000."""
    def activate_fly_2d(self, ScaleX: float, ScaleY: float) -> None:
        """List command: as set_fly_2d; the encoders keep their counts. ScaleX -1000000000 to 1000000000. ScaleY -1000000000 to 1000000000."""
    def fly_return(self, X: float, Y: float) -> None:
        """List command: turns all corrections off, then jumps. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits."""
    def fly_return_z(self, X: float, Y: float, Z: float) -> None:
        """List command: as fly_return; Z changes at once. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits. Z -8388608 to 8388607 bits."""
    def set_rot_center_list(self, X: float, Y: float) -> None:
        """List command: centre of the rotary corrections. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits."""
    def store_encoder(self, Pos: float) -> None:
        """List command: stores both counts for read_encoder. Pos 0 to 255."""
    def wait_for_encoder(self, Value: float, EncoderNo: float) -> None:
        """List command: as wait_for_encoder_mode with Mode 0. Value -2147483648 to 2147483647 counts. EncoderNo 0 to 255."""
    def wait_for_encoder_mode(self, Value: float, EncoderNo: float, Mode: float) -> None:
        """List command: waits until the count is reached. Value -2147483648 to 2147483647 counts. EncoderNo 0 to 255. Mode -2147483648 to 2147483647."""
    def wait_for_encoder_in_range(self, EncXmin: float, EncXmax: float, EncYmin: float, EncYmax: float) -> None:
        """List command: waits until both counts are in range. EncXmin -2147483648 to 2147483647 counts. EncXmax -2147483648 to 2147483647 counts. EncYmin -2147483648 to 2147483647 counts. EncYmax -2147483648 to 2147483647 counts."""
    def wait_for_mcbsp(self, Axis: float, Value: float, Mode: float) -> None:
        """List command: waits until the McBSP value is reached. Axis 0 to 255. Value -2147483648 to 2147483647 counts. Mode -2147483648 to 2147483647."""
    def set_fly_limits(self, Xmin: float, Xmax: float, Ymin: float, Ymax: float) -> None:
        """List command: the area monitored by bits 4 to 7. Xmin -8388608 to 8388607 bits. Xmax -8388608 to 8388607 bits. Ymin -8388608 to 8388607 bits. Ymax -8388608 to 8388607 bits."""
    def set_fly_limits_z(self, Zmin: float, Zmax: float) -> None:
        """List command: the Z range monitored by bits 24 and 25. Zmin -8388608 to 8388607 bits. Zmax -8388608 to 8388607 bits."""
    def if_fly_x_overflow(self, Mode: float) -> None:
        """List command: executes the next command only if bit 4 or 5 is set; clears them. Mode -2147483648 to 2147483647."""
    def if_fly_y_overflow(self, Mode: float) -> None:
        """List command: the same for bits 6 and 7. Mode -2147483648 to 2147483647."""
    def if_fly_z_overflow(self, Mode: float) -> None:
        """List command: the same for bits 24 and 25. Mode -2147483648 to 2147483647."""
    def if_not_fly_x_overflow(self, Mode: float) -> None:
        """List command: executes the next command only if they are not set; clears them. Mode -2147483648 to 2147483647."""
    def if_not_fly_y_overflow(self, Mode: float) -> None:
        """List command: the same for bits 6 and 7. Mode -2147483648 to 2147483647."""
    def if_not_fly_z_overflow(self, Mode: float) -> None:
        """List command: the same for bits 24 and 25. Mode -2147483648 to 2147483647."""
    def clear_fly_overflow(self, Mode: float) -> None:
        """List command: clears bits 4, 5 (Mode bit 0), 6, 7 (bit 1), 24, 25 (bit 2); 0: all. Mode -2147483648 to 2147483647."""
    def park_position(self, Mode: float, X: float, Y: float) -> None:
        """List command: jumps away; with Mode 0 the correction pauses. Mode -2147483648 to 2147483647. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits."""
    def park_return(self, Mode: float, X: float, Y: float) -> None:
        """List command: jumps back: Mode 0 to the position before, else to X, Y. Mode -2147483648 to 2147483647. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits."""
    def set_ext_start_delay_list(self, Delay: float, EncoderNo: float) -> None:
        """List command: track delay of external starts. Delay -2147483648 to 2147483647 counts. EncoderNo 0 to 255."""
    def simulate_ext_start(self, Delay: float, EncoderNo: float) -> None:
        """List command: an external start with this track delay. Delay -2147483648 to 2147483647 counts. EncoderNo 0 to 255."""
    def set_control_mode_list(self, Mode: float) -> None:
        """List command: bits 0, 9, 10: external start, reset at start, equidistant. Mode 0 to 65535."""
    def set_encoder_speed(self, EncoderNo: float, Speed: float, Smooth: float) -> None:
        """List command: target and smoothing of the encoder's speed. EncoderNo 0 to 255. Speed -1000000000 to 1000000000. Smooth -1000000000 to 1000000000."""
    def set_mcbsp_in_list(self, Mode: float, Scale: float) -> None:
        """List command: X (1), Y (2) or both (3) move with the McBSP word; 0 is off. Mode -2147483648 to 2147483647. Scale -1000000000 to 1000000000."""
    def set_multi_mcbsp_in_list(self, Ctrl: float, P: float, Mode: float) -> None:
        """List command: McBSP words carry their type: x, y, z, laser power and parameters. Ctrl 0 to 255. P 0 to 4294967295 times 10 us. Mode -2147483648 to 2147483647."""
    def get_mcbsp_list(self) -> None:
        """List command: stores the McBSP word in memory location 0."""
    def set_mcbsp_x_list(self, ScaleX: float) -> None:
        """List command: online positioning of X; 0 is off. ScaleX -1000000000 to 1000000000."""
    def set_mcbsp_y_list(self, ScaleY: float) -> None:
        """List command: online positioning of Y; 0 is off. ScaleY -1000000000 to 1000000000."""
    def set_mcbsp_rot_list(self, Resolution: float) -> None:
        """List command: online positioning of the angle; under 100 is off. Resolution -1000000000 to 1000000000."""
    def set_mcbsp_matrix_list(self) -> None:
        """List command: online positioning of matrix coefficients."""
    def apply_mcbsp_list(self, HeadNo: float, at_once: float) -> None:
        """List command: applies the online positioning to a head. HeadNo 1 to 4. at_once 0 to 255."""
    def set_matrix_list(self, HeadNo: float, Ind1: float, Ind2: float, Mij: float, at_once: float) -> None:
        """List command: one coefficient of the matrix. HeadNo 1 to 4. Ind1 0 to 255. Ind2 0 to 255. Mij -50 to 50. at_once 0 to 255."""
    def set_offset_list(self, HeadNo: float, XOffset: float, YOffset: float, at_once: float) -> None:
        """List command: offset behind the matrix. HeadNo 1 to 4. XOffset -8388608 to 8388607 bits. YOffset -8388608 to 8388607 bits. at_once 0 to 255."""
    def set_angle_list(self, HeadNo: float, Angle: float, at_once: float) -> None:
        """List command: rotation, counter-clockwise. HeadNo 1 to 4. Angle -3600 to 3600 degrees. at_once 0 to 255."""
    def set_scale_list(self, HeadNo: float, Scale: float, at_once: float) -> None:
        """List command: scaling, -16 to 16. HeadNo 1 to 4. Scale -50 to 50. at_once 0 to 255."""
    def set_trigger(self, Period: float, Signal1: float, Signal2: float) -> None:
        """List command: records two signals from this tick on, one sample a period; 0 ends it. Period 0 to 4294967295 times 10 us. Signal1 0 to 255. Signal2 0 to 255."""
    def set_trigger4(self, Period: float, Signal1: float, Signal2: float, Signal3: float, Signal4: float) -> None:
        """List command: as set_trigger, four signals. Period 0 to 4294967295 times 10 us. Signal1 0 to 255. Signal2 0 to 255. Signal3 0 to 255. Signal4 0 to 255."""
    def set_wobbel(self, Transversal: float, Longitudinal: float, Freq: float) -> None:
        """List command: marks are widened by an ellipse across and along the motion; amplitudes of 0 or a frequency of 0 are off. Transversal 0 to 131071 bits. Longitudinal 0 to 131071 bits. Freq -6000 to 6000 Hz."""
    def list_call(self, Pos: float) -> None:
        """List command: continues at Pos, until list_return. Pos 0 to 1048575."""
    def sub_call(self, Index: float) -> None:
        """List command: the same with a subroutine of load_sub. Index 0 to 1023."""
    def list_return(self) -> None:
        """List command: continues after the call."""
    def set_start_list(self, ListNo: int, Pos: int = 0) -> None:
        """List commands go to list 1 or 2 from here on, from that position."""
    def load_list(self, ListNo: int, Pos: int = 0) -> int:
        """As set_start_list, for a list that is not running: 1, 2, 0 (the free one) or 3 (free and run to its end); returns the opened list, or 0."""
    def load_sub(self, index: int) -> None:
        """The commands up to list_return become subroutine 0 to 1023."""
    def config_list(self, list1: int, list2: int) -> None:
        """Positions of list 1 and list 2; -1: the rest."""
    def execute_list(self, ListNo: int, Pos: int = 0) -> None:
        """Starts list 1 or 2."""
    def auto_change(self) -> None:
        """The other list starts when this one ends."""
    def start_loop(self) -> None:
        """Lists 1 and 2 run in turn."""
    def quit_loop(self) -> None:
        """Ends the alternation of the lists."""
    def pause_list(self) -> None:
        """Holds the list."""
    def restart_list(self) -> None:
        """Continues the list after pause_list."""
    def stop_execution(self) -> None:
        """Ends the list at once."""
    def external_start(self) -> None:
        """Simulates a start signal."""
    def external_stop(self) -> None:
        """Simulates a stop signal."""
    def enable_laser(self) -> None:
        """Enables the laser's signals."""
    def disable_laser(self) -> None:
        """Disables the laser's signals."""
    def goto_xy(self, x: float, y: float) -> None:
        """Jumps to X and Y, bits, while no list runs."""
    def set_jump_speed_ctrl(self, bits_ms: float) -> None:
        """Jump speed, 1.6 to 800,000 bits/ms."""
    def set_mark_speed_ctrl(self, bits_ms: float) -> None:
        """Mark speed, 1.6 to 800,000 bits/ms."""
    def set_control_mode(self, mode: int) -> None:
        """Bit 0: the start line starts a list."""
    def set_matrix(self, head: int, matrix: Sequence[float], at_once: int = 1) -> None:
        """Matrix m11, m12, m21, m22 of a head, 1 to 4."""
    def set_offset(self, head: int, x: float, y: float, at_once: int = 1) -> None:
        """Offset of a head, bits."""
    def set_angle(self, head: int, degrees: float, at_once: int = 1) -> None:
        """Rotation of a head, degrees."""
    def set_scale(self, head: int, scale: float, at_once: int = 1) -> None:
        """Scale of a head."""
    def read_status(self) -> int:
        """Status of the lists, as read_status."""
    def get_status(self) -> tuple[int, int]:
        """(status, position in the list)."""
    def get_marking_info(self) -> int:
        """Errors of marking, bits; reading clears them. See marking_info_text."""
    @staticmethod
    def marking_info_text(bits: int) -> list[str]:
        """A sentence for each bit."""
    def get_startstop_info(self) -> int:
        """Events of the start and stop lines, bits."""
    def get_value(self, signal: int) -> int:
        """A signal by its number, 0 to 255."""
    def get_encoder(self) -> tuple[int, int]:
        """(encoder 0, encoder 1), counts."""
    def list_space(self) -> int:
        """Free positions of the open list."""
    def busy(self) -> bool:
        """Whether a list runs; takes no time."""
    def output(self) -> tuple[int, int, bool]:
        """Position of head A (bits), and whether its laser is on; takes no time."""
    def wait(self, timeout: float = 60.0) -> None:
        """Waits for standstill of the card; Timeout after timeout s."""
    @property
    def question_seconds(self) -> float:
        """Duration of a query, s; initially 10 us."""
    @question_seconds.setter
    def question_seconds(self, value: float) -> None: ...
    def select_cor_table(self, HeadA: int, HeadB: int) -> None:
        """The tables of both heads; 0: head A 1:1, head B without output. HeadA 0 to 4. HeadB 0 to 4. Refused out of range; nothing is changed. Source: the RTC5 manual 1.9 e, pages 124 and 125."""
    def get_table_para(self, TableNo: int, ParaNo: int) -> float:
        """A word of the header of a correction table, 1 is K in bits/mm; 0 of a 1:1 table. TableNo 1 to 4. ParaNo 0 to 15. Refused out of range; nothing is changed. Source: the RTC5 manual 1.9 e, pages 124 and 125."""
    def get_head_para(self, HeadNo: int, ParaNo: int) -> float:
        """The same of the table that a head has. HeadNo 1 to 2. ParaNo 0 to 15. Refused out of range; nothing is changed. Source: the RTC5 manual 1.9 e, pages 124 and 125."""
    def set_start_list_1(self) -> None:
        """List commands go to list 1 from here on. Source: the RTC5 manual 1.9 e, pages 70 to 73."""
    def set_start_list_2(self) -> None:
        """List commands go to list 2 from here on. Source: the RTC5 manual 1.9 e, pages 70 to 73."""
    def set_start_list_pos(self, ListNo: int, Pos: int) -> None:
        """List commands go to that position of list 1 (odd numbers) or 2 (even ones); behind its end it is 0. ListNo 0 to 4294967295. Pos 0 to 1048575. Refused out of range; nothing is changed. Source: the RTC5 manual 1.9 e, pages 70 to 73."""
    def get_input_pointer(self) -> int:
        """The position of the next list command in the whole list memory. Source: the RTC5 manual 1.9 e, pages 70 to 73."""
    def get_list_space(self) -> int:
        """Free positions in the open list. Source: the RTC5 manual 1.9 e, pages 70 to 73."""
    def execute_list_1(self) -> None:
        """Starts list 1; refused while a list runs or the card moves. Source: the RTC5 manual 1.9 e, pages 70 to 73."""
    def execute_list_2(self) -> None:
        """Starts list 2; refused while a list runs or the card moves. Source: the RTC5 manual 1.9 e, pages 70 to 73."""
    def execute_list_pos(self, ListNo: int, Pos: int) -> None:
        """Starts a list at a position of it; refused while a list runs or the card moves. ListNo 0 to 4294967295. Pos 0 to 1048575. Refused out of range; nothing is changed. Source: the RTC5 manual 1.9 e, pages 70 to 73."""
    def execute_at_pointer(self, Pos: int) -> None:
        """Starts at a position in the whole list memory; refused while a list runs or the card moves. Pos 0 to 1048575. Refused out of range; nothing is changed. Source: the RTC5 manual 1.9 e, pages 70 to 73."""
    def set_delay_mode(self, VarPoly: int, DirectMove3D: int, EdgeLevel: int, MinJumpDelay: int, JumpLengthLimit: int) -> None:
        """VarPoly other than 0: polygon delays by the angle, the laser off in those above EdgeLevel; jumps shorter than JumpLengthLimit have delays down to MinJumpDelay; DirectMove3D changes nothing. VarPoly 0 to 4294967295. DirectMove3D 0 to 4294967295. EdgeLevel 0 to 4294967295 times 10 us. MinJumpDelay 0 to 4294967295 times 10 us. JumpLengthLimit 0 to 16777215 bits. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def set_hi(self, HeadNo: int, GalvoGainX: float, GalvoGainY: float, GalvoOffsetX: int, GalvoOffsetY: int) -> None:
        """Gain and offset behind the table of head 1 (A), 2 (B), or both (3). HeadNo 1 to 3. GalvoGainX -16 to 16. GalvoGainY -16 to 16. GalvoOffsetX -524288 to 524287 bits. GalvoOffsetY -524288 to 524287 bits. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def write_io_port(self, Value: int) -> None:
        """Sets the 16 digital outputs. Value 0 to 65535. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def get_io_status(self) -> int:
        """The 16 digital outputs. Takes the time of a query. Source: the maker's header of the RTC5 of 2013."""
    def simulate_encoder(self, EncoderNo: int) -> None:
        """Simulates encoder 0 (1), encoder 1 (2) or both (3) at 1000000 counts/s; 0 ends it. EncoderNo 0 to 3. Refused out of range; nothing is changed. Source: the RTC5 manual 1.10 d (German), page 198."""
    def read_encoder(self) -> tuple[int, int, int, int]:
        """Counts that store_encoder kept: encoder 0 and 1 of Pos 0, then of Pos 1. Takes the time of a query. Source: the maker's header of the RTC5 of 2013."""
    def set_rot_center(self, X: int, Y: int) -> None:
        """Centre of the rotary corrections. X -8388608 to 8388607 bits. Y -8388608 to 8388607 bits. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def set_fly_tracking_error(self, TrackingErrorX: int, TrackingErrorY: int) -> None:
        """Lag of the mirrors; encoder counts are extrapolated by it. TrackingErrorX 0 to 65535 times 10 us. TrackingErrorY 0 to 65535 times 10 us. Refused out of range; nothing is changed. Source: the RTC5 manual 1.9 e, page 428."""
    def init_fly_2d(self, OffsetX: int, OffsetY: int) -> None:
        """Zeroes both encoders; these values are added to their counts in 2D corrections. OffsetX -2147483648 to 2147483647 counts. OffsetY -2147483648 to 2147483647 counts. Refused out of range; nothing is changed. Source: the RTC5 manual 1.9 e, page 185."""
    def get_fly_2d_offset(self) -> tuple[int, int]:
        """(OffsetX, OffsetY) of init_fly_2d, counts. Takes the time of a query. Source: the RTC5 manual 1.9 e, page 185."""
    def set_encoder_speed_ctrl(self, EncoderNo: int, Speed: float, Smooth: float) -> None:
        """Target (taken as 100 to 16000 counts/ms) and smoothing of the speed of encoder 0, 1, or both (2, 3). EncoderNo 0 to 3. Speed -1000000000 to 1000000000 counts/ms. Smooth 0 to 1. Refused out of range; nothing is changed. Source: the RTC5 manual 1.9 e, page 419."""
    def set_ext_start_delay(self, Delay: int, EncoderNo: int) -> None:
        """The track delay of external starts. Delay -2147483648 to 2147483647 counts. EncoderNo 0 to 1. Refused out of range; nothing is changed. Source: the RTC5 manual 1.9 e, page 511."""
    def set_extstartpos(self, Pos: int) -> None:
        """The position in the whole list memory at which an external start begins. Pos 0 to 1048575. Refused out of range; nothing is changed. Source: the RTC5 manual 1.9 e, page 511."""
    def simulate_ext_start_ctrl(self) -> None:
        """Simulates a start signal. Source: the RTC5 manual 1.9 e, page 511."""
    def simulate_ext_stop(self) -> None:
        """Simulates a stop signal. Source: the maker's header of the RTC5 of 2013."""
    def mcbsp_init(self, XDelay: int, RDelay: int) -> None:
        """Accepted without effect: the frame on the wire is not simulated. XDelay 0 to 2 bits. RDelay 0 to 2 bits. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def mcbsp_init_spi(self, ClockLevel: int, ClockDelay: int) -> None:
        """Accepted without effect: the frame on the wire is not simulated. ClockLevel 0 to 1. ClockDelay 0 to 1. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def set_mcbsp_freq(self, Freq: int) -> int:
        """Returns Freq without effect: the frame on the wire is not simulated. Freq 1 to 50000000 Hz. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def get_mcbsp(self) -> int:
        """The present word, signed, which goes to memory location 0 too; refused before the first word. Takes the time of a query. Source: the maker's header of the RTC5 of 2013."""
    def read_mcbsp(self, No: int) -> int:
        """Memory location No; refused while it is empty, with the command that fills it. Location 0 is filled from set_fly_x_pos (or _y_pos, _rot_pos, set_mcbsp_in) on. Of two axes X is the low half of the word and Y the high one, each of 16 bits with its sign. A scale is K / i, i = (end - start) / distance in bits/mm. No 0 to 3. Takes the time of a query. Refused out of range; nothing is changed. Source: the RTC5 manual 1.10 d (German), page 198."""
    def read_multi_mcbsp(self, No: int) -> int:
        """The last value of a type, after set_multi_mcbsp_in. No 0 to 7. Takes the time of a query. Refused out of range; nothing is changed. Source: the RTC6 manual 1.0.21, page 703."""
    def set_mcbsp_in(self, Mode: int, Scale: float) -> None:
        """Corrects X (Mode 1), Y (2) or both (3) by the McBSP word; 0 is off. The word is stored in memory location 0, in Mode 1 also in location 1, in Mode 2 also in 2; Mode 3 also stores X in 1, Y in 2 and the whole word in 3. Mode 0 to 3. Scale -1000000000 to 1000000000 bits/bit. Refused out of range; nothing is changed. Source: the RTC5 manual 1.10 d (German), page 198."""
    def set_multi_mcbsp_in(self, Ctrl: int, P: int, Mode: int) -> None:
        """McBSP words carry their type: x, y, z, laser power and parameters; they go to the locations 0 to 3 in turn. Ctrl 0 to 255. P 0 to 4294967295 /16384. Mode -2147483648 to 2147483647. Refused out of range; nothing is changed. Source: the RTC6 manual 1.0.21, page 703."""
    def set_mcbsp_x(self, ScaleX: float) -> None:
        """Online positioning of X; 0 is off. ScaleX -1000000000 to 1000000000 bits/bit. Refused out of range; nothing is changed. Source: the RTC5 manual 1.9 e, page 166."""
    def set_mcbsp_y(self, ScaleY: float) -> None:
        """Online positioning of Y; 0 is off. ScaleY -1000000000 to 1000000000 bits/bit. Refused out of range; nothing is changed. Source: the RTC5 manual 1.9 e, page 166."""
    def set_mcbsp_rot(self, Resolution: float) -> None:
        """Online positioning of the angle; under 100 is off. Resolution -1000000000 to 1000000000 bits a turn. Refused out of range; nothing is changed. Source: the RTC5 manual 1.9 e, page 166."""
    def set_mcbsp_matrix(self) -> None:
        """Online positioning of matrix coefficients. Source: the RTC5 manual 1.9 e, page 166."""
    def apply_mcbsp(self, HeadNo: int, at_once: int) -> None:
        """Applies the online positioning to a head; at_once 2: with the next jump. HeadNo 1 to 4. at_once 0 to 3. Refused out of range; nothing is changed. Source: the RTC5 manual 1.9 e, page 166."""
    def set_mcbsp_out(self, Signal1: int, Signal2: int) -> None:
        """Sends two signals of get_value in turn, one word in 10 us. Signal1 0 to 255. Signal2 0 to 255. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def measurement_status(self) -> tuple[int, int]:
        """(Busy, Pos): whether set_trigger records; Pos + 1 samples are there, none: -1. Takes the time of a query. Source: the maker's header of the RTC5 of 2013."""
    def stop_trigger(self) -> None:
        """Ends a recording; its samples stay. Source: the maker's header of the RTC5 of 2013."""
    def set_laser_mode(self, Mode: int) -> None:
        """Accepted without effect: the laser is only on or off here. Mode 0 to 4294967295. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def set_laser_control(self, Ctrl: int) -> None:
        """Accepted without effect: the laser is only on or off here. Ctrl 0 to 4294967295. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def set_standby(self, HalfPeriod: int, PulseLength: int) -> None:
        """Accepted without effect: the laser is only on or off here. HalfPeriod 0 to 4294967295. PulseLength 0 to 4294967295. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def set_laser_pulses_ctrl(self, HalfPeriod: int, PulseLength: int) -> None:
        """Accepted without effect: the laser is only on or off here. HalfPeriod 0 to 4294967295. PulseLength 0 to 4294967295. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def set_firstpulse_killer(self, Length: int) -> None:
        """Accepted without effect: the laser is only on or off here. Length 0 to 4294967295. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def set_qswitch_delay(self, Delay: int) -> None:
        """Accepted without effect: the laser is only on or off here. Delay 0 to 4294967295. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def set_laser_pulses(self, HalfPeriod: int, PulseLength: int) -> None:
        """Accepted without effect: the laser is only on or off here. HalfPeriod 0 to 4294967295. PulseLength 0 to 4294967295. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def set_laser_timing(self, HalfPeriod: int, PulseLength1: int, PulseLength2: int, TimeBase: int) -> None:
        """Accepted without effect: the laser is only on or off here. HalfPeriod 0 to 4294967295. PulseLength1 0 to 4294967295. PulseLength2 0 to 4294967295. TimeBase 0 to 4294967295. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def set_firstpulse_killer_list(self, Length: int) -> None:
        """Accepted without effect: the laser is only on or off here. Length 0 to 4294967295. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def set_qswitch_delay_list(self, Delay: int) -> None:
        """Accepted without effect: the laser is only on or off here. Delay 0 to 4294967295. Refused out of range; nothing is changed. Source: the maker's header of the RTC5 of 2013."""
    def init_rtc5_dll(self) -> int:
        """Returns 0: nothing has to be loaded. Source: the maker's header of the RTC5 of 2013."""
    def rtc5_count_cards(self) -> int:
        """Cards of type rtc5 in the rack. Source: the maker's header of the RTC5 of 2013."""
    def select_rtc(self, CardNo: int) -> int:
        """Directs the commands of this object to the rack's card CardNo of type rtc5 from here on, 1 is the first in the rack file; returns CardNo. Refused if it does not exist. Source: the maker's header of the RTC5 of 2013."""
    def free_rtc5_dll(self) -> None:
        """Releases the card: commands of this object are refused until select_rtc. Source: the maker's header of the RTC5 of 2013."""
    def get_last_error(self) -> int:
        """Error bits of the last command of this object that was done or refused, 0: none; its sentence is that of the exception. 2 unknown card, 16 a parameter is wrong, 32 a list is running or the card moves, 64 the list is full, none is open, or nothing can be read. See error_text. Source: the maker's header of the RTC5 of 2013."""
    def get_error(self) -> int:
        """The error bits of all commands since reset_error. Source: the maker's header of the RTC5 of 2013."""
    def reset_error(self, Code: int) -> None:
        """Clears these bits of get_error. Code 0 to 4294967295. Source: the maker's header of the RTC5 of 2013."""
    @staticmethod
    def error_text(bits: int) -> list[str]:
        """A sentence for each of the bits 0 to 6 of get_last_error."""
    def load_program_file(self, Path: str | None = None) -> int:
        """Resets the card to power-up, except McBSP location 0, which continues; the name is ignored. Returns 0. Source: the RTC5 manual 1.10 d (German), page 198."""
    def load_correction_file(self, Name: str | None, No: int, Dim: int = 2) -> int:
        """Loads a .ct5 file as table No 1 to 4, None: a 1:1 table; Dim 2 or 3 (3D parts of a file are not used). Returns 0. InvalidInput where it is damaged (its checksum does not fit, K is 0 although one is known, the table cannot be inverted), FileError where it cannot be read; the table is then as before. A UserWarning where it is of a program before version 4.0, whose checksum is not known. Source: the RTC5 manual 1.9 e, pages 124 and 125."""
    def table_note(self, TableNo: int) -> str:
        """Note on the file of table TableNo 1 to 4: its checksum is not known; "": no note."""
    def load_fly_2d_table(self, Name: str | None, No: int) -> int:
        """Loads the section [Fly2DTableNo] of a text file: lines of counts Enc0 Enc1 dEnc0 dEnc1; None: no table. Returns 0. No 0 to 4294967295. InvalidInput with the line where it is wrong, FileError where it cannot be read; the table is then as before. Source: the RTC5 manual 1.9 e, page 185."""
    def set_mcbsp_out_ptr(self, SignalPtr: Sequence[int]) -> None:
        """Sends these signals of get_value in turn, one word in 10 us; at most 8, none: sending ends. Refused: a signal that is not there. Source: the maker's header of the RTC5 of 2013."""
    def get_waveform(self, Channel: int, Number: int) -> npt.NDArray[np.int32]:
        """The first Number samples of Channel 1 to 4 of a recording (set_trigger). Refused if fewer are available. Source: the maker's header of the RTC5 of 2013."""
