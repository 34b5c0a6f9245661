"""Runs a part program on a rack from Python and prints where the machine stands."""

import motionrack

with motionrack.Rack.template("router") as rack:
    outcome = rack.run("G21 G90\nG1 X10 Y5 F600\nG3 X20 Y15 I0 J10\nM2\n")

    print(f"{outcome.duration_s:.3f} s")
    for axis in outcome.axes.values():
        print(f"{axis.axis} {axis.actual_end:.4f} {axis.unit}, {axis.pulses_sent} pulses")
