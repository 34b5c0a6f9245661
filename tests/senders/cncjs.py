"""Test with cncjs on the pseudo-terminal, with the actions of its users;
the path of the program is that of `motionrack run`.

python3 cncjs.py MOTIONRACK FOLDER        FOLDER: where npm installs cncjs, once
"""
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time

from served import Onlooker, Served, compare, fail, near_first, skip

VERSION = "1.11.5"


def install(folder):
    for program in ("node", "npm"):
        if shutil.which(program) is None:
            skip(f"{program} is not here")
    modules = os.path.join(folder, "node_modules")
    if os.path.exists(os.path.join(folder, ".complete")):
        return modules
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "package.json"), "w") as file:
        file.write('{"private": true}\n')
    try:
        done = subprocess.run(
            ["npm", "install", "--no-audit", "--no-fund", "--loglevel=error", "--omit=dev", f"cncjs@{VERSION}"],
            cwd=folder,
            timeout=270,
            capture_output=True,
            text=True,
        )
    except subprocess.TimeoutExpired:
        skip(f"npm did not install cncjs {VERSION} within 270 s")
    if done.returncode != 0:
        skip(f"npm could not install cncjs {VERSION}: {done.stderr[-300:]}")
    open(os.path.join(folder, ".complete"), "w").close()
    return modules


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def wait_for_port(port, seconds):
    until = time.time() + seconds
    while time.time() < until:
        try:
            socket.create_connection(("127.0.0.1", port)).close()
            return
        except OSError:
            time.sleep(0.1)
    fail(f"cncjs did not serve within {seconds} s")


def program_of(onlooker):
    """Returns the positions between homing and the jog, from the program's first corner on:
    the program starts where homing has left the axes."""
    states = [state for state, _ in onlooker.seen]
    places = onlooker.places(states.index("Run"))[: states.index("Jog") - states.index("Run")]
    first = next(i for i, place in enumerate(places) if near_first(place))
    return places[first:]


def main(motionrack, folder):
    modules = install(folder)
    with Served(motionrack, homes=True) as served:
        port = free_port()
        config = os.path.join(served.folder, "cncrc")
        with open(config, "w") as file:
            json.dump(
                {
                    "ports": [{"path": served.link, "manufacturer": ""}],
                    "watchDirectory": "",
                    "state": {"checkForUpdates": False},
                },
                file,
            )
        log = open(os.path.join(served.folder, "cncjs.log"), "w+")
        server = subprocess.Popen(
            ["node", os.path.join(modules, "cncjs/bin/cncjs"), "-c", config, "-p", str(port), "-H", "127.0.0.1"],
            stdout=log,
            stderr=log,
            env=dict(os.environ, HOME=served.folder),
            start_new_session=True,
        )
        try:
            wait_for_port(port, 60)
            onlooker = Onlooker(served.port, must_be_second=False)
            ended = threading.Event()
            looking = threading.Thread(target=lambda: onlooker.look(240, lambda _: ended.is_set()))
            looking.start()
            client = subprocess.run(
                [
                    "node",
                    os.path.join(os.path.dirname(__file__), "cncjs_client.cjs"),
                    modules,
                    str(port),
                    served.link,
                    served.part,
                ],
                timeout=240,
            )
            ended.set()
            looking.join()
            if client.returncode != 0:
                log.seek(0)
                print(log.read()[-2000:])
                fail(f"cncjs; the machine's states were {onlooker.states()}")
            compare(program_of(onlooker), served.driven_by_run(from_first_corner=True))
        finally:
            os.killpg(server.pid, signal.SIGTERM)
            server.wait(20)


main(*sys.argv[1:])
