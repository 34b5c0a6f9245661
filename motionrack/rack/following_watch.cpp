// Compares commanded motion with encoder counts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/rack/card_types.hpp>
#include <motionrack/rack/following_watch.hpp>
#include <motionrack/rack/rack.hpp>
#include <utility>

namespace motionrack::rack {

namespace {

constexpr Duration look_at_following_every = milliseconds(1);
/// Time in which the error of a servo decays to a third.
constexpr double fades_within_s = 0.5;

/// Returns the wire of the card's input that the default rule joins with that signal of an axis.
sim::WireId input_for(const sim::Kernel& kernel, const RackAxis& axis, const CardType& type, std::string_view end) {
    for (const DefaultWire& wire : type.default_wires)
        if (wire.end == end) return kernel.find_wire(fmt::format("{}.{}{}", axis.card, axis.channel, wire.pin));
    return sim::WireId::none;
}

/// Returns the card's output that drives the servo of an axis; none if its input is open.
sim::WireId volts_for(const sim::Kernel& kernel, const RackConfig& config, std::size_t axis) {
    const WireEnd drive{EndOwner::axis, static_cast<int>(axis), "drive"};
    for (const RackWire& wire : config.wires)
        if (wire.to == drive) return kernel.find_wire(config.end_name(wire.from));
    return sim::WireId::none;
}

/// Returns the velocity of a servo after `seconds` (a short time) at `volts`: see parts::DcMotor.
double velocity_after(const parts::DcMotorSettings& servo, double velocity, double volts, double seconds) {
    const double inertia = 1 + servo.load_inertia_ratio, max_change = servo.current_limit_accel / inertia * seconds;
    const double above = std::max(std::fabs(volts) - servo.dead_band_v, 0.0);
    const double wanted = std::copysign(std::min(above * servo.gain, servo.saturation_velocity), volts);
    const double push = std::clamp((wanted - velocity) * std::min(seconds / (servo.time_constant_s * inertia), 1.0),
                                   -max_change, max_change);
    const double friction = servo.coulomb_friction / inertia * seconds;
    if (velocity == 0 && std::fabs(push) <= friction) return 0;
    const double direction = std::copysign(1.0, velocity != 0 ? velocity : push);
    const double after = velocity + push - direction * friction;
    return after * direction > 0 || std::fabs(push) > friction ? after : 0;
}

}  // namespace

FollowingWatch::FollowingWatch(Rack& rack)
    : rack_(rack), kernel_(rack.kernel()), id_(kernel_.add(*this, sim::Phase::observers, "following")) {
    for (std::size_t i = 0; i < rack_.axes().size(); ++i) add(i);
}

/// Adds an axis whose encoder the driving card also counts; crossed tracks are taken as intended.
void FollowingWatch::add(std::size_t axis) {
    const RackConfig& config = rack_.config();
    const RunningAxis& running = rack_.axes()[axis];
    const RackAxis& own = running.config;
    const auto link =
        std::find_if(config.encoder_links.begin(), config.encoder_links.end(), [&](const EncoderLink& one) {
            return one.axis == static_cast<int>(axis) && one.channel == running.channel &&
                   config.cards[static_cast<std::size_t>(one.card)].name == own.card;
        });
    const sim::WireId volts = volts_for(kernel_, config, axis);
    if (link == config.encoder_links.end() || (own.servo && volts == sim::WireId::none)) return;
    const CardType& type = *find_card_type(config.card(own.card)->type);
    const double counts = own.counts_per_unit();
    watched_.push_back({axis,
                        static_cast<double>(own.encoder_counts_per_rev) / static_cast<double>(own.pulses_per_rev()),
                        {input_for(kernel_, own, type, "enc_a"), input_for(kernel_, own, type, "enc_b")},
                        own.following_warning() * counts,
                        own.following_alarm() * counts,
                        running.servo ? &running.servo->settings() : nullptr,
                        volts});
}

void FollowingWatch::begin() {
    for (const Watched& watched : watched_) begin(watched.axis);
    const bool any = std::any_of(watched_.begin(), watched_.end(),
                                 [](const Watched& one) { return one.warning > 0 || one.alarm > 0; });
    state_.on = any;
    kernel_.schedule(id_, any ? later(kernel_.now(), look_at_following_every) : never);
}

void FollowingWatch::begin(std::size_t axis) {
    for (std::size_t i = 0; i < watched_.size(); ++i) {
        if (watched_[i].axis != axis) continue;
        state_.axes[i] = {};
        state_.axes[i].counted = rack_.axes()[axis].machine->encoder().count(kernel_.now());
        state_.axes[i].looked = kernel_.now();
        state_.axes[i].origin = error(i, kernel_.now());
    }
}

void FollowingWatch::end() {
    state_.on = 0;
    kernel_.schedule(id_, never);
}

/// Returns the following error of an axis in counts; a forced encoder input counts nothing.
double FollowingWatch::error(std::size_t i, Instant now) {
    const Watched& watched = watched_[i];
    const RunningAxis& running = rack_.axes()[watched.axis];
    ErrorState& own = state_.axes[i];
    const bool held = std::any_of(watched.lines.begin(), watched.lines.end(),
                                  [&](sim::WireId line) { return line != sim::WireId::none && kernel_.forced(line); });
    const std::int64_t counted = held ? own.counted : running.machine->encoder().count(now);
    if (watched.servo != nullptr) {
        follow_servo(i, counted - own.counted, now);
        own.counted = counted;
        return own.behind;
    }
    own.counted = counted;
    const double sent = static_cast<double>(running.turned_by().count(now)) * watched.counts_per_pulse;
    return sent - static_cast<double>(own.counted) - own.origin;
}

/// Advances the servo model to `now`, after `turned` further counts.
void FollowingWatch::follow_servo(std::size_t i, std::int64_t turned, Instant now) {
    const Watched& watched = watched_[i];
    ErrorState& own = state_.axes[i];
    const double seconds = to_seconds(now - own.looked), volts = kernel_.level(watched.volts) * 1e-6;
    own.looked = now;
    own.velocity = velocity_after(*watched.servo, own.velocity, volts, seconds);
    own.behind += own.velocity * seconds - static_cast<double>(turned);
    own.behind *= std::max(0.0, 1 - seconds / fades_within_s);
}

void FollowingWatch::on_scheduled(Instant now) {
    kernel_.schedule(id_, later(now, look_at_following_every));
    poll(now);
}

void FollowingWatch::poll(Instant now) {
    for (std::size_t i = 0; state_.on != 0 && i < watched_.size(); ++i) {
        const Watched& watched = watched_[i];
        ErrorState& own = state_.axes[i];
        const double off = std::fabs(error(i, now));
        if (watched.warning > 0 && off > watched.warning) {
            if (own.max_error == 0) own.warned_at = now;
            own.max_error = std::max(own.max_error, off);
        }
        if (watched.alarm > 0 && off > watched.alarm && own.excess == 0) {
            own.excess = off;
            rack_.stop_latch().stays_behind(watched.axis, now);
        }
    }
}

// ---- sentences

std::vector<FollowingWatch::Warning> FollowingWatch::take_warnings() {
    std::vector<Warning> out;
    for (std::size_t i = 0; i < watched_.size(); ++i) {
        ErrorState& own = state_.axes[i];
        if (own.max_error == 0 || own.excess != 0 || std::exchange(own.reported, 1) != 0) continue;
        const RackAxis& axis = rack_.axes()[watched_[i].axis].config;
        out.push_back({watched_[i].axis, own.warned_at,
                       fmt::format("the following error of {} was {:.3f} {}, above the warning limit of {:g} {}; check "
                                   "its motor, its load and its encoder",
                                   axis.letter, own.max_error / axis.counts_per_unit(), axis.unit(),
                                   axis.following_warning(), axis.unit())});
    }
    return out;
}

bool FollowingWatch::has_exceeded(std::size_t axis) const {
    for (std::size_t i = 0; i < watched_.size(); ++i)
        if (watched_[i].axis == axis && state_.axes[i].excess != 0) return true;
    return false;
}

std::string FollowingWatch::alarm_text(std::size_t axis) const {
    const RackAxis& config = rack_.axes()[axis].config;
    double excess = 0;
    for (std::size_t i = 0; i < watched_.size(); ++i)
        if (watched_[i].axis == axis) excess = state_.axes[i].excess;
    return fmt::format("The following error of {} was {:.3f} {}, above its limit of {:g} {}", config.letter,
                       excess / config.counts_per_unit(), config.unit(), config.following_alarm(), config.unit());
}

}  // namespace motionrack::rack
