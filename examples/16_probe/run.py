"""A workpiece found by a touch probe, from Python: the outcome tells where the probe touched."""

import sys

import motionrack

with motionrack.Rack.from_file("machine.toml") as rack:
    outcome = rack.run(path="probe.ngc")
    print(outcome)
    if outcome.error:
        print(f"line {outcome.error.line}: {outcome.error.message}", file=sys.stderr)
