"""An old host program on the DataBoard 4002, from Python: the maker's demonstration in BASIC, line by line.

BASIC:  OUT 3,ASCII("G")     here:  out(C2, "G")      the number behind a function is its line in the listing
        INP(1) AND 128              inp(STAT) & 128
"""

import motionrack

DATA, CS, C1, C2, C3, C4, STAT = 0, 1, 2, 3, 4, 5, 1  # 4140

# 3420 .. 3640: speed, and position in units of 256 counts; deceleration, then acceleration; several pairs a line
# fmt: off
SLOPES = (
    ((14000, 1), (14500, 6), (15002, 8), (15216, 15), (15678, 30), (16016, 35), (16144, 40), (16262, 45),
     (16278, 50), (16288, 60), (16298, 70), (16304, 85), (16312, 100), (16317, 115), (16322, 130), (16326, 145),
     (16330, 160), (16332, 180), (16334, 200), (16336, 225), (16338, 250), (16340, 285), (16342, 320), (16344, 370)),
    ((14000, 1), (14500, 12), (15402, 16), (15682, 22), (15778, 30), (15900, 35), (16000, 40), (16262, 50),
     (16284, 60), (16292, 70), (16298, 80), (16304, 105), (16312, 130), (16316, 150), (16322, 180), (16326, 215),
     (16330, 250), (16332, 290), (16334, 330), (16336, 365), (16338, 400), (16340, 450), (16342, 500), (16344, 600)))
# fmt: on

rack = motionrack.Rack.from_text('card.c1 = "databoard4002"')
card = rack.cards["c1"]
switch_at: float | None = None  # s: instant at which the switch of the right end stop changes
pressed = False


# ---- the machine: two functions for the ports, one for the time ----


def pass_ms(ms: int) -> None:
    """The world goes on for that long."""
    global switch_at, pressed
    for _ in range(ms):
        rack.advance(ms=1)
        if switch_at is not None and rack.time >= switch_at:
            pressed = not pressed
            rack.wires["c1.esr"] = int(pressed)
            switch_at = switch_at + 5 if pressed else None


def out(port: int, value: int | str) -> None:
    """An interpreter needs about a millisecond for each of them."""
    pass_ms(1)
    card.write(port, (ord(value) if isinstance(value, str) else value) & 255, bits=8)


def inp(port: int) -> int:
    pass_ms(1)
    return card.read(port, bits=8)


def position() -> float:
    return rack.get("c1.position_counts")


# ---- the program ----


def wait_ready() -> None:  # FNWaitrdy, 2840
    for _ in range(100):
        if inp(STAT) & 128:
            return
    raise SystemExit("FATAL ERROR !! UNIT NEVER READY !")


def strobe_out(port: int, value: int | str) -> None:  # FNOut, 3760
    wait_ready()
    out(port, value)


def strobe_in(port: int) -> int:  # FNInp, 3920
    wait_ready()
    return inp(port)


def max_speed(rate: int) -> None:  # FNMaxspeed, 2420
    strobe_out(C2, "R")
    strobe_out(DATA, rate)
    strobe_out(DATA, rate // 256)


def store_slope(slope: int) -> None:  # FNStoreslope, 3060
    strobe_out(C2, "S")
    for half in SLOPES:
        for speed, place in half:
            if slope == 2:
                place *= 2  # 3180: twice as gentle
            for value in (speed, speed // 256, 0, place, place // 256):
                strobe_out(DATA, value)
    strobe_out(C2, "O")


def go_position(name: str, place: int) -> None:  # FNGoPosition, 1860
    begun = rack.time
    strobe_out(C2, "P")
    for value in (0, place, place // 256):
        strobe_out(DATA, value)
    strobe_out(C4, 1 + 32)  # enable: in position, end stop
    strobe_in(DATA)  # gets rid of old events
    strobe_out(C2, "G")
    event = 0
    while not event & 1:
        while not inp(STAT) & 2:
            pass
        strobe_out(C4, 1 + 32)
        event = strobe_in(DATA)
        if event & 32:
            status = strobe_in(STAT)
            for bit, stop in ((64, "LEFT MARGIN STOP"), (32, "RIGHT MARGIN STOP"), (16, "EMERGENCY STOP")):
                if status & bit:
                    print(f"         at {position():6.0f} counts: {stop}.")
    print(f"{name}  {position():6.0f} counts  after {rack.time - begun:6.2f} s  IN POSITION.")


def wait_for_key() -> None:  # FNQuit, 2620: the user presses a key after three seconds
    pass_ms(3000)


out(CS, 13)  # FNInitdemo, 4080: card select
strobe_out(C2, "I")
strobe_out(C2, "D")  # lock may let it deviate by 25 counts
for number in (25, 0, 0):
    strobe_out(DATA, number)

# The main loop, 1180: A is 0, B is 500, C is 1000.
max_speed(63 * 256 + 240)
store_slope(1)
go_position("A to C", 1000)  # empty: quickly
strobe_out(C2, "L")  # held there while it is loaded
wait_for_key()
strobe_out(C2, "M")
store_slope(2)
max_speed(63 * 256 + 240)
go_position("C to B", 500)  # loaded: gently
wait_for_key()
max_speed(63 * 256)
go_position("B to A", 0)  # at a limited speed, too
wait_for_key()

print("To C again, at once with 10 kHz; after 10 s the right end stop's switch is held for 5 s:")
switch_at = rack.time + 10
strobe_out(C2, "M")
max_speed(16344)
go_position("A to C", 1000)
rack.close()
