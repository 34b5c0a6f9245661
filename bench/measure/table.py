"""Table of the benches: the meaning of each, the thing whose time it measures, and its baseline.

A bench has the name that its program prints, without arguments. `baseline`: another bench of the same program that does
the same in another way; a program that compares by itself has the counter "ratio" instead.
`counted`: a pattern of the names whose instructions are counted.
"""
from kinds import Bench, Program, Unit

PULSE, EDGE, STEP = Unit("pulse", "pulses/s"), Unit("edge", "edges/s"), Unit("step of the speed", "steps/s")
SAMPLE, PERIOD, TICK = (
    Unit("sample", "samples/s"),
    Unit("period of all cards", "frames/s"),
    Unit("tick of 10 us", "ticks/s"),
)
AXIS_SAMPLE, LINE, JOB_LINE = (
    Unit("sample of an axis", "per_axis"),
    Unit("line", "items_per_second"),
    Unit("line", "lines/s"),
)
ITEM_BLOCK, BLOCK, ONE_PULSE = Unit("block", "items_per_second"), Unit("block", "each"), Unit("pulse", "each")
EVENT, FRAME, CARD_FRAME = Unit("event", "each"), Unit("frame", "items_per_second"), Unit("frame of a card", "each")
PLAN, CALL, RUN, MIB64 = Unit("plan"), Unit("call"), Unit("run"), Unit("64 MiB")

#: `counted` of benches that depend on real time or take minutes under valgrind.
NEVER = ""

_NETWORK = (
    "frames of a number of scales, at a period in us (0: unthrottled), from the publisher to the listener's queue"
)

PROGRAMS = [
    Program(
        "chip",
        "The virtual MCX314",
        "Four axes unless it says otherwise. *Machines*: with a motor and an encoder on each axis, which are "
        "notified of every step of the speed. The *twin* is a simple tick-by-tick implementation of the same chip; a "
        "tuned ticking model would be faster.",
        [
            Bench("cruise/look_each_second", "4 Mpps for a second between two polls of the host", PULSE, "cruise_twin"),
            Bench("cruise/look_each_second_machines", "the same with machines", PULSE, "cruise_twin"),
            Bench("cruise/look_each_ms", "4 Mpps, a poll each ms: cruising costs the polls only", PULSE, "cruise_twin"),
            Bench("cruise/look_each_ms_machines", "the same with machines", PULSE, "cruise_twin"),
            Bench("cruise_twin", "the twin at the same speed", PULSE),
            Bench(
                "moves/servo",
                "a whole move: to 4 Mpps in 0.16 s, one second there, and down",
                PULSE,
                "moves_twin/servo",
            ),
            Bench("moves/servo_machines", "the same with machines", PULSE, "moves_twin/servo"),
            Bench("moves_twin/servo", "the twin's", PULSE),
            Bench("moves/servo_s", "the same with S-curves", PULSE, "moves_twin/servo_s"),
            Bench("moves_twin/servo_s", "the twin's", PULSE),
            Bench(
                "moves/stepper",
                "a whole move: to 40 kpps in 0.30 s, one second there, and down",
                PULSE,
                "moves_twin/stepper",
            ),
            Bench("moves/stepper_machines", "the same with machines", PULSE, "moves_twin/stepper"),
            Bench("moves_twin/stepper", "the twin's", PULSE),
            Bench("moves/stepper_s", "the same with S-curves", PULSE, "moves_twin/stepper_s"),
            Bench("moves_twin/stepper_s", "the twin's", PULSE),
            Bench("speed_steps/t_curve", "a ramp of one axis without a listener", STEP),
            Bench("speed_steps/t_curve_machines", "the same with machines: each step is an event", STEP),
            Bench("speed_steps/s_curve", "an S-curve without a listener", STEP),
            Bench("speed_steps/s_curve_machines", "the same with machines", STEP),
            Bench(
                "edges_in_batches/20_kpps",
                "pulses that turn encoders whose edges are all generated, and decoded in batches",
                EDGE,
                "edges_one_by_one/20_kpps",
            ),
            Bench("edges_in_batches/100_kpps", "the same, faster", EDGE, "edges_one_by_one/100_kpps"),
            Bench("edges_in_batches/4_Mpps", "the same at full speed", EDGE, "edges_one_by_one/4_Mpps"),
            Bench("edges_in_batches/3_997_Mpps", "the same with unevenly spaced pulses", EDGE),
            Bench("edges_one_by_one/20_kpps", "the same, decoded one by one through a table of 16 transitions", EDGE),
            Bench("edges_one_by_one/100_kpps", "the same, faster", EDGE),
            Bench("edges_one_by_one/4_Mpps", "the same at full speed", EDGE),
            Bench("decode_only<sim::BatchDecoder>", "the decoder alone, in batches", EDGE, "decode_only<OneByOne>"),
            Bench("decode_only<OneByOne>", "the decoder alone, one by one", EDGE),
            Bench("path_edges/line", "interpolated lines of two axes, every edge generated and decoded", EDGE),
            Bench("path_edges/arc", "full circles", EDGE),
            Bench("path_edges/arc_at_constant_vector_speed", "full circles at constant vector speed", EDGE),
            Bench("snapshot", "the state of a chip with machines, taken", CALL),
            Bench("restore", "and put back", CALL),
        ],
    ),
    Program(
        "axis",
        "One axis beside verilator",
        "One drive from standstill to standstill. *Heard*: the instant of every pulse is computed and delivered; else "
        "pulses are counted. *Clocked*: `tests/verilog/mcx314_axis.v` compiled by verilator. Before the measurement, "
        "the pulses of both are compared, to the tick.",
        [
            Bench(
                "drive/servo",
                "4.5 million pulses: to 4 Mpps in 0.16 s, a second there, and down",
                PULSE,
                "drive_clocked/servo",
            ),
            Bench("drive/servo_heard", "the same, heard", PULSE, "drive_clocked/servo"),
            Bench("drive_clocked/servo", "the same, clocked: 2.3 clocks a pulse", PULSE),
            Bench("drive/servo_s", "with S-curves", PULSE, "drive_clocked/servo_s"),
            Bench("drive/servo_s_heard", "the same, heard", PULSE, "drive_clocked/servo_s"),
            Bench("drive_clocked/servo_s", "the same, clocked", PULSE),
            Bench(
                "drive/stepper",
                "52,000 pulses: to 40 kpps in 0.30 s, a second there, and down",
                PULSE,
                "drive_clocked/stepper",
            ),
            Bench("drive/stepper_heard", "the same, heard", PULSE, "drive_clocked/stepper"),
            Bench("drive_clocked/stepper", "the same, clocked: 244 clocks a pulse", PULSE),
        ],
    ),
    Program(
        "grating",
        "Frames of the grating bus",
        "Eight moving scales, a host and ten slaves, 200 us a period; *clocked*: `hdl/grating_bus` "
        "compiled by verilator, 20,000 clocks a period.",
        [
            Bench("frames_clocked", "the same frames, clocked", PERIOD),
            Bench("frames_of_cards/alone", "no observer: a frame is one step", PERIOD, "frames_clocked"),
            Bench(
                "frames_of_cards/every_card_claims",
                "the processor of every card claims every frame and reads its sequence",
                PERIOD,
                "frames_clocked",
            ),
            Bench("frames_of_cards/every_wire_watched", "every wire is listened to", PERIOD, "frames_clocked"),
        ],
    ),
    Program(
        "decode",
        "Sampled encoder lines",
        "The ratio is to a table of 16 transitions (four axes: of 65,536), the best of many runs. The last number of a "
        "name is the bytes of the data: in the first cache, in the second, in memory; of planes, the bytes of one "
        "line. Every available kernel is measured; valgrind "
        "does not support AVX-512.",
        [
            Bench("one_axis_bytes", "A and B of one axis in each byte", SAMPLE, counted="16384$"),
            Bench(
                "reading_alone",
                "the bytes read and nothing else: the upper bound for data of this size",
                MIB64,
                counted=NEVER,
            ),
            Bench("one_axis_with_index", "with an index each 40,000 samples", SAMPLE, counted=NEVER),
            Bench("four_axes_in_a_byte", "four axes; a sample of all four is one", SAMPLE, counted="16384$"),
            Bench("bit_planes", "A and B as bits, 64 samples a word", SAMPLE, counted="8192$"),
        ],
    ),
    Program(
        "gcode",
        "Reading G-code",
        "200,000 lines from text. *Naive*: a line from a stream, and words by `strtod`, without meaning or checks.",
        [
            Bench(
                "read_with_meaning/G1_X_Y_F",
                "`G1 X1.234 Y-5.678 F1000`, read, interpreted and checked",
                LINE,
                "tokenise_naively/G1_X_Y_F",
            ),
            Bench("tokenise_naively/G1_X_Y_F", "the same, naively", LINE),
            Bench("read_with_meaning/X_Y", "`X1.234 Y5.678`", LINE, "tokenise_naively/X_Y"),
            Bench("tokenise_naively/X_Y", "the same, naively", LINE),
            Bench(
                "read_with_meaning/arcs", "`G2 X25 Y0 I12.5 J0`, with the arc's geometry", LINE, "tokenise_naively/arcs"
            ),
            Bench("tokenise_naively/arcs", "the same, naively", LINE),
        ],
    ),
    Program(
        "planner",
        "Profiles and look-ahead",
        "16,384 random moves of all cases, so that no branch predictor learns them.",
        [
            Bench(
                "trapezoid_plan", "a trapezoid from standstill to standstill", PLAN, "trapezoid_plan_by_steps_of_1_ms"
            ),
            Bench("trapezoid_plan_between_velocities", "between two speeds", PLAN),
            Bench("trapezoid_plan_by_steps_of_1_ms", "found by stepping through it at 1 kHz", PLAN, counted=NEVER),
            Bench("s_curve_plan", "an S-curve from standstill to standstill", PLAN, "s_curve_plan_by_bisection"),
            Bench("s_curve_plan_by_bisection", "its peak velocity found by bisection", PLAN),
            Bench(
                "sample_s_curve",
                "the positions of four axes at an instant, for each of them",
                AXIS_SAMPLE,
                "sample_s_curve_through_all_phases",
            ),
            Bench("sample_trapezoid", "the same of trapezoids", AXIS_SAMPLE),
            Bench("sample_s_curve_through_all_phases", "one axis, evaluating its phases from the start", CALL),
            Bench(
                "look_ahead_0_1_mm",
                "blocks of 0.1 mm into a window of 1,024",
                ITEM_BLOCK,
                "look_ahead_with_full_passes",
                counted=NEVER,
            ),
            Bench(
                "look_ahead_2_um",
                "blocks of 2 um: the stopping distance is longer than the window",
                ITEM_BLOCK,
                "look_ahead_with_full_passes",
                counted=NEVER,
            ),
            Bench(
                "look_ahead_with_full_passes",
                "both passes over the whole window for each block",
                ITEM_BLOCK,
                counted=NEVER,
            ),
            Bench("geometry_of_a_line", "length and directions of a line", CALL),
            Bench("sine_and_cosine", "both, with the same bits on every CPU", CALL, "sine_and_cosine_of_the_c_library"),
            Bench("sine_and_cosine_of_the_c_library", "both, by the C library", CALL),
        ],
    ),
    Program(
        "profile",
        "Motions between any two states",
        "8,192 random tasks for one axis, with limits of velocity, acceleration and jerk.",
        [
            Bench("s_curve_from_rest_to_rest", "the S-curve, for rest to rest alone", PLAN),
            Bench(
                "travel_from_rest_to_rest",
                "the time-optimal motion, from standstill to standstill",
                PLAN,
                "s_curve_from_rest_to_rest",
            ),
            Bench("travel_between_any_states", "between any two velocities and accelerations", PLAN),
            Bench(
                "travel_between_any_states_near", "to near targets, where nearly each needs an equation solved", PLAN
            ),
            Bench("travel_from_outside", "from up to twice the allowed velocity and acceleration", PLAN),
            Bench("change_of_velocity", "to another velocity, at any position", PLAN),
            Bench("stop_of_any_motion", "to standstill, at any position", PLAN),
            Bench("sample_of_a_travel", "its position at an instant", CALL),
        ],
    ),
    Program(
        "curve",
        "Jerk-limited paths",
        "*Curve*: moves converted into cubic segments. *Offline trajectory*: the velocity along 20,000 blocks, planned "
        "as one. *Trajectory generator*: block by block through a window, which plans all known blocks when it must; "
        "the table below gives its slowest block in a thousand.",
        [
            Bench("curve/chords_of_0_1_mm", "lines of 0.1 mm on a smooth curve", ITEM_BLOCK, counted=NEVER),
            Bench(
                "curve/chords_of_0_1_mm_rounded",
                "the same, rounded to 1 um as CAM systems write them",
                ITEM_BLOCK,
                counted=NEVER,
            ),
            Bench("curve/chords_of_2_um", "lines of 2 um", ITEM_BLOCK, counted=NEVER),
            Bench(
                "curve/chords_in_inverse_time",
                "each with another feed, so that none is merged",
                ITEM_BLOCK,
                counted=NEVER,
            ),
            Bench("curve/long_lines", "lines of 25 mm with corners", ITEM_BLOCK, counted=NEVER),
            Bench("curve/arcs_of_1_mm", "quarters of circles of 1 mm", ITEM_BLOCK, counted=NEVER),
            Bench("curve/arcs_of_20_mm", "and of 20 mm", ITEM_BLOCK, counted=NEVER),
            Bench("trajectory/chords_of_0_1_mm", "lines of 0.1 mm", BLOCK),
            Bench("trajectory/chords_of_0_1_mm_rounded", "the same, rounded to 1 um", BLOCK, counted=NEVER),
            Bench("trajectory/long_lines", "lines of 25 mm with corners", BLOCK, counted=NEVER),
            Bench("trajectory/arcs_of_1_mm", "quarters of circles of 1 mm", BLOCK, counted=NEVER),
            Bench("generator/chords_of_0_1_mm", "lines of 0.1 mm", ITEM_BLOCK, counted=NEVER),
            Bench("generator/chords_of_0_1_mm_rounded", "the same, rounded to 1 um", ITEM_BLOCK, counted=NEVER),
            Bench("generator/long_lines", "lines of 25 mm with corners", ITEM_BLOCK, counted=NEVER),
            Bench("generator/arcs_of_1_mm", "quarters of circles of 1 mm", ITEM_BLOCK, counted=NEVER),
        ],
    ),
    Program(
        "job",
        "Whole jobs",
        "G-code read, planned and run on the router of the examples, with motors, encoders, switches and the monitor "
        "that watches them.",
        [
            Bench("run_example_part", "the example part: 85 lines, 40 s", RUN),
            Bench("run_20000_short_lines", "20,000 lines of 0.3 mm along a spiral", JOB_LINE),
            Bench("snapshot_of_a_rack", "the state of the whole rack, taken", CALL),
            Bench("restore_of_a_rack", "and put back", CALL),
        ],
    ),
    Program(
        "recording",
        "Recordings",
        "`watched_by` 0: no observer, 1: a VCD file with exact ticks, 2: a recording (HDF5) of everything.",
        [
            Bench("write_events", "a million pulses and counts into a recording", EVENT),
            Bench("compare_events", "two such recordings compared", EVENT),
            Bench("run_example_part", "the example part, recorded or not", RUN, counted="0$"),
        ],
    ),
    Program(
        "rtc5",
        "The virtual RTC5",
        "Two lists in a loop. *Fly*: positions corrected by an encoder. *Table*: a field correction. *Unseen*: the "
        "samples are not requested.",
        [
            Bench("run_card/micro_vectors_plain", "a vector each tick", TICK),
            Bench("run_card/micro_vectors_fly", "with fly", TICK),
            Bench("run_card/micro_vectors_table", "with table", TICK),
            Bench("run_card/micro_vectors_fly_table", "with both", TICK, "run_twin/micro_vectors_fly_table"),
            Bench("run_card/short_marks_fly_table", "marks of some ticks, with both", TICK),
            Bench("run_card/long_marks_fly_table", "long marks, with both", TICK, "run_twin/long_marks_fly_table"),
            Bench("run_card/long_marks_rotary_table", "long marks, with a rotary correction and table", TICK),
            Bench("run_card/short_marks_unseen", "marks of some ticks, unseen", TICK),
            Bench("run_card/long_marks_unseen", "long marks, unseen", TICK, "run_twin/long_marks_fly_table"),
            Bench("run_recorded/short_marks_ideal", "with a work piece that stores the marks, ideal mirrors", TICK),
            Bench("run_recorded/short_marks_mirrors", "with mirrors that lag", TICK),
            Bench("run_recorded/short_marks_mirrors_lens", "and a lens", TICK),
            Bench("run_twin/micro_vectors_fly_table", "the tick-by-tick twin, a vector each tick, with both", TICK),
            Bench("run_twin/long_marks_fly_table", "the twin, long marks, with both", TICK),
        ],
    ),
    Program(
        "dds",
        "Frames between two processes",
        "Over Cyclone DDS on the loopback; the table below gives the ages of the frames. A time here is real time "
        "between two frames; at 200 us it shows only that no frame was late for long.",
        [
            Bench("network", _NETWORK, FRAME, counted=NEVER),
            Bench("judging", "a frame validated: its CRC, its place in the order", FRAME),
        ],
    ),
    Program(
        "dds",
        "The same with a real-time priority",
        "Both processes under `chrt -f 50`, where the machine allows it.",
        [
            Bench("network", _NETWORK, FRAME, counted=NEVER),
        ],
        ("chrt", "-f", "50"),
        "dds_chrt",
    ),
    Program(
        "growth",
        "Growth of a rack",
        "Every axis makes the move `stepper`, with machines; cards of a grating bus publish frames each 200 us. A "
        "value that is the same in all rows grows with the work and no faster. More cards cost more a pulse: for each "
        "event the kernel searches all devices for the next one.",
        [
            Bench("axes", "a number of axes of one card", ONE_PULSE),
            Bench("cards", "all four axes of a number of cards in one kernel", ONE_PULSE, counted="/(1|8)$"),
            Bench(
                "frames", "a grating bus with that number of slaves and scales, no observer", CARD_FRAME, counted=NEVER
            ),
        ],
    ),
]
