// Invariants of every run of a machine, for all commands and faults, checked from outside: pulses on the wires, true
// motor positions, and the published status.
//
//   machine, rack ──every slice──► Sight ──► Invariants ──► Finding: the rule, the instant, the numbers
//  accepted commands ────────ordered─────────┘
//
// A Sight contains plain numbers, so that each rule is tested with a history that violates it (invariants_test.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <motionrack/base/time.hpp>
#include <motionrack/operate/status.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::test {

enum class Rule : std::uint8_t {
    motion_needs_order,        ///< pulses only in moving states, of enabled axes, after a command
    stop_slows,                ///< after a stop no axis accelerates, all stop in time, lasers are off
    stop_stays,                ///< no motion before a reset, nor caused by the reset
    stop_is_taken,             ///< in every state
    reset_is_needed,           ///< an error stop ends only with a reset
    position_is_true,          ///< a valid position is the true position
    counters_are_pulses,       ///< counters change only with pulses
    limits_kept,               ///< velocity and acceleration limits of each axis
    travel_kept,               ///< an axis with a valid position stays within its travel
    one_alarm_a_cause,         ///< until it is reset
    time_is_monotone,          ///< including the numbers of status snapshots and alarms
    nothing_taken_is_missing,  ///< each answered command is in the journal, in order
    same_history,              ///< for the same seed
    no_allocation,             ///< within the kernel's run
    usable_again               ///< after all faults are cleared and reset
};
std::string_view name_of(Rule rule);

/// One axis at one instant.
struct AxisSight {
    bool enabled = true, position_valid = false;
    std::int64_t sent = 0;                    ///< pulses on the wires since the start; of a servo the motor rotation
    std::int64_t counter = 0;                 ///< pulse counter of the card
    bool driven = false;                      ///< the card generates pulses, at any rate; of a servo: false
    double commanded = 0, true_position = 0;  ///< by the counter; of the table
};

struct Sight {
    Instant at{};
    std::int64_t sequence = 0;
    operate::MachineState state = operate::MachineState::standstill;
    bool latched = false;
    Instant stopped_at{};    ///< of the stop in force
    bool abrupt = false;     ///< ends pulses without a ramp
    bool by_writes = false;  ///< register writes drive an axis at standstill of the machine
    int lasers_on = 0;
    double belt_velocity = 0;  ///< sum over all belts and tables
    std::vector<AxisSight> axes;
    const std::vector<operate::Alarm>* alarms = nullptr;
};

/// An axis as described in the rack file.
struct AxisFacts {
    char letter = 'X';
    bool servo = false;
    double pulses_per_unit = 1, max_velocity = 1, max_accel = 1, velocity_step = 1;
    double min_position = -std::numeric_limits<double>::infinity(), max_position = -min_position;
    double following_alarm = 0;
};

/// Factors by which a run may exceed limits of its axes; 1: not at all. tests/known_breaches.txt has the known
/// breaches.
struct LimitFactors {
    double max_accel = 1, max_velocity_step = 1;
};

struct Finding {
    Rule rule{};
    Instant at{};
    std::string text;
};

class Invariants {
  public:
    using Report = std::function<void(const Finding&)>;
    struct Settings {
        double jerk_time_s = 0;              ///< time for a jerk-limited profile to start decelerating
        Duration obeyed = milliseconds(12);  ///< maximum delay from a stop to the start of deceleration
        LimitFactors known = {};             ///< known breaches of the run
    };
    /// Reports each rule once.
    Invariants(std::vector<AxisFacts> axes, const Settings& settings, Report report);

    /// Records an accepted command. After the first call, all later commands must be recorded.
    enum class Order : std::uint8_t { motion, position, stop, reset, enable, part };
    void ordered(Order order);
    /// A motor or value was pushed, held or overwritten from outside, so that pulses and true positions may differ.
    void disturbed();
    /// A switch was forced, broken or repaired. During a search, the resulting edge cannot be distinguished from a true
    /// one, so the result of this search is not checked.
    void switch_disturbed() { search_disturbed_ = true; }
    /// A card hangs: its host waits for an answer, at most 2 s, and does nothing else.
    void hung() { hangs_ = pictures_of_a_hang; }
    void see(const Sight& sight);
    /// Reports a rule that is checked elsewhere.
    void found(Rule rule, Instant at, std::string text);
    const std::vector<Finding>& findings() const { return findings_; }
    /// Returns the peak acceleration so far relative to its limit, after subtracting velocity step and counting error.
    double peak_accel_factor() const { return peak_accel_factor_; }

  private:
    struct Own {
        double offset = 0;    ///< true position minus commanded when the position became valid
        Instant off_since{};  ///< start of the position error
        bool off = false;
        double velocity = 0;    ///< in the previous interval
        std::int64_t base = 0;  ///< pulses at the start of the interval
        std::string jumped;     ///< velocity change of a stop, or of a motion that may have failed
        Instant jumped_at{};
    };
    bool moved(std::size_t i, const Sight& now) const { return now.axes[i].sent != last_.axes[i].sent; }
    void see_time(const Sight& now);
    void see_motion(const Sight& now);
    void see_counters(const Sight& now);
    void see_positions(const Sight& now);
    void see_travel(const Sight& now);
    void see_stop(const Sight& now);
    void see_parts(const Sight& now);
    void see_alarms(const Sight& now);
    void end_interval(const Sight& now);
    void see_jumps(const Sight& now);
    void see_limits(std::size_t i, double velocity, double seconds, const Sight& now);
    void see_braking(double seconds, const Sight& now);
    double rounding(std::size_t i, double seconds) const { return 1 / (facts_[i].pulses_per_unit * seconds); }

    std::vector<AxisFacts> facts_;
    Settings settings_;
    Report report_;
    std::vector<Finding> findings_;
    std::set<Rule> reported_;
    bool first_ = true;
    bool search_disturbed_ = false;             ///< in the search that runs, or since the last snapshot
    bool searches_ = false, searched_ = false;  ///< homing, or stopping during homing; in the previous snapshot
    Sight last_;
    std::vector<Own> own_;
    // commands
    bool knows_orders_ = false, parts_stand_ = false;
    bool reset_ = false;                         ///< since the stop
    bool reset_now_ = false, stop_now_ = false;  ///< since the last snapshot; whichever came last
    static constexpr int pictures_of_a_hang = 1'500;
    int hangs_ = 0;
    int may_move_ = 0, may_declare_ = 0, stop_due_ = 0;  ///< number of snapshots
    // interval of the velocity measurement
    Instant base_at_{};
    double last_seconds_ = 0, peak_accel_factor_ = 0;
    bool serviced_ = false;                     ///< a card was in service in this interval
    bool jumped_ = true;                        ///< pulses ended without a ramp, or the run starts: no reference
    bool braked_ = false, was_braked_ = false;  ///< a stop was active in this interval, in the previous one
    // a stop
    Instant latched_at_{}, stands_by_{};
    double min_velocity_ = 0;
    bool stood_ = false;
    bool linear_moves_ = false;
    int unheeded_ = 0;  ///< snapshots of an idle machine during a stop
    // alarms
    std::int64_t last_alarm_ = 0;
    std::set<std::string> alarm_texts_;
};

}  // namespace motionrack::test
