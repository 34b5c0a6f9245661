#!/usr/bin/python3
"""Draws the picture of docs/howto/python.md without matplotlib:
python3 python/tools/picture.py docs/pictures/python_trace.svg."""

import sys

import motionrack

rack = motionrack.Rack.template("router")
outcome = rack.run("G21 G90\nG1 X10 Y5 F600\nG3 X20 Y15 I0 J10\nG0 X0 Y0\nM2\n")
outcome.trace.title = "An arc on the router"
outcome.trace.save_svg(sys.argv[1], "x.position", "y.position", "x.velocity", "y.velocity")
