// The table of reactions, and those of the latch itself; a card may have its own in its plug-in.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <motionrack/cards/mcx314/chip/general_outputs.hpp>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/grating_card.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/rtc5_card.hpp>
#include <motionrack/rack/stop_reactions.hpp>

namespace motionrack::rack {

namespace {

constexpr std::uint32_t to(std::initializer_list<StopSource> sources) {
    std::uint32_t out = 0;
    for (const StopSource source : sources) out |= 1u << static_cast<unsigned>(source);
    return out;
}

using enum StopSource;
using enum StopCategory;

constexpr std::uint32_t but_the_button = to({stop_command, drive_alarm, limit_switch, watchdog, following_error});

/// One slice of the driver; an edge ends a slice immediately.
constexpr Duration a_slice = milliseconds(50);

// ---- reactions of the latch

/// Ends lists, blocks starts, and closes the laser's gate at this tick.
void laser_off(Rack& rack, const StopReaction&) {
    for (const auto& card : rack.cards())
        if (rtc5::Card* laser = rtc5_card_of(rack, card->name()); laser != nullptr) {
            laser->engine().set_control_mode(0);
            laser->engine().stop_execution();
        }
}

void stop_belts(Rack& rack, const StopReaction&) {
    for (RunningConveyor& track : rack.tracks()) track.drive->stop(rack.kernel().now());
}

void stop_stages(Rack& rack, const StopReaction& reaction) {
    for (const RunningStage& stage : rack.stages())
        if (stage.processor != nullptr) stage.processor->stop(reaction.category == category_1);
}

/// Clears the outputs without a control loop.
void clear_analog_outputs(Rack& rack, const StopReaction&) {
    for (const auto& card : rack.cards()) {
        grating_bus::Card* found = grating_card_of(rack, card->name());
        if (found == nullptr) continue;
        for (int output = 0; output < grating_bus::output_count; ++output)
            if (std::none_of(rack.stages().begin(), rack.stages().end(), [&](const RunningStage& stage) {
                    return stage.processor != nullptr && stage.config.card == card->name() &&
                           stage.config.output == output;
                }))
                found->put_out(output, 0);
    }
}

void clear_general_outputs(Rack& rack, const StopReaction&) {
    for (const auto& card : rack.cards())
        if (auto* chip = dynamic_cast<mcx314::Chip*>(card->registers()); chip != nullptr)
            mcx314::Chip::GeneralOutputs::clear(*chip);
}

// clang-format off
constexpr std::array reactions = {
    StopReaction{"mcx314", to({emergency_stop}), category_0, StopBy::card,
                 "the chip ends all pulses at once, at its input emgn", milliseconds(1)},
    StopReaction{"mcx314", to({limit_switch}), category_2, StopBy::card,
                 "the chip decelerates the axis moving towards the switch, and with it the path; the drive ends with "
                 "the current segment; at standstill: motion is blocked", milliseconds(1), true},
    StopReaction{"mcx314", to({stop_command, drive_alarm, watchdog, following_error}), category_2, StopBy::drive,
                 "all axes decelerate along their path and hold their positions", a_slice, true},
    StopReaction{"mcx314 outputs", to({emergency_stop}), category_0, StopBy::latch,
                 "the general outputs OUT0 to OUT7 go low: servo-on and open brakes end", milliseconds(2), false,
                 clear_general_outputs},
    StopReaction{"mcx314 outputs", but_the_button, category_2, StopBy::card,
                 "the general outputs keep their levels, because the ramp and holding a position need servo-on and "
                 "open brakes", Duration{}},
    StopReaction{"databoard4002", to({emergency_stop}), category_0, StopBy::card,
                 "the relay disconnects the amplifier's voltage, at its input ems; the amplifier brakes the axis",
                 milliseconds(1), true},
    StopReaction{"databoard4002", to({limit_switch, watchdog}), category_0, StopBy::card,
                 "the card ends the move by itself, without a ramp: 0 V", milliseconds(1), true},
    StopReaction{"databoard4002", to({stop_command, drive_alarm, following_error}), category_2, StopBy::drive,
                 "the axis decelerates with its own acceleration and holds its position", a_slice, true},
    StopReaction{"rtc5", every_stop, category_0, StopBy::latch,
                 "the laser goes off, lists end, and starts are no longer accepted; the mirrors stay where they are",
                 milliseconds(2), false, laser_off},
    StopReaction{"belt", every_stop, category_1, StopBy::latch,
                 "belts and tables stop with their own deceleration, then power off", milliseconds(2), true,
                 stop_belts},
    StopReaction{"stage", to({emergency_stop}), category_1, StopBy::latch,
                 "stages decelerate along their profile; 50 ms later their loops open, 0 V", milliseconds(2), true,
                 stop_stages},
    StopReaction{"stage", but_the_button, category_2, StopBy::latch,
                 "stages decelerate along their profile and hold their positions", milliseconds(2), true, stop_stages},
    StopReaction{"grating_bus", every_stop, category_0, StopBy::latch,
                 "analog outputs without a loop go to 0 V; frames continue", milliseconds(2), false,
                 clear_analog_outputs},
};
// clang-format on

constexpr StopReaction spindle_off{"spindle", every_stop, category_0, StopBy::drive, "spindle and coolant go off",
                                   a_slice};

/// In the order in which the latch executes them.
template <class Visitor>
void each_reaction(const Visitor& visit) {
    for (const StopReaction& reaction : reactions) visit(reaction);
    for (const CardPlugin* plugin : card_plugins())
        for (const StopReaction& reaction : plugin->stop_reactions) visit(reaction);
    visit(spindle_off);
}

constexpr std::array states = {
    StopState{"disabled", "disabled"},
    StopState{"standstill", "standstill"},
    StopState{"waiting_for_a_line", "waits for a sender's next line"},
    StopState{"moving", "moves in a program"},
    StopState{"dwell", "dwells (G4)"},
    StopState{"hold", "stands in a feed hold"},
    StopState{"m0", "waits at M0"},
    StopState{"single_block", "single block: a line is done"},
    StopState{"probing", "probes (G38)"},
    StopState{"homing", "homes"},
    StopState{"jog", "jogs while a key is held"},
    StopState{"jog_along_a_line", "jogs along a sender's line"},
    StopState{"service", "a card is in service: its functions are called by hand"},
};

}  // namespace

std::vector<StopReaction> stop_reactions() {
    std::vector<StopReaction> out;
    each_reaction([&](const StopReaction& reaction) { out.push_back(reaction); });
    return out;
}

void react(Rack& rack, StopSource source) {
    each_reaction([&](const StopReaction& reaction) {
        if (reaction.act != nullptr && reaction.is_to(source)) reaction.act(rack, reaction);
    });
}

std::span<const StopState> stop_states() {
    return states;
}

// ---- restarting

Result<void> start_part(Rack& rack, std::string_view name) {
    if (const StopLatch& latch = rack.stop_latch(); latch.latched())
        return fail(ErrorKind::refused, fmt::format("{} Nothing was started. {}", latch.sentence(), latch.advice()));
    if (RunningConveyor* track = rack.track(name); track != nullptr) {
        track->drive->go_on(rack.kernel().now());
        return {};
    }
    const RunningStage* stage = rack.stage(name);
    if (stage == nullptr || stage->processor == nullptr)
        return fail(
            ErrorKind::invalid_input,
            fmt::format("No belt, table or stage with a control loop has the name {}. Nothing was started.", name));
    std::array<std::int64_t, grating_bus::output_count> counts{};
    for (const RunningStage& one : rack.stages())
        if (one.processor == stage->processor)
            counts[static_cast<std::size_t>(one.config.output)] = one.scale->count(rack.kernel().now());
    stage->processor->go_on(counts);
    return {};
}

}  // namespace motionrack::rack
