"""A part with lines and arcs, from Python."""

import motionrack

with motionrack.Rack.template("router") as rack:
    outcome = rack.run(path="part.ngc")
    print(outcome)
