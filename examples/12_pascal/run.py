"""Four axes of an IOFLEX02, calibrated in the four ways; the encoders are turned by hand."""

import motionrack

with motionrack.Rack.from_text('[card.p1]\ntype = "ioflex02"\npreloaded = false\n') as rack:
    flex = rack.cards["p1"].driver

    def set_wire(wire: str, level: int) -> None:
        rack.wires[wire] = level
        rack.advance(us=2)

    def turn(lines: int) -> None:
        for _ in range(lines):
            for axis in range(4):
                for track, level in (("a", 1), ("b", 1), ("a", 0), ("b", 0)):
                    set_wire(f"p1.{track}{axis}", level)

    def index() -> None:
        for axis in range(4):
            set_wire(f"p1.z{axis}", 1)
            set_wire(f"p1.z{axis}", 0)

    def tell(what: str) -> None:
        _, *positions = flex.ReadTimeClrPosition()
        states = ["sCal" if calibrated else "sNotCal" for calibrated in flex.ReadSts()]
        print(f"{what:>36}" + "".join(f"{position:7d}" for position in positions) + "   " + " ".join(states))

    if flex.Init(0x2300) != 0:
        raise SystemExit(flex.why)
    print(f"project version {flex.GetIdent()}, unit {flex.cVer}")
    turn(25)
    tell("25 lines")
    flex.WriteCmd(flex.cNop, flex.cRes, flex.cResNm, flex.cResNmSig)
    tell("commands")
    turn(5)
    index()
    tell("5 lines on, index")
    set_wire("p1.cal3", 1)
    turn(5)
    index()
    tell("Cal4, 5 lines on, index")
