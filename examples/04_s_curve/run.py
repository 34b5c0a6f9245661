"""An S-curve against a T-curve, from Python."""

import motionrack

for machine in ("s_curve.toml", "trapezoid.toml"):
    with motionrack.Rack.from_file(machine) as rack:
        outcome = rack.run(path="move.ngc")
        print(outcome)
