"""Drives a card from Python: a move by register writes, a limit switch hit by hand,
and what would have happened without it."""

import motionrack

X = 1
R, A, SV, V, P, LP, FIXED_PLUS = 0x00, 0x02, 0x04, 0x05, 0x06, 0x09, 0x20


def command(card: motionrack.Card, axes: int, code: int, value: int) -> None:
    """A data command of the MCX314: the value in WR7, WR6, then the command with the axis in WR0."""
    card.WR7 = value >> 16
    card.WR6 = value & 0xFFFF
    card.WR0 = axes << 8 | code


def tell(rack: motionrack.Rack, who: str) -> None:
    x = rack.cards["c1"].x
    stopped = ", stopped by the + limit" if x.RR1.LMTP else ""
    print(f"{who}: {x.LP} pulses, {x.EP} counts, the table is at {rack.parts['X'].position_mm:.3f} mm{stopped}")


with motionrack.Rack.from_text('card.c1 = "mcx314"') as rack:
    card = rack.cards["c1"]
    command(card, X, R, 800000)  # speeds in units of 10 pulses a second
    command(card, X, A, 400)  # 500,000 pulses a second, each second
    command(card, X, SV, 100)
    command(card, X, V, 4000)  # 40,000 pulses a second: 40 mm/s
    command(card, X, LP, 0)
    command(card, X, P, 20000)
    command(card, X, FIXED_PLUS, 0)
    rack.advance(ms=300)
    tell(rack, "after 0.3 s")

    with rack.copy() as otherwise:
        rack.wires["c1.xlmtp"] = 0  # the limit switch is pressed
        rack.advance(1)
        otherwise.advance(1)
        tell(rack, "with the switch pressed")
        tell(otherwise, "without")
        del rack.wires["c1.xlmtp"]  # and lets it go
