// Watches where the machine really is while a job runs: samples of every axis, top speeds and accelerations, and the
// distance from the programmed path.
//
//   kernel --act(t), every period--> ring of samples --drain(), between runs--> series, statistics, deviation
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <motionrack/control/axis_group.hpp>
#include <motionrack/control/planned_move.hpp>
#include <motionrack/rack/breaches.hpp>
#include <motionrack/rack/programmed_path.hpp>
#include <motionrack/rack/top_speed.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/parts/dc_motor.hpp>
#include <motionrack/sim/position_function.hpp>
#include <motionrack/trace/decimating_buffer.hpp>
#include <vector>

namespace motionrack::rack {

/// One axis as the monitor sees it. Position in mm or degrees = origin + count / pulses_per_unit.
struct WatchedAxis {
    int index = 0;                                ///< 0 .. 5: control::axis_letters
    sim::PositionFunction* commanded = nullptr;   ///< the card's pulses
    const sim::PositionFunction* real = nullptr;  ///< the rotor, in pulses
    const parts::DcMotor* servo = nullptr;        ///< what turns it, if no pulses do
    double pulses_per_unit = 1;
    double origin = 0;            ///< mm or degrees where the real count is 0
    double commanded_beyond = 0;  ///< and how much more where the commanded one is
    double jump_hz = 1;           ///< rates that change by more than this at once are jumps, not ramps
    double full_step = 16;        ///< pulses: a change that is over before the axis is that far away is no jump
    double accel_hz = 0;          ///< the axis' acceleration limit, pulses/s2
    double start_hz = 0;          ///< its start speed, pulses/s
};

struct Sample {
    Instant at{};
    std::array<double, control::axis_count> position = {};   ///< real, mm or degrees
    std::array<double, control::axis_count> commanded = {};  ///< by the pulses, mm or degrees
    std::array<double, control::axis_count> speed = {};      ///< of the pulses, per second
    std::array<float, control::axis_count> volts = {};       ///< at the amplifier of a servo
    std::array<float, control::axis_count> accel =
        {};  ///< over 4 samples, per second squared; NaN where the speed jumped
};

struct AxisStatistics {
    double peak_velocity = 0;  ///< per second; that lasted, see TopSpeed
    double peak_accel = 0;     ///< per second squared, over 4 samples without a jump
    double peak_velocity_step =
        0;  ///< greatest change of speed at once (start, joint, stop), less what whole pulses make of it; per second
};

/// A planned move as it was really driven.
struct ExecutedMove {
    std::int64_t block = 0;
    int line = 0;
    control::MoveKind kind = control::MoveKind::feed;
    double length = 0;          ///< mm or degrees
    double entry_velocity = 0;  ///< planned speeds, per second
    double cruise_velocity = 0;
    double exit_velocity = 0;
    Instant start{};
    Instant end{};
    double deviation_mm = 0;  ///< worst in it
};

/// Where the machine was farthest from the programmed path.
struct PathDeviation {
    double mm = 0;
    Instant at{};
    int line = 0;
    std::array<double, 3> place = {};  ///< where the machine was, mm
};

class Monitor final : public sim::Device {
  public:
    static constexpr std::size_t ring_size = 1 << 14;

    /// `period`: between samples; doubled whenever more than `max_samples` are kept (every second one is then
    /// dropped).
    Monitor(sim::Kernel& kernel, std::vector<WatchedAxis> axes, Duration period, std::size_t max_samples);

    /// Another program: forgets what it saw of the one before. Nothing moves; `axes` are those that it was made with,
    /// wherever their counts begin now.
    void restart(std::vector<WatchedAxis> axes);
    /// Begins sampling now.
    void begin();
    /// Takes the last sample and ends.
    void finish();
    /// A move of the program, before it is planned.
    void programmed(const control::Move& move, const control::Point& start) { seen_.program.add(move, start); }
    /// A planned move was handed to the axes.
    void planned(std::int64_t block, const control::PlannedMove& move);
    /// Planned moves that have really begun since the last call.
    void started(const std::vector<control::MoveStart>& starts);
    /// Works off the ring; call between runs, at least every ring_size periods.
    void drain();

    /// Hears every sample with its deviation in mm, between runs; nothing is left out.
    void on_sample(std::function<void(const Sample&, double deviation)> call) { on_sample_ = std::move(call); }

    const std::vector<Sample>& samples() const { return seen_.kept.samples(); }
    const std::vector<double>& deviations() const { return seen_.kept.deviations(); }  ///< mm, one a sample
    const AxisStatistics& statistics(int index) const { return seen_.statistics[static_cast<std::size_t>(index)]; }
    const PathDeviation& worst() const { return seen_.worst; }
    /// What the axes were asked for and must not have been.
    const std::vector<Breach>& breaches() const { return seen_.breaches.all(); }
    /// Before begin(): how far beyond the program's own tolerance pulses may lead, mm; 0, as at first: however far.
    void set_allowed_deviation(double mm) { allowed_mm_ = mm; }
    /// Where the machine was at about that instant, mm.
    std::array<double, 3> place_at(Instant at) const;
    const std::vector<ExecutedMove>& blocks() const { return seen_.blocks; }
    std::int64_t blocks_left_out() const { return seen_.blocks_left_out; }
    std::int64_t samples_taken() const { return seen_.taken; }
    Duration period() const { return period_; }

    void on_scheduled(Instant now) override;

  private:
    /// Hears of each change of one axis' pulse rate.
    class Observer final : public sim::PositionListener {
      public:
        Observer(double allowed_hz, Duration period) : speed(allowed_hz, period), jump_hz(allowed_hz) {}
        void crossed(Instant) override {}
        void rate_changed(double before, double rate, Instant now) override;
        /// Whoever drove it before does not matter: it has this rate since now.
        void restart(const TopSpeed& fresh, double rate, Instant now);
        /// The last change stays: it was a jump.
        void settle();
        TopSpeed speed;
        double good = 0;       // the rate that the axis is held to have
        double follower = 0;   // the same, but following small jumps as fast as the acceleration limit lets it
        double present = 0;    // what the pulses have now
        double away = 0;       // pulses that `present` has led away from `good`
        double rounding = 0;   // change that the whole pulses of the shortest piece since then, or before it, may make
        double explained = 0;  // change of the rate that the acceleration limit allows since the last jump
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
    /// Of one program.
    struct Seen {
        Seen(const std::vector<WatchedAxis>& axes, Duration period, std::size_t max_samples);
        std::size_t ring_begin = 0;
        std::size_t ring_end = 0;
        std::int64_t ring_lost = 0;
        std::array<RawSample, 5> last = {};  // for accelerations, newest first
        int last_count = 0;
        trace::DecimatingBuffer<Sample> kept;
        std::int64_t taken = 0;
        std::array<AxisStatistics, control::axis_count> statistics = {};
        std::deque<Planned> planned;
        std::deque<control::MoveStart> starts;
        std::int64_t current = -1;
        ProgrammedPath program;
        ProgramPart part{-1, 0, 0};            ///< where the machine may be
        std::int64_t current_programmed = -1;  ///< move at which the current block begins
        double before_mm = 0, current_mm = 0;  ///< that blocks have on the move before, and on this one
        ExecutedMove open_block;
        bool block_open = false;
        std::vector<ExecutedMove> blocks;
        std::int64_t blocks_left_out = 0;
        PathDeviation worst;
        std::vector<JumpWatch> jump_watches;  ///< of axes whose pulses move them; one an axis
        Breaches breaches;
        bool beside = false;  ///< the pulses lead too far from the program
    };

    void take(Instant now);
    void work_off(const RawSample& raw);
    void accelerations(const RawSample& raw, Sample& sample);
    void look_for_jumps(const RawSample& raw, const Sample& sample);
    void look_at_deviation(const Sample& sample, const ProgramDistance& off);
    Breach breach_here(const Sample& sample) const;
    ProgramDistance deviation_at(const std::array<double, control::axis_count>& position) const;
    void begin_programmed(const control::PlannedMove& block);
    void find_programmed();
    void close_block(Instant end);

    sim::Kernel& kernel_;
    sim::DeviceId id_;
    std::vector<WatchedAxis> axes_;
    std::vector<Observer> ears_;
    Duration period_;
    std::size_t max_samples_;
    std::vector<RawSample> ring_;
    Seen seen_;
    bool running_ = false;
    std::function<void(const Sample&, double)> on_sample_;
    double allowed_mm_ = 0;
};

}  // namespace motionrack::rack
