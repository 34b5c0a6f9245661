// Finds causes of invalid positions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <motionrack/rack/validity_watch.hpp>
#include <motionrack/sim/parts/conditions.hpp>
#include <utility>

namespace motionrack::rack {

ValidityWatch::ValidityWatch(Rack& rack) : rack_(rack), watched_(rack.axes().size()) {
    for (std::size_t i = 0; i < watched_.size(); ++i) {
        watched_[i].counted = is_counted(i);
        watched_[i].counted_wrongly = counted_wrongly(i);
    }
}

void ValidityWatch::begin(std::size_t axis, const Mark& from) {
    AxisWatch& one = watched_[axis];
    one.from = from;
    one.counted_wrongly = counted_wrongly(axis);
    one.lost = one.reported_counts = false;
    rack_.stop_latch().following().begin(axis);
    std::erase_if(early_, [&](const ValidityFinding& found) { return found.axis == axis; });
    for (const sim::Condition& condition : rack_.kernel().conditions()) look_for_lost(axis, condition, early_);
}

std::vector<ValidityFinding> ValidityWatch::poll(bool is_stationary) {
    std::vector<ValidityFinding> out = std::exchange(early_, {});
    look_at_conditions(out);
    for (FollowingWatch::Warning& warning : rack_.stop_latch().following().take_warnings())
        out.push_back({warning.axis, warning.at, std::move(warning.text), false, true});
    for (std::size_t i = 0; is_stationary && i < watched_.size(); ++i) compare(i, out);
    return out;
}

void ValidityWatch::lose(std::size_t axis, Instant at, std::string text, std::vector<ValidityFinding>& out) {
    if (std::exchange(watched_[axis].lost, true)) return;
    out.push_back({axis, at, std::move(text), true});
}

/// Evaluates the new kernel conditions. Steps that were lost and regained by chance count as lost.
void ValidityWatch::look_at_conditions(std::vector<ValidityFinding>& out) {
    const std::vector<sim::Condition> all = rack_.kernel().conditions();
    const std::uint64_t first = rack_.kernel().dropped_conditions();
    for (std::uint64_t i = std::max(seen_, first); i < first + all.size(); ++i)
        look_at(all[static_cast<std::size_t>(i - first)], out);
    seen_ = first + all.size();
}

void ValidityWatch::look_at(const sim::Condition& condition, std::vector<ValidityFinding>& out) {
    for (const RunningStage& stage : rack_.stages())
        if (stage.processor != nullptr && stage.processor->id() == condition.device &&
            stage.config.output == condition.a)
            out.push_back({ValidityFinding::no_axis, condition.at, rack_.describe(condition)});
    for (std::size_t k = 0; k < watched_.size(); ++k) look_for_lost(k, condition, out);
}

void ValidityWatch::look_for_lost(std::size_t axis, const sim::Condition& condition,
                                  std::vector<ValidityFinding>& out) {
    if (condition.code == static_cast<std::uint16_t>(parts::AxisCondition::lost_steps) &&
        condition.device == rack_.axes()[axis].machine->id() && condition.at > watched_[axis].from.at)
        lose(axis, condition.at, rack_.describe(condition), out);
}

void ValidityWatch::compare(std::size_t axis, std::vector<ValidityFinding>& out) {
    AxisWatch& one = watched_[axis];
    const Instant now = rack_.kernel().now();
    const char letter = rack_.axes()[axis].config.letter;
    if (!knows_itself(axis))
        lose(axis, now,
             fmt::format("the position of axis {} is unknown; check its motor and its encoder, then home it", letter),
             out);
    if (const std::int64_t lost = lost_pulses(axis) - one.from.lost_pulses; lost != 0)
        lose(axis, now,
             fmt::format("the motor of axis {} did not follow {} pulses; home it again", letter, std::abs(lost)), out);
    const auto off = static_cast<std::int32_t>(counted_wrongly(axis) - one.counted_wrongly);  // counters have 32 bits
    if (std::abs(off) <= 1 || std::exchange(one.reported_counts, true)) return;
    out.push_back(
        {axis, now,
         fmt::format(
             "encoder of {}: the card's counter is {} counts off the motion of the motor; a line of "
             "the encoder or the card's input is faulty. Do not use this counter; repair the line, then home again",
             letter, off),
         false});
}

// ---- comparable counts

/// Returns true if the axis' own card counts its encoder beside the pulses. Axes that position by themselves use these
/// counts.
bool ValidityWatch::is_counted(std::size_t axis) const {
    const RackConfig& config = rack_.config();
    const RunningAxis& running = rack_.axes()[axis];
    if (config.positions_alone(running.config)) return false;
    return std::any_of(config.encoder_links.begin(), config.encoder_links.end(), [&](const EncoderLink& link) {
        return link.axis == static_cast<int>(axis) && !link.swapped && link.channel == running.channel &&
               config.cards[static_cast<std::size_t>(link.card)].name == running.config.card;
    });
}

bool ValidityWatch::knows_itself(std::size_t axis) {
    RunningAxis& running = rack_.axes()[axis];
    if (!rack_.config().positions_alone(running.config)) return true;
    const Result<control::Axis*> one = running.card->axis(rack_.config(), running.config.letter);
    return one && (*one)->position_valid();
}

/// Returns the step loss of an axis, in pulses; 0 for a servo.
std::int64_t ValidityWatch::lost_pulses(std::size_t axis) const {
    const RunningAxis& running = rack_.axes()[axis];
    const Instant now = rack_.kernel().now();
    return running.turned_by().count(now) - running.machine->rotor().count(now);
}

std::int64_t ValidityWatch::turned(std::size_t axis) const {
    const RunningAxis& running = rack_.axes()[axis];
    return running.servo ? running.machine->encoder().count(rack_.kernel().now()) : 0;
}

double ValidityWatch::moved_since(std::size_t axis, const Mark& mark) const {
    const RunningAxis& running = rack_.axes()[axis];
    return running.servo ? static_cast<double>(turned(axis) - mark.turned) / running.config.counts_per_unit() : 0;
}

/// Returns the card's encoder count minus the motor's rotation, in counts.
std::int64_t ValidityWatch::counted_wrongly(std::size_t axis) const {
    if (!watched_[axis].counted) return 0;
    const RunningAxis& running = rack_.axes()[axis];
    const double counts_per_pulse = static_cast<double>(running.config.encoder_counts_per_rev) /
                                    static_cast<double>(running.config.pulses_per_rev());
    const double turned = static_cast<double>(running.machine->rotor().count(rack_.kernel().now()));
    return running.card->encoder_counter(running.channel) -
           static_cast<std::int64_t>(std::floor(turned * counts_per_pulse));
}

}  // namespace motionrack::rack
