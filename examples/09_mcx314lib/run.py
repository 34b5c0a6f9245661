"""The MCX314's function library from Python: sets the parameters of X, drives there and back, and shows its counters as
the window of such a program does."""

import motionrack

X, XYZU = 1, 15

with motionrack.Rack.from_file("../racks/single.toml") as rack:
    card = next(card for card in rack.cards.values() if card.type == "mcx314").open()

    def show() -> None:
        print(f"LP {card.ReadLPS(0):6d}  EP {card.ReadEPS(0):6d}  CV {card.ReadCV(0):4d}  CA {card.ReadCA(0):3d}")

    card.SetPulseMode(X, 1)  # pulse and direction
    card.SetRange(XYZU, 800000)  # multiple 10
    card.HLMTSig(1, X)  # limit switches stop decelerating
    card.LPS(X, 0)
    card.EPS(X, 0)
    card.AutoDec()

    print("T-curve: 12000 pulses")
    card.TCurve_F(X, 100, 2000, 200, 12000)
    while card.moving(X):  # looks ten times a second until X stands
        show()
        rack.advance(ms=100)
    show()

    print("S-curve: back again")
    card.SCurve_F(X, 100, 2000, 200, 500, -12000)
    card.wait(X, timeout=10)
    show()

    try:
        card.SetV(X, 9000)
    except motionrack.Refused as error:
        print("error: SetV:", error)
