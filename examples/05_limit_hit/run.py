"""A limit hit on purpose, from Python: what the machine did wrong is the outcome's error."""

import sys

import motionrack

with motionrack.Rack.from_file("machine.toml") as rack:
    outcome = rack.run(path="limit_hit.ngc")
    print(outcome)
    if isinstance(outcome.error, motionrack.MachineFault):
        print(f"line {outcome.error.line}: {outcome.error.message}", file=sys.stderr)
