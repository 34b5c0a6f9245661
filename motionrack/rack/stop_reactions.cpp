// The reactions of parts to a stop, and their execution; cards have theirs in their plug-ins.
#include <fmt/format.h>

#include <array>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/stop_reactions.hpp>

namespace motionrack::rack {

namespace {

using enum StopCategory;

// ---- reactions of the latch

void stop_belts(Rack& rack, const StopReaction&) {
    for (RunningConveyor& track : rack.tracks()) track.drive->stop(rack.kernel().now());
}

void stop_stages(Rack& rack, const StopReaction& reaction) {
    for (const RunningStage& stage : rack.stages())
        if (stage.processor != nullptr) stage.processor->stop(reaction.category == category_1);
}

// clang-format off
constexpr std::array reactions = {
    StopReaction{"belt", every_stop, category_1, StopBy::latch,
                 "belts and tables stop with their own deceleration, then power off", milliseconds(2), true,
                 stop_belts, StopOrder::conveyors},
    StopReaction{"stage", only_emergency_stop, category_1, StopBy::latch,
                 "stages decelerate along their profile; 50 ms later their loops open, 0 V", milliseconds(2), true,
                 stop_stages, StopOrder::stages},
    StopReaction{"stage", but_emergency_stop, category_2, StopBy::latch,
                 "stages decelerate along their profile and hold their positions", milliseconds(2), true, stop_stages,
                 StopOrder::stages},
    StopReaction{"spindle", every_stop, category_0, StopBy::drive, "spindle and coolant go off", stop_slice, false,
                 nullptr, StopOrder::spindle},
};
// clang-format on

/// Visits the reactions in the order in which the latch executes them.
template <class Visitor>
void each_reaction(const Visitor& visit) {
    for (int place = 0; place <= static_cast<int>(StopOrder::spindle); ++place) {
        const auto order = static_cast<StopOrder>(place);
        const auto visit_those = [&](std::span<const StopReaction> rows) {
            for (const StopReaction& reaction : rows)
                if (reaction.order == order) visit(reaction);
        };
        for (const CardPlugin* plugin : card_plugins()) visit_those(plugin->stop_reactions);
        visit_those(reactions);
    }
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
    go_on(*stage, rack.stages(), rack.kernel().now());
    return {};
}

}  // namespace motionrack::rack
