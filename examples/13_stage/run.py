"""A scan and a step stage whose loops are closed by two cards: how far they are apart when the cards read one instant,
and when they do not."""

import math
import sys
from dataclasses import dataclass, field
from pathlib import Path

import motionrack

RATIO = 4  # the mask's picture is four times as large as the wafer's
MACHINE = Path("machine.toml").read_text(encoding="utf-8")


@dataclass
class Trial:
    """Differences from the rack file, and a fault."""

    name: str
    offset_us: tuple[float, ...] = ()  # not empty: all three cards are hosts, without checks, their clocks so far apart
    drift_ppm: float = 0  # of the clock of card "step"
    control_delay_us: float = 20
    fault_value: float | None = None  # of card "step", at 0.25 s: how many ns late it reads
    record: list[tuple[float, float]] = field(default_factory=list)  # s, nm

    def rack(self) -> motionrack.Rack:
        text = MACHINE.replace("servo = {}", f"servo = {{ control_delay_us = {self.control_delay_us} }}")
        text = text.replace("servo = { profile", f"servo = {{ control_delay_us = {self.control_delay_us}, profile")
        for card, offset in zip(("host", "scan", "step"), self.offset_us):
            keys = f'role = "host"\nverify_lines = false\noffset_ns = {1e3 * offset!r}\n'
            text = text.replace(f"[card.{card}]\n", f"[card.{card}]\n{keys}")
        rack = motionrack.Rack.from_text(text, "machine.toml")
        if self.drift_ppm:
            rack.change_card("step", period_us=200 * (1 + 1e-6 * self.drift_ppm))  # which a rack file may not
        return rack


def scanning(tick: int) -> bool:
    """The mask goes at its speed: 250 ms to, 28 ms to turn, 250 ms fro."""
    return (tick * 200 - 18_000) % 278_000 <= 250_000 if tick * 200 >= 18_000 else False


def length(nm: float) -> str:
    return f"{nm:.0f} nm" if nm < 1e5 else f"{nm * 1e-6:.1f} mm"


def run(trial: Trial) -> None:
    """Looks at each pulse where the stages really are, which no card knows."""
    with trial.rack() as rack:
        mask, wafer = rack.parts["scan_x"], rack.parts["step_x"]
        apart = []
        for tick in range(5750):  # pulses of 200 us
            rack.advance(us=200 if tick else 0)
            if tick == 1250 and trial.fault_value is not None:
                rack.fault("step", "late", trial.fault_value)
            nm = (mask.position_mm - RATIO * wafer.position_mm) * 1e6
            trial.record.append((rack.time, nm))
            if scanning(tick):
                apart.append(nm)
        print(trial.name)
        print(
            f"  following error that the cards see, at most: scan_x {length(mask.following_peak_nm)}, "
            f"step_x {length(wafer.following_peak_nm)}"
        )
        print(
            f"  scan_x - 4 step_x in truth, while scanning: at most {length(max(abs(nm) for nm in apart))}, "
            f"rms {length(math.sqrt(sum(nm * nm for nm in apart) / len(apart)))}"
        )
        step = rack.cards["step"]
        print(f"  conflicts on the bus {rack.bus_conflicts()}, frames that card step refused {step.refused_frames()}")
        for name, stage in rack.parts.items():
            if not stage.closed:
                print(f"  {name} is open")


TRIALS = [
    Trial("host and two slaves"),
    Trial("host and two slaves, processors that need 180 us", control_delay_us=180),
    Trial("host and two slaves, card step 5 us late from 0.25 s on", fault_value=5000),
    Trial("three hosts, clocks 3 and 7 us apart", offset_us=(0, 3, 7)),
    Trial("three hosts, one clock 5 ppm fast", offset_us=(0, 3, 7), drift_ppm=-5),
]
for trial in TRIALS:
    run(trial)
if len(sys.argv) > 1:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9, 4), layout="constrained")
    plot = figure.subplots()
    for trial in (TRIALS[0], TRIALS[3]):
        plot.plot(*zip(*trial.record), label=trial.name)
    plot.set(xlabel="s", ylabel="mask - 4 x wafer, nm")
    plot.legend()
    figure.savefig(sys.argv[1])
