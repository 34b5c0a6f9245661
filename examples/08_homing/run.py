"""Two axes find their home switches, from Python."""

import motionrack

for machine, axes, method in (("machine.toml", "", None), ("machine.toml", "X", 3), ("unlucky.toml", "", None)):
    with motionrack.Rack.from_file(machine) as rack:
        print(rack.home(axes, type=method))
with motionrack.Rack.from_file("unlucky.toml") as rack:
    print(rack.home(type=2).json())
