"""All cards in one rack, from Python: what Home all and Run of the page do, and a look at every card."""

import motionrack

with motionrack.Rack.from_file("demonstration.toml") as rack:
    print(rack.home())
    print()
    for card in rack.cards.values():
        print(f"{card.name:<12} {card.type:<16} {card.title}")
    print()
    program = rack.new_instance()

with program as rack:
    print(rack.run(path="../02_part/part.ngc"))
    axes = rack.cards["glass"].channels  # its array is not loaded yet: it has seen nothing
    print(
        f"  X has counted {rack.parts['X'].position_counts:.0f}, the glass scales {axes['0'].POSITION}; the mask is at "
        f"{rack.parts['mask_x'].position_mm:.3f} mm, {rack.parts['line'].parts:.0f} parts came by"
    )
