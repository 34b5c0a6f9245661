"""The first move, from Python."""

import motionrack

with motionrack.Rack.template("router") as rack:
    outcome = rack.run(path="first_move.ngc")
    print(outcome)
