"""A helix with the rotary axis, from Python. The warnings name the split moves and their deviation."""

import sys

import motionrack

with motionrack.Rack.template("router") as rack:
    outcome = rack.run(path="helix.ngc")
    print(outcome)
    for warning in outcome.warnings:
        print("warning:", warning.text, file=sys.stderr)
