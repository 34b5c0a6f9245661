// Monitors the true machine position during a job: samples of every axis, peak velocities and accelerations, and the
// deviation from the programmed path.
//
//   kernel --on_scheduled(t), every period--> ring of samples --drain(), between runs--> series, statistics, deviation
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <motionrack/control/axis_group.hpp>
#include <motionrack/control/planned_move.hpp>
#include <motionrack/rack/breaches.hpp>
#include <motionrack/rack/peak_velocity.hpp>
#include <motionrack/rack/programmed_path.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/parts/dc_motor.hpp>
#include <motionrack/sim/position_function.hpp>
#include <motionrack/trace/decimating_buffer.hpp>
#include <vector>

namespace motionrack::rack {

/// One axis of the monitor. Position in mm or degrees = origin + count / pulses_per_unit.
struct WatchedAxis {
    int index = 0;                                ///< 0 .. 5: control::axis_letters
    sim::PositionFunction* commanded = nullptr;   ///< the card's pulses
    const sim::PositionFunction* real = nullptr;  ///< position of the rotor, in pulses
    const parts::DcMotor* servo = nullptr;        ///< servo that turns the axis; nullptr: pulses turn it
    double pulses_per_unit = 1;
    double origin = 0;            ///< position of true count 0, mm or degrees
    double commanded_beyond = 0;  ///< position of commanded count 0, less `origin`
    double jump_hz = 1;           ///< rate changes above this limit are steps, not ramps
    double full_step = 16;        ///< in pulses: a rate change that is over within this distance is not a velocity step
    double accel_hz = 0;          ///< acceleration limit of the axis, pulses/s2
    double start_hz = 0;          ///< velocity step limit of the axis, pulses/s
};

struct MonitorSample {
    Instant at{};
    std::array<double, control::axis_count> position = {};   ///< true position, mm or degrees
    std::array<double, control::axis_count> commanded = {};  ///< commanded position by the pulses, mm or degrees
    std::array<double, control::axis_count> velocity = {};   ///< velocity of the pulses, per second
    std::array<float, control::axis_count> volts = {};       ///< volts at the amplifier of a servo
    std::array<float, control::axis_count> accel = {};  ///< over 4 samples, per second squared; NaN at a velocity step
};

struct AxisStatistics {
    double peak_velocity = 0;  ///< highest sustained velocity, per second; see PeakVelocity
    double peak_accel = 0;     ///< per second squared, over 4 samples without a velocity step
    double peak_velocity_step =
        0;  ///< largest velocity step (start, junction, stop), less the effect of whole pulses; per second
};

/// A planned move as executed.
struct ExecutedMove {
    std::int64_t block = 0;
    int line = 0;
    control::MoveKind kind = control::MoveKind::feed;
    double length = 0;          ///< length, mm or degrees
    double entry_velocity = 0;  ///< planned velocities, per second
    double cruise_velocity = 0;
    double exit_velocity = 0;
    Instant start{};
    Instant end{};
    double deviation_mm = 0;  ///< maximum deviation on the move
};

/// Largest deviation of the machine from the programmed path.
struct PathDeviation {
    double mm = 0;
    Instant at{};
    int line = 0;
    std::array<double, 3> position = {};  ///< machine position, mm
};

class Monitor final : public sim::Device {
  public:
    static constexpr std::size_t ring_size = 1 << 14;

    /// `period`: time between samples; doubled, dropping every second sample, whenever more than `max_samples` are
    /// kept.
    Monitor(sim::Kernel& kernel, std::vector<WatchedAxis> axes, Duration period, std::size_t max_samples);

    /// Prepares for another program and discards the data of the previous one. Call at standstill; `axes` are those of
    /// the constructor, with their new origins.
    void restart(std::vector<WatchedAxis> axes);
    /// Starts sampling immediately.
    void begin();
    /// Takes the last sample and stops.
    void finish();
    /// Adds a move of the program before it is planned.
    void programmed(const control::Move& move, const control::Point& start) { seen_.program.add(move, start); }
    /// Adds a planned move when it is submitted to the axes.
    void planned(std::int64_t block, const control::PlannedMove& move);
    /// Adds the planned moves that have started since the last call.
    void started(const std::vector<control::MoveStart>& starts);
    /// Processes the ring; call between runs, at least every ring_size periods.
    void drain();

    /// Calls `call` with every sample and its deviation in mm, between runs; no sample is left out.
    void on_sample(std::function<void(const MonitorSample&, double deviation)> call) { on_sample_ = std::move(call); }

    const std::vector<MonitorSample>& samples() const { return seen_.kept.samples(); }
    const std::vector<double>& deviations() const { return seen_.kept.deviations(); }  ///< mm, one per sample
    const AxisStatistics& statistics(int index) const { return seen_.statistics[static_cast<std::size_t>(index)]; }
    const PathDeviation& max_deviation() const { return seen_.max_deviation; }
    /// Breaches in the commanded motion.
    const std::vector<Breach>& breaches() const { return seen_.breaches.all(); }
    /// Sets the permitted deviation of the pulses beyond the program's own tolerance, mm; 0 (default): unlimited. Call
    /// before begin().
    void set_allowed_deviation(double mm) { allowed_mm_ = mm; }
    /// Returns the machine position of the first sample at or after that instant, mm; else of the last one.
    std::array<double, 3> place_at(Instant at) const;
    const std::vector<ExecutedMove>& blocks() const { return seen_.blocks; }
    std::int64_t blocks_left_out() const { return seen_.blocks_left_out; }
    std::int64_t samples_taken() const { return seen_.taken; }
    Duration period() const { return period_; }

    void on_scheduled(Instant now) override;

  private:
    /// Listens to the changes of one axis' pulse rate.
    class RateObserver final : public sim::PositionListener {
      public:
        RateObserver(double allowed_hz, Duration period) : velocity(allowed_hz, period), jump_hz(allowed_hz) {}
        void crossed(Instant) override {}
        void rate_changed(double before, double rate, Instant now) override;
        /// Restarts at this rate now, independent of earlier motion.
        void restart(const PeakVelocity& fresh, double rate, Instant now);
        /// Confirms the last change as a velocity step.
        void settle();
        PeakVelocity velocity;
        double good = 0;       // confirmed rate of the axis
        double follower = 0;   // the confirmed rate, but following small steps within the acceleration limit
        double present = 0;    // present rate of the pulses
        double away = 0;       // pulses by which `present` has departed from `good`
        double rounding = 0;   // rate change explained by whole pulses of the shortest segment since then, or before it
        double explained = 0;  // rate change that the acceleration limit allows since the last step
        bool pending = false;
        Instant since{};
        Instant piece_since{};
        double jump = 0;
        double jump_hz;
        double full_step = 16;
        double accel_hz = 0;
        std::uint32_t jumps = 0;
    };
    struct RawSample {
        Instant at{};
        std::array<std::int64_t, control::axis_count> count = {}, commanded = {};
        std::array<double, control::axis_count> rate = {};
        std::array<float, control::axis_count> volts = {};
        std::array<std::uint32_t, control::axis_count> jumps = {};
    };
    struct Planned {
        std::int64_t block = 0;
        control::PlannedMove move;
    };
    /// Data of one program.
    struct Seen {
        Seen(const std::vector<WatchedAxis>& axes, Duration period, std::size_t max_samples);
        std::size_t ring_begin = 0;
        std::size_t ring_end = 0;
        std::int64_t ring_lost = 0;
        std::array<RawSample, 5> last = {};  // newest first, for accelerations
        int last_count = 0;
        trace::DecimatingBuffer<MonitorSample> kept;
        std::int64_t taken = 0;
        std::array<AxisStatistics, control::axis_count> statistics = {};
        std::deque<Planned> planned;
        std::deque<control::MoveStart> starts;
        std::int64_t current = -1;
        ProgrammedPath program;
        ProgramPart part{-1, 0, -1, 0};        ///< moves on which the machine may be
        std::int64_t current_programmed = -1;  ///< move at which the current planned move begins
        /// Lengths of the last planned move that began before that move, and of those that begin on it.
        double before_mm = 0, last_mm = 0, current_mm = 0;
        ExecutedMove open_block;
        bool block_open = false;
        std::vector<ExecutedMove> blocks;
        std::int64_t blocks_left_out = 0;
        PathDeviation max_deviation;
        std::vector<JumpWatch> jump_watches;  ///< one per axis, for axes moved by pulses
        Breaches breaches;
        bool beside = false;  ///< the pulses deviate too far from the program
    };

    void take(Instant now);
    void work_off(const RawSample& raw);
    void accelerations(const RawSample& raw, MonitorSample& sample);
    void look_for_jumps(const RawSample& raw, const MonitorSample& sample);
    void look_at_deviation(const MonitorSample& sample, const ProgramDistance& off);
    Breach breach_here(const MonitorSample& sample) const;
    ProgramDistance deviation_at(const std::array<double, control::axis_count>& position) const;
    void begin_programmed(const control::PlannedMove& block);
    void find_programmed();
    void close_block(Instant end);

    sim::Kernel& kernel_;
    sim::DeviceId id_;
    std::vector<WatchedAxis> axes_;
    std::vector<RateObserver> listeners_;
    Duration period_;
    std::size_t max_samples_;
    std::vector<RawSample> ring_;
    Seen seen_;
    bool running_ = false;
    std::function<void(const MonitorSample&, double)> on_sample_;
    double allowed_mm_ = 0;
};

}  // namespace motionrack::rack
