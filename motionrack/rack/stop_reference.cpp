// The page on stop reactions, written from the tables of the latch.
#include <fmt/format.h>

#include <motionrack/rack/stop_reactions.hpp>

namespace motionrack::rack {

namespace {

struct SourceText {
    StopSource source;
    std::string_view sets, resets;
};
constexpr std::array<SourceText, stop_sources.size()> source_texts = {{
    {StopSource::emergency_stop,
     "the rack's button (the wire `estop`), or a card's own input for it, however short; with two channels "
     "(`estop_channels = 2`: `estop1`, `estop2`) the first that opens",
     "once it is released; after a discrepancy of two channels for 500 ms (`estop_discrepancy_ms`), which is an alarm "
     "of "
     "its "
     "own, once both are equal"},
    {StopSource::stop_command,
     "STOP on the page, `POST /api/stop`, `machine.stop()`, `--at stop@TIME`; in a run the door, "
     "which is opened",
     "at any time"},
    {StopSource::drive_alarm, "the alarm input of an axis of an MCX314", "once the drive reports it no more"},
    {StopSource::limit_switch,
     "a limit switch becomes active ahead of a moving axis, or at standstill; also behind a moving axis, even in a "
     "search for home: this means wrong wiring or a broken switch; bounce within 20 ms after leaving the switch is "
     "ignored",
     "at any time: the axis must be moved off it"},
    {StopSource::watchdog,
     "a DataBoard 4002 that was reset because its program hung; detected at the next slice (2 ms, of a run 50 ms)",
     "at any time"},
    {StopSource::following_error,
     "the encoder of an axis that counts less, or more, than its card has sent by more than its "
     "`following_error_alarm_mm` (`_deg`); checked each millisecond",
     "at any time; the error restarts at 0, the position is not valid"},
}};

constexpr std::string_view begin = R"(# What a stop does

<!-- written by `motionrack describe safety` -->

A rack has one stop latch. Whatever must stop the machine sets it, in every state of the machine, and only a reset
releases it:

    emergency stop, drive alarm, limit switch, watchdog,       STOP command
    following error                                                | between two slices
         | edge of a wire, at its tick                             |
         +----------------------> LATCH <--------------------------+
                                    |---> axes stop, nothing begins to move, dwells and holds end
                                    |---> laser off, belts stand, stages brake, outputs 0: the table of reactions
                                    `---> error stop, with a sentence; the program is discarded

    LATCH -- reset, once the cause is gone --> standstill -- a new command --> motion

- **No motion before a reset.** Programs, lines, jogs, homing, marking and resume are refused, with what stopped the
  machine.
- **A reset releases the causes that were present when it was ordered.** A later
  stop, while the machine still decelerates, stays until the next reset.
- **A reset moves nothing.** Programs and lines that were under way are forgotten; belts and stages stay
  where they are until the command `start_part`.
- **A new start takes both**: the reset and a new command.
- `motionrack run` and `motionrack home` end with exit code 4 and the sentence of the latch; by the STOP command and
  Ctrl-C with 130.

A door (`door = true` in `[safety]`, the wire `door`) that is opened holds the feed of a served machine, puts spindle
and coolant off, stops jogs and searches for home, and raises an alarm; nothing begins to move while it is open.
Closing it moves nothing: a resume does, and brings spindle and coolant back. A run has no operator, and ends.

A card in service is driven only by its library's functions, which the user calls by hand. Every source stops all
of its axes at once, without a ramp, within 5 ms, and ends the service with the stop in force; so do, without one, the
end of the service, lost control, a client that has gone, disabling, an open door and the end of the program. The
controller then sets the card up again, and the positions of its axes are not valid.

Of a real card in service (`motionrack serve --live`) the quick stop of all axes is written through its port, and its
axes are looked at until they stand. Where the computer refuses the write, or an axis drives on, an alarm says so and
stays: then only the emergency stop of the card's own wires is left. Its own switches and alarms stop its axes alone.

This is a simulation and its software. It is not a safety function: a real machine needs an emergency stop that is
wired without any software.

)";

constexpr std::string_view validity = R"(
## When positions are valid
A position stays valid where no step can have been lost, and becomes invalid where one may have been:

- a ramp loses nothing: the STOP command, limit switches, an alarm of another axis;
- at a limit switch the chip of an MCX314 that follows a path brakes within the piece that it drives, and ends its
  pulses where that ends: an axis whose velocity then changed at once by more than its velocity step has no valid
  position;
- without a ramp (the emergency stop) an axis keeps its position that was not faster than its velocity step,
  which it reaches and leaves at once; so do all axes in a dwell, a hold or at standstill;
- an axis with a following error above its limit has no valid position: its motor does not follow, or its encoder is
  dead;
- an axis whose drive reports an alarm while it moves has no valid position: its motor may not have followed;
- an axis that a DataBoard 4002 positions by its encoder is still counted, unless its watchdog has reset the card, or it
  does not follow.

The sentence of the stop says which of these it was. A served machine raises one alarm for a cause, within 20 ms: the
warning of a following error is replaced by the alarm that follows it.

)";

std::string_view category_of(StopCategory category) {
    switch (category) {
        case StopCategory::category_0:
            return "0";
        case StopCategory::category_1:
            return "1";
        case StopCategory::category_2:
            return "2";
    }
    return "";
}

std::string_view doer_of(StopBy by) {
    switch (by) {
        case StopBy::card:
            return "the card";
        case StopBy::drive:
            return "the executor";
        case StopBy::latch:
            return "the latch";
    }
    return "";
}

std::string sources_of(const StopReaction& reaction) {
    std::string out;
    std::size_t count = 0;
    for (const StopSource source : stop_sources)
        if (reaction.is_to(source)) {
            out += fmt::format("{}{}", out.empty() ? "" : ", ", name_of(source));
            ++count;
        }
    return count == stop_sources.size() ? "all" : out;
}

}  // namespace

std::string safety_reference() {
    std::string out(begin);
    out += "## Sources\n| source | what sets the latch | a reset is taken |\n|---|---|---|\n";
    for (const SourceText& text : source_texts)
        out += fmt::format("| {} | {} | {} |\n", name_of(text.source), text.sets, text.resets);
    out +=
        "\n## Reactions\nCategories after IEC 60204-1: 0, the power goes at once; 1, it stops with power, which goes "
        "then; 2, the power stays. The code runs by this table (`motionrack/rack/stop_reactions.cpp`).\n\n| part | "
        "source | category | what happens | by | within |\n|---|---|---|---|---|---|\n";
    for (const StopReaction& reaction : stop_reactions())
        out += fmt::format("| {} | {} | {} | {} | {} | {:g} ms{} |\n", reaction.part, sources_of(reaction),
                           category_of(reaction.category), reaction.happens, doer_of(reaction.by),
                           to_seconds(reaction.within) * 1e3, reaction.ramp ? ", then its ramp" : "");
    out += validity;
    out +=
        "## States and sources\nEach cell is the end of a test's name, "
        "`EveryState/StopInAState.HoldsUntilAReset/..` (`motionrack/operate/test/stop_states_test.cpp`): in that "
        "state, by that source, with a laser, a belt, a stage and outputs that are on. It expects all of the above, in "
        "virtual time.\n\n| state |";
    for (const StopSource source : stop_sources) out += fmt::format(" {} |", name_of(source));
    out += "\n|---|---|---|---|---|---|---|\n";
    static constexpr std::array<std::string_view, stop_sources.size()> test_names = {
        "emergency_stop", "stop_command", "drive_alarm", "limit_switch", "watchdog", "following_error"};
    for (const StopState& state : stop_states()) {
        out += fmt::format("| {} |", state.text);
        for (const StopSource source : stop_sources) {
            const bool own = state.name == "homing" && source == StopSource::limit_switch;
            out += own ? " the search goes to them on purpose |"
                       : fmt::format(" `{}_by_{}` |", state.name, test_names[static_cast<std::size_t>(source)]);
        }
        out += '\n';
    }
    out +=
        "\nPrograms without an operator (`motionrack run`) are tested by `LatchedStop.*` "
        "(`motionrack/rack/test/stop_latch_test.cpp`), the page's commands by `StopOnThePage.*` "
        "(`motionrack/panel/test/stop_test.cpp`).\n";
    return out;
}

}  // namespace motionrack::rack
