"""Test with bCNC on a virtual screen: it streams a program over TCP or the pseudo-terminal,
and the path is that of `motionrack run`.

python3 bcnc.py MOTIONRACK tcp|pty
"""
import os
import shutil
import subprocess
import sys
import signal

from served import END, Onlooker, Served, compare, fail, sender_comes, skip

SETTINGS = "[Connection]\nopenserial=1\nport={port}\nbaud=115200\ncontroller=GRBL1\npendant=0\n"


def main(motionrack, way):
    for program, package in (("bCNC", "bcnc"), ("xvfb-run", "xvfb"), ("xauth", "xauth")):
        if shutil.which(program) is None:
            skip(f"{program} is not here (Debian package {package})")
    with Served(motionrack) as served:
        with open(os.path.join(served.folder, ".bCNC"), "w") as file:
            file.write(SETTINGS.format(port=f"socket://127.0.0.1:{served.port}" if way == "tcp" else served.link))
        # Debian's own Python, which has the modules of bCNC.
        environment = dict(os.environ, HOME=served.folder, PATH="/usr/bin:/bin")
        for attempt in range(3):
            if stream(served, way, environment):
                return
            print("bCNC did not begin its program; once more")
        fail("bCNC did not begin its program")


def stream(served, way, environment):
    """Streams the program and compares the paths. Returns False if bCNC does not connect or does not start it:
    bCNC looks only once for the controller, which can be too early on a busy computer."""
    log = open(os.path.join(served.folder, "bcnc.log"), "w+")
    sender = subprocess.Popen(
        ["xvfb-run", "-a", "bCNC", "--run", served.part],
        env=environment,
        stdout=log,
        stderr=log,
        start_new_session=True,
    )
    try:
        if way == "tcp" and not sender_comes(served.port):
            print("bCNC did not connect within 60 s")
            return False
        onlooker = Onlooker(served.port, must_be_second=way == "tcp")
        if not onlooker.look(40, lambda o: "Run" in o.states()):
            return False
        # After the job bCNC holds, resets and requests the offsets. With the terminal the test sees only the machine.
        done = (
            (lambda o: o.stands_at(END) and any(line.startswith("[G54:") for line in o.lines))
            if way == "tcp"
            else (lambda o: o.stands_at(END))
        )
        if not onlooker.look(90, done):
            log.seek(0)
            print(log.read()[-2000:])
            fail(
                f"the program did not come to its end: states {onlooker.states()}, last {onlooker.seen[-1:]}, lines "
                f"{onlooker.lines[-5:]}"
            )
        if any(line.startswith(("error", "ALARM")) for line in onlooker.lines):
            fail(f"answers: {onlooker.lines}")
        compare(onlooker.places(), served.driven_by_run())
        return True
    finally:
        os.killpg(sender.pid, signal.SIGTERM)
        sender.wait(20)


main(*sys.argv[1:])
