"""A transfer carriage by the card's own commands: A to C fast and held there, C gently to B, back to A at limited
speed. Then once more with an end stop whose contact opens on the way, and once with the emergency button.

    A 0 ───────────── B 128000 ───────────── C 256000 counts of 0.01 mm
"""

import sys
import tomllib

import motionrack

A, B, C = 0, 128_000, 256_000
COUNTS_PER_MM = 100
MOST_RATE = 16383

with open("machine.toml", "rb") as file:
    velocity_per_volt = tomllib.load(file)["axis"]["X"]["servo"]["velocity_per_volt_mm_s"]
SCALE = motionrack.SpeedScale(counts_per_volt=velocity_per_volt * COUNTS_PER_MM)


class Carriage:
    def __init__(self, faults: list[str]) -> None:
        self.rack = motionrack.Rack.from_file("machine.toml")
        for fault in faults:
            self.rack.plan_fault(fault)
        self.board = self.rack.cards["board"].open(counts_per_mm=COUNTS_PER_MM)

    def leg(self, name: str, target: int, counts_s2: float, rate: int) -> None:
        """One positioning with a slope of its own; what the table says of it beforehand, and how long it took."""
        rack, board = self.rack, self.board
        table = motionrack.SlopeTable.design(49_000, counts_s2, counts_s2, SCALE, creep_speed=300, lag_s=0.01)
        here = board.position()
        motion = table.motion(abs(target - here), rate, SCALE)
        board.set_slope(table)
        board.on_regulation()
        board.set_rate(rate)
        begun = rack.ticks
        board.move_to(target, timeout=60, interrupt=True)
        took = (rack.ticks - begun) * 1e-10
        rack.advance(ms=100)  # it comes to rest
        there = board.position()
        print(
            f"  {name:<5} {abs(target - here):>7} counts  by the table {motion['duration_s']:6.3f} s, "
            f"took {took:6.3f} s, at most {motion['top_speed'] / COUNTS_PER_MM:3.0f} mm/s, "
            f"stands {there - target:+d} counts from its target"
        )

    def run(self) -> None:
        self.board.connect()
        self.leg("A-C", C, 100_000, MOST_RATE)
        self.board.set_deviation(25)
        self.board.lock()
        self.rack.advance(1)
        self.leg("C-B", B, 30_000, MOST_RATE)
        self.rack.advance(ms=500)
        self.leg("B-A", A, 100_000, SCALE.rate_for(10_000))

    def go_home(self) -> None:
        """After a stop: waits until the carriage stands and the button is released, then goes to A slowly."""
        self.rack.advance(ms=300)
        while self.board.emergency():
            self.rack.advance(ms=10)
        print(f"  {self.board.stops() or 'every stop is released'}; back to A slowly")
        self.leg("to A", A, 100_000, SCALE.rate_for(10_000))


print("as it should be")
good = Carriage([])
with good.rack.record("X.position_mm", "X.speed_mm_s", "X.drive_v", period=5e-3) as recording:
    good.run()
if len(sys.argv) > 1:
    recording.trace.plot(path=sys.argv[1])

# The contact of the right end stop opens at 2 s; the button is pressed at 9 s and turned out again two seconds later.
for faults in (["X.limit_plus=0@2s"], ["estop=0@9s", "estop=release@11s"]):
    print(f"with {', '.join(faults)}")
    carriage = Carriage(faults)
    try:
        carriage.run()
    except motionrack.MachineFault as fault:
        print(f"  {fault.message}")
    carriage.go_home()
    carriage.rack.close()
good.rack.close()
