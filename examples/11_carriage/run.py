"""A transfer carriage as a part program, from Python: as it should be, with an end stop that opens,
with the emergency button, and homed."""

import sys

import motionrack

for faults in ((), ("X.limit_plus=0@2s",), ("estop=0@9s",)):
    with motionrack.Rack.from_file("machine.toml") as rack:
        outcome = rack.run(path="carriage.ngc", faults=faults)
        print(outcome)
        if outcome.error:
            print(f"line {outcome.error.line}: {outcome.error.message}", file=sys.stderr)

with motionrack.Rack.from_file("machine.toml") as rack:
    print(rack.home(type=2))
