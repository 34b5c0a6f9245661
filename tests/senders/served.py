"""Shared parts of the tests with real senders: a served rack, an observer at its Grbl port, comparison of paths."""
import csv
import os
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time

CARD = '[card.m]\ntype = "mcx314"\n'
AXIS = '[axis.{0}]\ncard = "m"\nchannel = "{1}"\n'
SWITCHES = "[axis.{0}.switches]\nhome_mm = 1\nlimit_minus_mm = -2\nlimit_plus_mm = 302\n"

PROGRAM = """G21 G90 G17
G0 X10 Y10
G1 Z5 F1200
G1 X40 F1500
G3 X50 Y20 I0 J10
G1 Y40
G3 X40 Y50 I-10 J0
G1 X10
G1 X20 Y30
G1 X10 Y10
G0 Z10
M2
"""
FIRST, END = (10.0, 10.0), (10.0, 10.0, 10.0)


def skip(sentence):
    print("skipped:", sentence)
    sys.exit(77)


def fail(sentence):
    print("failed:", sentence)
    sys.exit(1)


def near_first(place):
    """Returns whether a position is at the program's first corner in X and Y, with Z above 2 mm."""
    return place[2] > 2 and max(abs(place[0] - FIRST[0]), abs(place[1] - FIRST[1])) < 0.1


class Served:
    """Process `motionrack serve` with a rack of three axes, in a temporary folder; ends with the `with` block."""

    def __init__(self, program, homes=False):
        self.folder = tempfile.mkdtemp(prefix="motionrack-senders-")
        self.motionrack = program
        self.rack = os.path.join(self.folder, "rack.toml")
        self.link = os.path.join(self.folder, "tty")
        self.part = os.path.join(self.folder, "part.nc")
        rack = CARD + "".join((AXIS + (SWITCHES if homes else "")).format(axis, axis.lower()) for axis in "XYZ")
        for path, text in ((self.rack, rack), (self.part, PROGRAM)):
            with open(path, "w") as file:
                file.write(text)
        self.process = subprocess.Popen(
            [
                program,
                "serve",
                self.rack,
                "--port",
                "0",
                "--grbl-port",
                "0",
                "--grbl-pty",
                self.link,
                "--no-auth",
                "--users",
                os.path.join(self.folder, "users.json"),
            ],
            stdout=subprocess.PIPE,
            text=True,
        )
        self.port = None
        for line in self.process.stdout or ():
            found = re.search(r"senders +127\.0\.0\.1:(\d+)", line)
            if found:
                self.port = int(found[1])
            if line.startswith("Open the page"):
                break
        if self.port is None:
            fail("motionrack serve printed no port for senders")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(20)
        shutil.rmtree(self.folder, ignore_errors=True)

    def driven_by_run(self, from_first_corner=False):
        """Returns the true positions of `motionrack run`, every millisecond; or only those from the first corner on."""
        table = os.path.join(self.folder, "run.csv")
        subprocess.run(
            [self.motionrack, "run", self.part, "--rack", self.rack, "--csv", table, "--no-report", "-q"],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        with open(table) as file:
            path = [tuple(float(row[f"{axis}_position_mm"]) for axis in "xyz") for row in csv.DictReader(file)]
        return path[next(i for i, place in enumerate(path) if near_first(place)) :] if from_first_corner else path


def sender_comes(port, patience=60):
    """Waits until a client is connected to the port; returns False after `patience` s. Asks the kernel,
    as a connection of its own would take the sender's place."""
    until = time.time() + patience
    while time.time() < until:
        with open("/proc/net/tcp") as file:
            rows = [line.split() for line in file.readlines()[1:]]
        if any(row[1].endswith(f":{port:04X}") and row[3] == "01" for row in rows):
            return True
        time.sleep(0.1)
    return False


class Onlooker:
    """Observer that connects beside the sender and requests the status continuously."""

    def __init__(self, port, must_be_second=True):
        self.socket = socket.create_connection(("127.0.0.1", port))
        self.socket.settimeout(5)
        first = self.socket.recv(4096)
        if must_be_second and b"Another sender" not in first:
            fail(f"a sender was connected, and yet a second one was taken as the first: {first!r}")
        self.socket.settimeout(0.02)
        self.rest = ""
        self.seen, self.lines = [], []  # (state, position) at each change; all other lines

    def look(self, seconds, done):
        """Observes until `done(self)`; returns False after `seconds`. Keeps all that it observed."""
        until = time.time() + seconds
        while time.time() < until:
            self.socket.sendall(b"?")
            try:
                self.rest += self.socket.recv(65536).decode("ascii")
            except socket.timeout:
                continue
            *lines, self.rest = self.rest.split("\r\n")
            for line in lines:
                self.take(line)
            if done(self):
                return True
            time.sleep(0.005)
        return False

    def take(self, line):
        found = re.match(r"<(\w+)[^|]*\|MPos:([-\d.]+),([-\d.]+),([-\d.]+)", line)
        if not found:
            self.lines.append(line)
            return
        now = (found[1], tuple(float(found[i]) for i in (2, 3, 4)))
        if not self.seen or self.seen[-1] != now:
            self.seen.append(now)

    def places(self, begin=0):
        return [place for _, place in self.seen[begin:]]

    def states(self):
        return [state for i, (state, _) in enumerate(self.seen) if i == 0 or self.seen[i - 1][0] != state]

    def stands_at(self, place):
        return (
            bool(self.seen)
            and self.seen[-1][0] == "Idle"
            and all(abs(a - b) < 0.002 for a, b in zip(self.seen[-1][1], place))
        )


def distance_to_path(place, path):
    """Returns the distance from a position to a polyline, and the index of the nearest segment."""
    best = (1e9, 0)
    for i in range(len(path) - 1):
        a, b = path[i], path[i + 1]
        along = [b[k] - a[k] for k in range(3)]
        length = sum(v * v for v in along)
        t = max(0.0, min(1.0, sum((place[k] - a[k]) * along[k] for k in range(3)) / length)) if length > 0 else 0.0
        far = sum((place[k] - a[k] - t * along[k]) ** 2 for k in range(3)) ** 0.5
        best = min(best, (far, i))
    return best


def thin(path, least):
    out = [path[0]]
    for place in path[1:]:
        if sum((a - b) ** 2 for a, b in zip(place, out[-1])) >= least * least:
            out.append(place)
    return out + [path[-1]]


def compare(seen, driven):
    """Fails unless every observed position is on the path of `motionrack run`, and every part of it was observed."""
    fine = thin(driven, 0.05)
    worst = max(distance_to_path(place, fine)[0] for place in seen)
    if worst > 0.05:
        fail(f"the sender's path is up to {worst:.3f} mm beside that of motionrack run")
    gap = max(distance_to_path(place, seen)[0] for place in thin(driven, 1))
    if gap > 1.5:
        fail(f"a part of the path was not driven: {gap:.3f} mm away from all that was seen")
    print(f"{len(seen)} places seen, at most {worst:.3f} mm beside the path of motionrack run")
