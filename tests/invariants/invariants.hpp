// The laws of every run of a machine, whatever is ordered and whatever breaks: looked at from outside, by the pulses
// on the wires, the places of the motors and the status that people see.
//
//   machine, rack ──every slice──► Sight ──► Invariants ──► Finding: the rule, the instant, the numbers
//   orders that were taken ──────ordered──────┘
//
// A Sight is plain numbers, so that each rule is tested with a history that breaks it (invariants_test.cpp).
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
    motion_needs_order,        ///< pulses only in states that move, of axes that are enabled, after an order
    stop_slows,                ///< after a stop nothing becomes faster, all stands in time, lasers are off
    stop_stays,                ///< nothing moves again before a reset, which moves nothing
    stop_is_taken,             ///< in every state
    reset_is_needed,           ///< an error stop ends with a reset
    position_is_true,          ///< a position that is trusted is that of the machine
    counters_are_pulses,       ///< counters change with the pulses alone
    limits_kept,               ///< velocity and acceleration of each axis
    travel_kept,               ///< a trusted axis stays within its travel
    one_alarm_a_cause,         ///< until it is reset
    time_is_monotone,          ///< as are the numbers of pictures and alarms
    nothing_taken_is_missing,  ///< each order that was answered is in the record, in order
    same_history,              ///< of the same seed
    no_allocation,             ///< within the kernel's run
    usable_again               ///< when all is mended and reset
};
std::string_view name_of(Rule rule);

/// One axis at one instant.
struct AxisSight {
    bool enabled = true, position_valid = false;
    std::int64_t sent = 0;     ///< pulses on the wires since the start; of a servo what its motor has turned
    std::int64_t counter = 0;  ///< of the card
    bool driven = false;       ///< its card makes pulses, however slowly; of a servo: false
    double commanded = 0, true_position = 0;  ///< by the counter; of the table
};

struct Sight {
    Instant at{};
    std::int64_t sequence = 0;
    operate::MachineState state = operate::MachineState::standstill;
    bool latched = false;
    bool abrupt = false;  ///< it ends pulses without a ramp
    int lasers_on = 0;
    double belt_speed = 0;  ///< of all belts and tables
    std::vector<AxisSight> axes;
    const std::vector<operate::Alarm>* alarms = nullptr;
};

/// An axis as the rack file has it.
struct AxisFacts {
    char letter = 'X';
    bool servo = false;
    double pulses_per_unit = 1, max_velocity = 1, max_accel = 1, velocity_step = 1;
    double min_position = -std::numeric_limits<double>::infinity(), max_position = -min_position;
    double following_alarm = 0;
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
        double jerk_time_s = 0;              ///< what a profile with limited jerk needs to begin to decelerate
        Duration obeyed = milliseconds(12);  ///< so long after a stop what has to slow down does
    };
    /// Each rule is reported once.
    Invariants(std::vector<AxisFacts> axes, const Settings& settings, Report report);

    /// An order was taken. With the first call all later ones come here, too.
    enum class Order : std::uint8_t { motion, position, stop, reset, enable, part };
    void ordered(Order order);
    /// From outside something was pushed, held or written, so that pulses and places part by right.
    void disturbed();
    /// A card hangs: its host waits for an answer, for 2 s at most, and does nothing else.
    void hung() { hangs_ = pictures_of_a_hang; }
    void see(const Sight& sight);
    /// A rule that is looked at elsewhere.
    void found(Rule rule, Instant at, std::string text);
    const std::vector<Finding>& findings() const { return findings_; }

  private:
    struct Own {
        double offset = 0;    ///< place less commanded when it became trusted
        Instant off_since{};  ///< it has been off for so long
        bool off = false;
        double velocity = 0;    ///< of the interval before
        std::int64_t base = 0;  ///< pulses at the begin of the interval
        std::string jumped;     ///< in a stop that goes on: what its velocity did
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
    std::set<Rule> told_;
    bool first_ = true;
    bool searches_ = false, searched_ = false;  ///< for home, or stops on the way to it; in the picture before
    Sight last_;
    std::vector<Own> own_;
    // orders
    bool knows_orders_ = false, parts_stand_ = false;
    bool reset_ = false;                         ///< since the stop
    bool reset_now_ = false, stop_now_ = false;  ///< since the last picture, the one that came last
    static constexpr int pictures_of_a_hang = 1'500;
    int hangs_ = 0;
    int may_move_ = 0, may_declare_ = 0, stop_due_ = 0;  ///< for so many pictures
    // the interval in which velocities are measured
    Instant base_at_{};
    double last_seconds_ = 0;
    bool serviced_ = false;  ///< a card was in service in this interval
    bool jumped_ = true;     ///< pulses ended without a ramp, or this is the begin: nothing to compare with
    bool braked_ = false, was_braked_ = false;  ///< a stop was in force in it, in the one before it
    // a stop
    Instant latched_at_{}, stands_by_{};
    double lowest_ = 0;
    bool stood_ = false;
    bool linear_moves_ = false;
    int unheeded_ = 0;  ///< pictures of an idle machine in a stop
    // alarms
    std::int64_t last_alarm_ = 0;
    std::set<std::string> alarm_texts_;
};

}  // namespace motionrack::test
