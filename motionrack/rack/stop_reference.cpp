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
     "once it is released; after a discrepancy of two channels for 500 ms (`estop_discrepancy_ms`), which raises an "
     "alarm of its own, once both are equal"},
    {StopSource::stop_command,
     "STOP on the page, `POST /api/stop`, `machine.stop()`, `--at stop@TIME`; in a run also opening "
     "the door",
     "at any time"},
    {StopSource::drive_alarm, "the alarm input of an axis of an MCX314", "once the drive no longer reports it"},
    {StopSource::limit_switch,
     "a limit switch becomes active ahead of a moving axis, or at standstill; also behind a moving axis, even during "
     "homing: this means wrong wiring or a broken switch; ahead of an axis that homes it only reverses that axis; "
     "bounce within 20 ms after leaving the switch is ignored",
     "at any time: the axis must be moved off it"},
    {StopSource::watchdog,
     "a DataBoard 4002 that was reset because its program hung; detected at the next slice (2 ms, of a run 50 ms)",
     "at any time"},
    {StopSource::following_error,
     "the encoder counts of an axis differ from the pulses of its card by more than its "
     "`following_error_alarm_mm` (`_deg`); checked every millisecond",
     "at any time; the error restarts at 0, the position is not valid"},
}};

constexpr std::string_view begin = R"(# What a stop does

<!-- written by `motionrack describe safety` -->

A rack has one stop latch. Every cause of a stop sets it, in every state of the machine, and only a reset
releases it:

    emergency stop, drive alarm, limit switch, watchdog,       STOP command
    following error                                                | between two slices
         | edge of a wire, at its tick                             |
         +----------------------> LATCH <--------------------------+
                                    |---> axes stop, no motion starts, dwells and holds end
                                    |---> laser off, belts and stages decelerate, outputs 0: the table of reactions
                                    `---> error stop, with a sentence; the program is discarded

    LATCH -- reset, once the cause is gone --> standstill -- a new command --> motion

- **No motion before a reset.** Programs, lines, jogs, homing, marking and resume are refused, with the cause of
  the stop.
- **A reset releases the causes that were present when it was commanded.** A later stop, while the machine still
  decelerates, stays until the next reset.
- **A reset moves nothing.** Programs and lines in progress are discarded; belts and stages stay at standstill until
  the command `start_part`.
- **A new start requires both**: the reset and a new command.
- **No remembered word switches an output on.** A digital output of a card that a stop cleared stays low until the
  host writes its bit low, then high (or resets the card): a word that a program has kept from before the stop raises
  nothing. The card reports the first output that stays low for this reason. A control word of an IO8255 releases
  no output. A strobed byte is data, not a level: a stop discards the byte that waits, and the next one goes out whole.
- `motionrack run` and `motionrack home` end with exit code 4 and the sentence of the latch; by the STOP command and
  Ctrl-C with 130.

Opening a door (`door = true` in `[safety]`, the wire `door`) holds the feed of a served machine, stops probing moves,
jogs, homing and motion by register writes, switches spindle and coolant off, and raises an alarm; lasers, belts, stages
and outputs react as to a STOP command. Nothing starts while it is open, coolant neither. Closing it does not start
motion: a resume does, and switches spindle and coolant on again as last commanded. A run has no operator, and ends.

A card in service is driven only by its library's functions, which the user calls by hand. Every source stops all of
its axes without a ramp, within 5 ms, and ends the service with the latch set. The end of the service, lost control, a
disconnected client, disabling, an open door and the end of the program stop its axes in the same way and end the
service without the latch. The controller then initialises the card again, and the positions of its axes are not valid.

For a real card in service (`motionrack serve --live`) the stop is written through its port (MCX314: the quick stop of
all axes, DataBoard 4002: the command Q), and its axes are polled until standstill. If the computer refuses the write,
or an axis continues to move, an alarm reports it and stays: then only the hard-wired emergency stop of the card is
left. The card's own switches and alarms stop only its own axes.

This is a simulation and its software. It is not a safety function: a real machine needs a hard-wired emergency stop
without software.

)";

constexpr std::string_view validity = R"(
## When positions are valid
A position stays valid if no step can have been lost, and becomes invalid if one may have been lost:

- A stop with a ramp loses no steps: the STOP command, limit switches, an alarm of another axis.
- At a limit switch an MCX314 that follows a path decelerates within its current segment, and ends its pulses at the
  end of that segment. An axis whose velocity then changed by more than its velocity step has no valid position.
- After a stop without a ramp (the emergency stop) the position of an axis is valid if its velocity was at most its
  velocity step, from which it can stop immediately, or if it was in a dwell, in a hold or at standstill.
- An axis with a following error above its limit has no valid position: its motor does not follow, or its encoder has
  failed.
- An axis whose drive reports an alarm during a move has no valid position: its motor may not have followed.
- An axis that a DataBoard 4002 positions by its encoder is still counted, unless its watchdog has reset the card, or
  the axis does not follow.

The sentence of the stop names the cause. A served machine raises one alarm per cause, within 20 ms: the alarm of a
following error replaces its warning.

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
    out += "## Sources\n| source | cause that sets the latch | a reset is accepted |\n|---|---|---|\n";
    for (const SourceText& text : source_texts)
        out += fmt::format("| {} | {} | {} |\n", name_of(text.source), text.sets, text.resets);
    out +=
        "\n## Reactions\nStop categories of IEC 60204-1: 0, the power is removed immediately; 1, a controlled stop, "
        "then the power is removed; 2, a controlled stop with the power kept. The rows are those of the code: of cards "
        "in their plug-ins, of other parts in `motionrack/rack/stop_reactions.cpp`. The latch executes its own rows; "
        "the others state what cards and the executor do.\n\n| part | source | category | reaction | by | within |\n"
        "|---|---|---|---|---|---|\n";
    for (const StopReaction& reaction : stop_reactions())
        out += fmt::format("| {} | {} | {} | {} | {} | {:g} ms{} |\n", reaction.part, sources_of(reaction),
                           category_of(reaction.category), reaction.happens, doer_of(reaction.by),
                           to_seconds(reaction.within) * 1e3, reaction.ramp ? ", then its ramp" : "");
    out += validity;
    out +=
        "## States and sources\nEach cell is the end of a test name, "
        "`EveryState/StopInAState.HoldsUntilAReset/..` (`motionrack/operate/test/stop_states_test.cpp`): a stop in "
        "that state, by that source, with laser, belt, stage, outputs, spindle and coolant on. The test checks in "
        "virtual time: 10 ms after the stop laser, outputs, spindle and coolant are off, and the belt decelerates. "
        "Resume, lines, programs, jogs and homing are refused until the reset, and the reset moves and switches on "
        "nothing.\n\n| state |";
    for (const StopSource source : stop_sources) out += fmt::format(" {} |", name_of(source));
    out += "\n|---|---|---|---|---|---|---|\n";
    static constexpr std::array<std::string_view, stop_sources.size()> test_names = {
        "emergency_stop", "stop_command", "drive_alarm", "limit_switch", "watchdog", "following_error"};
    for (const StopState& state : stop_states()) {
        out += fmt::format("| {} |", state.text);
        for (const StopSource source : stop_sources)
            out += fmt::format(" `{}_by_{}` |", state.name, test_names[static_cast<std::size_t>(source)]);
        out += '\n';
    }
    out +=
        "\nPrograms without an operator (`motionrack run`) are tested by `LatchedStop.*` "
        "(`motionrack/rack/test/stop_latch_test.cpp`), the page's commands by `StopOnThePage.*` "
        "(`motionrack/panel/test/stop_test.cpp`).\n";
    return out;
}

}  // namespace motionrack::rack
