// The transmission behind the motor: a leadscrew or a rotary table, from microsteps of the rotor to mm or degrees.
//
//   rotor r --play--> table y --x travel / pulses--> position        y = r while moving to minus, r - play to plus
//
// The play (backlash) is an operator with one memory, the table's position at the last reversal: y = clamp(memory, r -
// play, r).
#pragma once

#include <cstdint>
#include <motionrack/sim/parts/range.hpp>
#include <optional>

namespace motionrack::parts {

/// An exact ratio of whole numbers.
struct Ratio {
    std::int64_t num = 1;
    std::int64_t den = 1;
};

/// Travel per motor revolution of a screw, to the nearest 1e-9 mm (`lead_mm`: > 0, at most 1e6).
Ratio linear_travel(double lead_mm);
/// Degrees per motor revolution of a rotary axis; `gear_ratio`: motor revolutions per revolution (> 0, at most 1e6, to
/// 1e-9).
Ratio rotary_travel(double gear_ratio);

struct TransmissionSettings {
    Ratio travel_per_rev{5, 1};       ///< mm or degrees per motor revolution
    double initial_position = 0;      ///< mm or degrees at the start
    double backlash = 0;              ///< mm or degrees of play, >= 0; rounded to microsteps
    std::optional<double> end_minus;  ///< mm or degrees: hard ends of travel; absent: unlimited
    std::optional<double> end_plus;
};

struct TransmissionState {
    std::int64_t table = 0;  ///< the table at the last reversal of the rotor, microsteps
};

class Transmission {
  public:
    /// `pulses_per_rev`: microsteps per revolution of the rotor.
    Transmission(const TransmissionSettings& settings, std::int64_t pulses_per_rev, TransmissionState& state);

    /// The table in microsteps for the rotor at `rotor`, if it has not reversed since turn().
    std::int64_t table(std::int64_t rotor) const {
        return play_ == 0 ? rotor : std::max(rotor - play_, std::min(rotor, state_.table));
    }
    /// The rotor, now at `rotor`, reverses, stops or starts.
    void turn(std::int64_t rotor) { state_.table = table(rotor); }
    std::int64_t play() const { return play_; }

    /// mm or degrees for the table at `table` microsteps: two roundings, the same on every machine.
    double position_of(std::int64_t table) const {
        return settings_.initial_position + static_cast<double>(table) * num_ / den_;
    }
    double position(std::int64_t rotor) const { return position_of(table(rotor)); }
    double units_per_pulse() const { return num_ / den_; }

    /// The first position of the table, in microsteps, at or above `position`; and the last at or below it.
    std::int64_t first_at_or_above(double position) const;
    std::int64_t last_at_or_below(double position) const;
    /// The rotor range for a range of the table.
    Range rotor_range(const Range& table) const {
        return {table.below, table.above == sim::unwatched_above ? table.above : table.above + play_};
    }
    /// Travel of the rotor: left when it would exceed an end of travel.
    const Range& travel() const { return travel_; }

    const TransmissionSettings& settings() const { return settings_; }

  private:
    TransmissionSettings settings_;
    TransmissionState& state_;
    double num_ = 1;  // units_per_pulse as two whole numbers
    double den_ = 1;
    std::int64_t play_ = 0;
    Range travel_;
};

}  // namespace motionrack::parts
