"""Marks every part that passes, from Python, while the line becomes quicker: when is it too quick?"""

import motionrack

K = 5184  # bits/mm

with motionrack.Rack.from_file("line.toml") as rack:
    rtc = rack.cards["scan"].driver
    line, head = rack.parts["line"], rack.parts["head"]

    # A frame of 6 x 3 mm, which goes with the part.
    rtc.set_start_list(1)
    rtc.set_jump_speed(50000)
    rtc.set_mark_speed(500 * K / 1000)  # 500 mm/s
    rtc.set_fly_x(K / 1000)  # K bits/mm, 1000 counts/mm
    rtc.mark_abs(6 * K, 0)
    rtc.mark_abs(6 * K, 3 * K)
    rtc.mark_abs(0, 3 * K)
    rtc.mark_abs(0, 0)
    rtc.fly_return(0, 0)
    rtc.set_end_of_list()
    rtc.set_control_mode(1)  # the start line starts list 1

    for speed in (100, 250, 500, 800):
        parts, marked, energy = line.parts, head.marked_mm, head.energy_j
        line.speed_mm_s = speed
        rack.advance(2)
        frames = (head.marked_mm - marked) / 18
        print(
            f"{speed:3.0f} mm/s: {line.parts - parts:3.0f} parts in 2 s, {frames:5.1f} frames marked, "
            f"{(head.energy_j - energy) / frames:.2f} J each"
        )
        for sentence in rtc.marking_info_text(rtc.get_marking_info()):
            print(f"          {sentence}")
