// Division of planned moves into chip segments: the chip draws lines of two and three axes and arcs of two; other moves
// are divided here.
//
//   planned speed    ______            a move is divided where its deceleration begins; each segment has one V,
//                   /      \           which its generator approaches from the segment's first pulse on:
//                  /        \              [ accelerate, cruise ][ decelerate ]
//                 /          \___      chords of arcs that the chip cannot draw have a V each
//
// Every segment is long enough for the host to write the next one; a deceleration begins earlier if necessary.
//
// At the junction of two moves the generator's V is continuous, but a pulse of the long axis is a different path
// velocity on each side. The junction's V is the smaller of both, so no limit is exceeded.
#pragma once

#include <deque>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/mcx314/axes/geometry.hpp>
#include <motionrack/cards/mcx314/axes/segment.hpp>
#include <motionrack/control/axis_group.hpp>
#include <motionrack/control/geometry.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace motionrack::mcx314 {

class Segmenter {
  public:
    /// `range`: R of the generator (16,000 .. 8,000,000). `start`: position of the machine, in pulses.
    Segmenter(const AxisMap& map, std::int32_t range, const Pulses4& start, const HostTimes& host);

    /// Takes the next planned move; its segments become available once the following move is known.
    void add(const control::PlannedMove& move);
    /// Ends the input: all segments become available.
    void finish();

    std::size_t ready() const { return ready_.size(); }
    const Segment& operator[](std::size_t i) const { return ready_[i]; }
    void pop() { ready_.pop_front(); }

    /// Returns the known pulses that the auxiliary axis of this channel still has in the present chain in one
    /// `direction` (1 or -1), up to its reversal.
    std::int64_t auxiliary_pulses_ahead(int channel, int direction) const;

    /// Returns the number of the next planned move, from 0.
    std::int32_t next_move() const { return next_block_; }
    void count_from(std::int32_t block) { next_block_ = block; }

    /// Returns the warnings since the last call, oldest first.
    std::vector<control::PathWarning> take_path_warnings() { return std::exchange(notes_, {}); }

    /// Returns the R with which a path diagonal to two of the fastest axes, both at their maximum pulse rate, uses all
    /// 8,000 speed units.
    static std::int32_t best_range(const AxisMap& map);

    /// Returns the minimum duration of a segment, s: a shorter one may end before the host has written the next.
    static double min_seconds(const HostTimes& host);
    /// Returns the minimum duration, s, of a segment of which the host counts the whole pulses.
    static double min_counted_seconds(const HostTimes& host);

  private:
    static constexpr std::int64_t max_line_pulses = 8'000'000;  ///< pulses

    enum class Shape : std::uint8_t { pause, line, chip_arc, chords };
    /// A planned move and its representation on the chip.
    struct PendingMove {
        control::PlannedMove move;
        control::Geometry path;
        Shape shape = Shape::line;
        bool constant_vector = false;
        double units_in = 0;   ///< V units for 1 mm/s (deg/s) at its start
        double units_out = 0;  ///< the same at its end; differs only for chords
        std::int32_t block = 0;
        std::int32_t auxiliary = -1;  ///< channel of a fourth axis that moves beside the interpolation
        std::uint8_t channels = 0;    ///< the moving channels, one bit each
        Pulses4 to = {};
        std::int32_t max_at_end = rules::max_units;  ///< V limit at the start of the next segment
        bool turns_back = false;                     ///< the next segment reverses
    };
    /// Division of a move: V is `top` until the position `fall_from` along it, then `exit`.
    struct MoveSpeeds {
        double fall_from = 0;
        std::int32_t top = 1;
        std::int32_t exit = 1;
        std::int32_t acceleration = 1;
    };

    /// Limits in V and A units.
    struct UnitLimits {
        std::int32_t speed = rules::max_units;
        std::int32_t acceleration = rules::max_units;
    };

    PendingMove classify(const control::PlannedMove& move);
    void emit(const PendingMove& work, std::optional<double> next_units);
    static Pulses4 delta_between(const PendingMove& work, const Pulses4& from, const Pulses4& to);
    static std::int64_t basic_pulses(const Pulses4& delta);
    void look_at_next(PendingMove& work, const PendingMove& next) const;
    void make_even(const PendingMove& work, MoveSpeeds& speeds);
    void emit_pause(const PendingMove& work);
    bool emit_s_curve(const PendingMove& planned);
    void emit_straight(const PendingMove& work, const MoveSpeeds& speeds);
    void emit_arcs(const PendingMove& work, double from, double to, std::int32_t v, std::int32_t acceleration);
    bool emit_fitted_arc(const PendingMove& work, double from, double to, std::int32_t v, std::int32_t acceleration);
    void emit_chords(const PendingMove& work, const MoveSpeeds& speeds);
    void add_rest(const PendingMove& work, const MoveSpeeds& speeds);
    void emit_line(const PendingMove& work, const Pulses4& to, std::int32_t v, std::int32_t acceleration);
    std::size_t waits_for_room(const PendingMove& work, const Pulses4& to) const;
    void append(Segment segment, const PendingMove& work, const Pulses4& to);
    void close_chain();
    void note_split(const PendingMove& work, const char* why, double deviation_mm);
    Pulses4 pulses_at(const PendingMove& work, double s) const;
    double units_along(const PendingMove& work, const control::Point& tangent) const;
    double fall_length(double units, const MoveSpeeds& speeds) const;
    double fall_from(const PendingMove& work, double units, const MoveSpeeds& speeds) const;
    bool leaves_time(const PendingMove& work, double from, double to, std::int32_t v) const;
    std::int32_t speed_units(double units, double speed) const;
    std::int32_t acceleration_units(double units, double acceleration) const;
    UnitLimits max_on(const Pulses4& delta, bool constant_vector) const;
    double start_speed(const control::Point& tangent) const;

    AxisMap map_;
    std::int32_t range_;
    double pulses_per_v_;     ///< pulses/s of one V unit
    double host_seconds_;     ///< latency of the host
    double latency_seconds_;  ///< time until a speed is written
    double min_seconds_, min_counted_seconds_;
    Pulses4 at_;
    std::optional<PendingMove> waiting_;
    std::deque<Segment> ready_;
    std::vector<control::PathWarning> notes_;
    bool chain_open_ = false;
    double reached_ = 1;  ///< V at the end of the last segment of a trajectory
    double left_at_ = 0;  ///< V at the end of the last move if it was not lowered for the next one; 0: at standstill
    int generator_ = 0;
    std::int32_t next_block_ = 0;
};

}  // namespace motionrack::mcx314
