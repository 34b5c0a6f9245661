// Checks between keys: axes against cards and channels, positions with each other, velocities against chip and motor.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <motionrack/rack/config_parts.hpp>

namespace motionrack::rack {

bool AxisSource::sound(std::initializer_list<std::string_view> keys) const {
    return std::none_of(keys.begin(), keys.end(), [&](std::string_view key) {
        return std::find(refused.begin(), refused.end(), key) != refused.end();
    });
}

TextPosition AxisSource::location(std::string_view key, std::string_view sub) const {
    if (table == nullptr) return {};
    const TomlNode* in = sub.empty() ? table : table->find(sub);
    return in != nullptr ? in->location_of(key) : table->key_location;
}

int channel_index(const RackConfig& config, const RackAxis& axis) {
    const RackCard* card = config.card(axis.card);
    const CardType* type = card != nullptr ? find_card_type(card->type) : nullptr;
    return type == nullptr ? -1 : type->channel_of(axis.channel);
}

namespace {

/// Checks of one axis. Each uses only keys that were read without an error, so that one mistake gives one error.
class AxisCheck {
  public:
    AxisCheck(const RackConfig& config, const RackAxis& axis, const AxisSource& source, Problems& problems)
        : config_(config), axis_(axis), source_(source), problems_(problems) {}

    void run() {
        card_and_channel();
        travel();
        switches();
        homing();
        motor();
        following();
        if (const RackCard* card = config_.card(axis_.card)) {
            if (const CardType* type = find_card_type(card->type); type != nullptr && type->channel_count() > 0)
                chip(*card, *type);
        }
    }

  private:
    void card_and_channel() {
        if (!source_.sound({"card"})) return;
        const RackCard* card = config_.card(axis_.card);
        if (card == nullptr) {
            std::vector<std::string_view> names;
            for (const RackCard& other : config_.cards) names.push_back(other.name);
            const std::string hint = did_you_mean(axis_.card, names);
            error("card", {},
                  fmt::format("Axis {} names the card {}, which the rack does not have{}", axis_.letter,
                              in_quotes(axis_.card), hint.empty() ? "." : hint));
            return;
        }
        const CardType* type = find_card_type(card->type);
        if (type == nullptr || !source_.sound({"channel"})) return;
        if (type->channel_count() == 0) {
            error("card", {},
                  fmt::format("Axis {} names the card {}, but cards of type {} do not drive axes.", axis_.letter,
                              in_quotes(axis_.card), type->name));
            return;
        }
        if (channel_index(config_, axis_) < 0) {
            const std::string said = axis_.channel.empty() ? "no channel" : "the channel " + in_quotes(axis_.channel);
            error("channel", {},
                  type->channels.empty()
                      ? fmt::format(
                            "Axis {} names {}; a card of type {} has only one, without a name: leave the key out.",
                            axis_.letter, said, type->name)
                      : fmt::format("Axis {} names {}; a card of type {} has the channels {}.", axis_.letter, said,
                                    type->name, fmt::join(type->channels, " ")));
            return;
        }
        for (const RackAxis& other : config_.axes) {
            if (&other == &axis_) return;  // each pair is reported once, at the later letter
            if (other.card == axis_.card && other.channel == axis_.channel) {
                error(axis_.channel.empty() ? "card" : "channel", {},
                      fmt::format("Axes {} and {} are both on {}card {}; each channel drives one axis.", other.letter,
                                  axis_.letter,
                                  axis_.channel.empty() ? std::string() : fmt::format("channel {} of ", axis_.channel),
                                  axis_.card));
            }
        }
    }

    void travel() {
        const std::string_view u = axis_.unit();
        if (!source_.sound({"min_limit_{u}", "max_limit_{u}"})) return;
        if (axis_.min_limit >= axis_.max_limit) {
            error("min_limit_{u}", {},
                  fmt::format("min_limit_{0} of axis {1} is {2}, not below max_limit_{0}, which is {3}.", u,
                              axis_.letter, number_text(axis_.min_limit), number_text(axis_.max_limit)));
            return;
        }
        if (source_.sound({"initial_position_{u}"}) &&
            !inside(axis_.initial_position, axis_.min_limit, axis_.max_limit)) {
            error("initial_position_{u}", {},
                  fmt::format("initial_position_{0} of axis {1} is {2}, outside its travel {3} .. {4} {0}.", u,
                              axis_.letter, number_text(axis_.initial_position), number_text(axis_.min_limit),
                              number_text(axis_.max_limit)));
        }
    }

    void switches() {
        const std::string_view u = axis_.unit();
        const RackSwitches& s = axis_.switches;
        if (!source_.sound({"min_limit_{u}", "max_limit_{u}", "limit_minus_{u}", "limit_plus_{u}", "home_{u}"})) return;
        if (axis_.min_limit >= axis_.max_limit) return;  // already reported
        const double low = s.limit_minus.value_or(axis_.min_limit);
        const double high = s.limit_plus.value_or(axis_.max_limit);
        if (low >= high) {
            error(s.limit_minus ? "limit_minus_{u}" : "limit_plus_{u}", "switches",
                  fmt::format("The limit switches of axis {} leave no travel: the lower end is at {} {}, the "
                              "upper at {} {}.",
                              axis_.letter, number_text(low), u, number_text(high), u));
            return;
        }
        if (s.home && !inside(*s.home, low, high)) {
            error("home_{u}", "switches",
                  fmt::format("home_{0} of axis {1} is {2}, outside of its travel, {3} to {4} {0}.", u, axis_.letter,
                              number_text(*s.home), number_text(low), number_text(high)));
        }
        cam();
        if (s.limit_minus && low >= axis_.min_limit)
            limit_in_travel("limit_minus_{u}", low, "min_limit", axis_.min_limit);
        if (s.limit_plus && high <= axis_.max_limit)
            limit_in_travel("limit_plus_{u}", high, "max_limit", axis_.max_limit);
    }

    void cam() {
        const RackSwitches& s = axis_.switches;
        if (!source_.sound({"cam_from_{u}", "cam_to_{u}"})) return;
        if (s.cam_from.has_value() != s.cam_to.has_value()) {
            const char* there = s.cam_from ? "cam_from" : "cam_to";
            error(fmt::format("{}_{}", there, axis_.unit()), "switches",
                  fmt::format("The cam of axis {} has only {}_{}; a cam needs both ends.", axis_.letter, there,
                              axis_.unit()));
        } else if (s.cam_from && *s.cam_from >= *s.cam_to) {
            error("cam_from_{u}", "switches",
                  fmt::format("The cam of axis {} goes from {} to {} {}; its first end must be below the other.",
                              axis_.letter, number_text(*s.cam_from), number_text(*s.cam_to), axis_.unit()));
        }
    }

    void limit_in_travel(std::string_view key, double at, const char* end, double travel_end) {
        warn(key, "switches",
             fmt::format(
                 "{} of axis {} acts at {} {}, within the travel ({}_{} is {}): moves to that end will stop at the "
                 "switch.",
                 with_unit(key, axis_.unit()), axis_.letter, number_text(at), axis_.unit(), end, axis_.unit(),
                 number_text(travel_end)));
    }

    /// Moves do not depend on homing, so settings that `motionrack home` will refuse are warnings here.
    void homing() {
        const RackHoming& h = axis_.homing;
        const auto above = [&](std::string_view key, const std::optional<double>& value, double max,
                               std::string_view limit) {
            if (!value || *value <= max || !source_.sound({key})) return;
            warn(key, "homing",
                 fmt::format("{} of axis {} is {}, above its {}, which is {}: the axis cannot be homed.",
                             with_unit(key, axis_.unit()), axis_.letter, number_text(*value),
                             with_unit(limit, axis_.unit()), number_text(max)));
        };
        above("search_velocity_{u}_s", h.search_velocity, axis_.max_velocity, "max_velocity_{u}_s");
        above("latch_velocity_{u}_s", h.latch_velocity, axis_.max_velocity_step, "max_velocity_step_{u}_s");
        if (h.method >= 3 && axis_.encoder_counts_per_rev == 0 && source_.sound({"method", "encoder_counts_per_rev"}))
            warn("method", "homing",
                 fmt::format("Axis {} is to be homed to its encoder's index (method {}), but it has no encoder.",
                             axis_.letter, h.method));
        if (h.method >= 3 && !h.home_offset && !h.index_after && source_.sound({"method"}))
            warn("method", "homing",
                 fmt::format("Axis {0} needs home_offset_{1} or index_after_{1} to home to its index.", axis_.letter,
                             axis_.unit()));
        const RackCard* card = config_.card(axis_.card);
        if (const CardType* type = card != nullptr ? find_card_type(card->type) : nullptr;
            h.index_after && type != nullptr && type->position_loop)
            warn("index_after_{u}", "homing",
                 fmt::format("index_after_{} of axis {} is ignored: its card uses the index only under the cam.",
                             axis_.unit(), axis_.letter));
    }

    void motor() {
        const std::string_view u = axis_.unit();
        if (source_.sound({"max_velocity_step_{u}_s", "max_velocity_{u}_s"}) &&
            axis_.max_velocity_step > axis_.max_velocity)
            error("max_velocity_step_{u}_s", {},
                  fmt::format("max_velocity_step_{0}_s of axis {1} is {2}, above its max_velocity_{0}_s, which is {3}.",
                              u, axis_.letter, number_text(axis_.max_velocity_step), number_text(axis_.max_velocity)));
        if (source_.sound({"max_jerk_{u}_s3"}) && axis_.max_jerk > 0 && axis_.max_jerk < 0.001) {
            error("max_jerk_{u}_s3", {},
                  fmt::format("max_jerk_{0}_s3 of axis {1} is {2}; it must be 0 (trapezoids) or at least 0.001 {0}/s3.",
                              u, axis_.letter, number_text(axis_.max_jerk)));
        }
        if (axis_.servo) return servo();
        if (!source_.sound({"start_stop_hz", "pull_out_hz"})) return;
        const RackMotor& m = axis_.motor;
        if (m.start_stop_hz > m.pull_out_hz) {
            error("start_stop_hz", "motor",
                  fmt::format(
                      "The motor of axis {} starts with {} pulses/s but already loses steps above {} (pull_out_hz); "
                      "start_stop_hz must not be above it.",
                      axis_.letter, number_text(m.start_stop_hz), number_text(m.pull_out_hz)));
        } else if (pulses_known()) {
            too_fast_for_motor("max_velocity_{u}_s", axis_.max_velocity, "pull_out_hz", m.pull_out_hz);
            too_fast_for_motor("max_velocity_step_{u}_s", axis_.max_velocity_step, "start_stop_hz", m.start_stop_hz);
        }
    }

    /// Checks the following-error limits against the normal operation of an axis with an encoder.
    void following() {
        constexpr std::string_view warning = "following_error_warning_{u}", alarm = "following_error_alarm_{u}";
        const std::string_view u = axis_.unit();
        const double count = axis_.counts_per_unit() > 0 ? 1 / axis_.counts_per_unit() : 0;
        for (const auto& [key, value] :
             {std::pair{warning, axis_.following_error_warning}, std::pair{alarm, axis_.following_error_alarm}}) {
            if (!value || *value == 0 || !source_.sound({key})) continue;
            if (count == 0 && source_.sound({"encoder_counts_per_rev"}))
                error(key, {},
                      fmt::format("{} of axis {} is {}, but the axis has no encoder to compare with; leave it out.",
                                  with_unit(key, u), axis_.letter, number_text(*value)));
            else if (*value < 2 * count)
                error(key, {},
                      fmt::format("{} of axis {} is {}, less than two counts of its encoder, {} {}: a healthy axis "
                                  "would exceed it.",
                                  with_unit(key, u), axis_.letter, number_text(*value), short_text(2 * count), u));
        }
        if (source_.sound({warning, alarm}) && axis_.following_alarm() > 0 &&
            axis_.following_warning() > axis_.following_alarm())
            error(warning, {},
                  fmt::format("{} of axis {} is {}, above its {}, which is {}: it would stop without warning.",
                              with_unit(warning, u), axis_.letter, number_text(axis_.following_warning()),
                              with_unit(alarm, u), number_text(axis_.following_alarm())));
    }

    void servo() {
        const RackServo& servo = *axis_.servo;
        const std::string_view u = axis_.unit();
        for (const std::string_view key : {"motor", "motor_steps_per_rev", "microsteps"})
            if (source_.table != nullptr && source_.table->find(key) != nullptr)
                error(key, {},
                      fmt::format("Axis {} has a servo, so {} has no effect; leave it out.", axis_.letter, key));
        if (axis_.encoder_counts_per_rev == 0 && source_.sound({"encoder_counts_per_rev"}))
            error("encoder_counts_per_rev", {},
                  fmt::format("Axis {} has a servo but no encoder; encoder_counts_per_rev must be above 0.",
                              axis_.letter));
        if (!source_.sound({"velocity_per_volt_{u}_s", "saturation_velocity_{u}_s", "current_limit_accel_{u}_s2",
                            "coulomb_friction_{u}_s2", "max_velocity_{u}_s"}))
            return;
        const double friction = servo.coulomb_friction, accel = servo.current_limit_accel;
        if (friction >= accel)
            error("coulomb_friction_{u}_s2", "servo",
                  fmt::format("coulomb_friction_{0}_s2 of axis {1} is {2}, not below current_limit_accel_{0}_s2, which "
                              "is {3}: its motor could never start.",
                              u, axis_.letter, number_text(friction), number_text(accel)));
        if (const double counts = servo.saturation() * axis_.pulses_per_unit(); counts > 1e6)
            error("velocity_per_volt_{u}_s", "servo",
                  fmt::format("The servo of axis {} reaches {} {}/s, that is {} counts/s; it may be 1000000. Lower "
                              "saturation_velocity_{}_s or encoder_counts_per_rev.",
                              axis_.letter, short_text(servo.saturation()), u, short_text(counts), u));
        const double threshold = friction * servo.time_constant_ms * 1e-3 + servo.dead_band_v * servo.velocity_per_volt;
        if (axis_.max_velocity_step <= threshold)
            warn("max_velocity_step_{u}_s", {},
                 fmt::format("max_velocity_step_{0}_s of axis {1} is {2}, but friction and dead band use {3} {0}/s: "
                             "it would stop short of its target.",
                             u, axis_.letter, number_text(axis_.max_velocity_step), short_text(threshold)));
        if (const double max_accel = accel / (1 + servo.load_inertia_ratio); axis_.max_accel > max_accel)
            warn("max_accel_{u}_s2", {},
                 fmt::format("max_accel_{0}_s2 of axis {1} is {2}, above the {3} {0}/s2 that its servo reaches with "
                             "its load: it would overshoot its target.",
                             u, axis_.letter, number_text(axis_.max_accel), short_text(max_accel)));
        const double reach = std::min(servo.saturation(), (10 - servo.dead_band_v) * servo.velocity_per_volt);
        if (axis_.max_velocity > reach * rounding)
            warn("max_velocity_{u}_s", {},
                 fmt::format("max_velocity_{0}_s of axis {1} is {2}, above the {3} {0}/s of its servo at 10 V.", u,
                             axis_.letter, number_text(axis_.max_velocity), short_text(reach)));
    }

    void too_fast_for_motor(std::string_view key, double velocity, const char* limit_key, double limit) {
        const double rate = velocity * axis_.pulses_per_unit();
        if (!source_.sound({key}) || rate <= limit * rounding) return;
        warn(key, {},
             fmt::format("{} of axis {} is {}, that is {} pulses/s at {} pulses/{}, above the motor's {} {}: it will "
                         "lose steps.",
                         with_unit(key, axis_.unit()), axis_.letter, number_text(velocity), short_text(rate),
                         short_text(axis_.pulses_per_unit()), axis_.unit(), limit_key, number_text(limit)));
    }

    void chip(const RackCard& card, const CardType& type) {
        if (!pulses_known()) return;
        const double max_pulse_hz = type.max_pulse_hz(card);
        too_fast_for_chip("max_velocity_{u}_s", axis_.max_velocity, "pulses/s", max_pulse_hz, card);
        too_fast_for_chip("max_accel_{u}_s2", axis_.max_accel, "pulses/s2", type.max_accel_hz_s(card), card);
        const std::string_view u = axis_.unit();
        if (source_.sound({"max_velocity_{u}_s"}) && axis_.max_pulse_hz() < 1) {
            error("max_velocity_{u}_s", {},
                  fmt::format("max_velocity_{}_s of axis {} is {}, that is {} pulses/s; the minimum of card {} is 1.",
                              u, axis_.letter, number_text(axis_.max_velocity), short_text(axis_.max_pulse_hz()),
                              card.name));
        }
        counter_range(type);
        if (!source_.sound({"encoder_counts_per_rev", "max_velocity_{u}_s"})) return;
        if (type.position_loop && axis_.encoder_counts_per_rev == 0)
            error("encoder_counts_per_rev", {},
                  fmt::format(
                      "Axis {} has no encoder, but card {} positions by it; encoder_counts_per_rev must be above 0.",
                      axis_.letter, card.name));
        encoder(card, type.max_encoder_hz(card));
    }

    void too_fast_for_chip(std::string_view key, double value, const char* pulse_unit, double limit,
                           const RackCard& card) {
        const double rate = value * axis_.pulses_per_unit();
        if (!source_.sound({key}) || rate <= limit * rounding) return;
        error(key, {},
              fmt::format("{} of axis {} is {}, that is {} {} at {} pulses/{}; card {} allows {}. Lower it to {} or "
                          "give fewer microsteps.",
                          with_unit(key, axis_.unit()), axis_.letter, number_text(value), short_text(rate), pulse_unit,
                          short_text(axis_.pulses_per_unit()), axis_.unit(), card.name, short_text(limit),
                          short_text(limit / axis_.pulses_per_unit())));
    }

    /// Checks that positions fit the card's counters.
    void counter_range(const CardType& type) {
        if (!source_.sound({"min_limit_{u}", "max_limit_{u}"})) return;
        const auto max_counts = static_cast<double>(type.max_position);
        const double per_unit = std::max(axis_.pulses_per_unit(), axis_.counts_per_unit());
        for (const auto& [key, position] :
             {std::pair{"min_limit_{u}", axis_.min_limit}, std::pair{"max_limit_{u}", axis_.max_limit}}) {
            if (std::fabs(position) * per_unit <= max_counts) continue;
            error(key, {},
                  fmt::format("{} of axis {} is {}, that is {} pulses or counts; the position counters hold {:.0f} at "
                              "most, {} {} here.",
                              with_unit(key, axis_.unit()), axis_.letter, number_text(position),
                              short_text(std::fabs(position) * per_unit), max_counts, short_text(max_counts / per_unit),
                              axis_.unit()));
        }
    }

    void encoder(const RackCard& card, double limit) {
        if (axis_.encoder_counts_per_rev % 4 != 0) {
            error("encoder_counts_per_rev", {},
                  fmt::format("encoder_counts_per_rev of axis {} is {}, but counts are four for each line: write a "
                              "multiple of 4.",
                              axis_.letter, axis_.encoder_counts_per_rev));
            return;
        }
        const double rate = axis_.max_velocity * axis_.counts_per_unit();
        if (rate <= limit * rounding) return;
        error("encoder_counts_per_rev", {},
              fmt::format(
                  "The encoder of axis {} gives {} counts/s at {} {}/s; the inputs of card {} follow {} counts/s.",
                  axis_.letter, short_text(rate), number_text(axis_.max_velocity), axis_.unit(), card.name,
                  short_text(limit)));
    }

    bool pulses_known() const {
        return source_.sound({"motor_steps_per_rev", "microsteps", "lead_mm", "gear_ratio"}) &&
               axis_.pulses_per_rev() > 0;
    }
    static bool inside(double value, double low, double high) { return value >= low && value <= high; }
    /// Formats a computed number with six digits.
    static std::string short_text(double value) {
        const std::string text = fmt::format("{:.6g}", value);
        double rounded = value;
        std::from_chars(text.data(), text.data() + text.size(), rounded);
        return number_text(rounded);
    }

    void error(std::string_view key, std::string_view sub, std::string what) {
        problems_.error(source_.location(with_unit(key, axis_.unit()), sub), std::move(what));
    }
    void warn(std::string_view key, std::string_view sub, std::string what) {
        problems_.warn(source_.location(with_unit(key, axis_.unit()), sub), std::move(what));
    }

    /// A limit that is met exactly in decimal may be exceeded by rounding in binary.
    static constexpr double rounding = 1 + 1e-12;

    const RackConfig& config_;
    const RackAxis& axis_;
    const AxisSource& source_;
    Problems& problems_;
};

}  // namespace

void check_axes(const RackConfig& config, const std::vector<AxisSource>& sources, Problems& problems) {
    for (std::size_t i = 0; i < config.axes.size(); ++i) AxisCheck(config, config.axes[i], sources[i], problems).run();
}

}  // namespace motionrack::rack
