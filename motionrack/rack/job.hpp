// A job: a part program run on a rack, watched from start to standstill, with everything a report needs.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <motionrack/control/program_executor.hpp>
#include <motionrack/rack/command_schedule.hpp>
#include <motionrack/rack/homing.hpp>
#include <motionrack/rack/interactive_run.hpp>
#include <motionrack/rack/monitor.hpp>
#include <motionrack/rack/position_reference.hpp>
#include <motionrack/rack/rack.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

struct JobProgress {
    double seconds = 0;      ///< virtual time since the job began
    std::int64_t line = 0;   ///< line being driven
    std::int64_t lines = 0;  ///< lines of the program
};

struct JobSettings {
    std::string_view program;  ///< the text; must outlive the job
    std::string program_name;  ///< for messages
    /// How it is read; none: reader_settings() of the rack.
    std::optional<control::gcode::Settings> reading = {};
    Duration sample_period = milliseconds(1);
    std::size_t max_samples = 200'000;
    const std::atomic<bool>* stop = nullptr;                ///< Ctrl-C; not used if there are orders
    CommandSchedule* orders = nullptr;                      ///< planned orders, and stops; must outlive the job
    std::function<void(const JobProgress&)> progress = {};  ///< about every 50 ms of virtual time
    std::function<void()> on_slice = {};                    ///< between runs: recorders drain here
    std::function<void(const Sample&, double deviation_mm)> on_sample = {};  ///< every sample, between runs
};

/// What one axis did.
struct AxisOutcome {
    int index = 0;  ///< 0 .. 5
    std::string unit;
    bool servo = false;  ///< it follows a voltage: pulses are those of its encoder, none are sent
    control::AxisLimits limits;
    std::int64_t pulses_sent = 0;      ///< pulses of both directions since the job began
    std::int64_t pulses_net = 0;       ///< of them, forward less backward
    std::int64_t pulse_position = 0;   ///< the card's counter LP at the end
    std::int64_t pulse_start = 0;      ///< and when the job began
    std::int64_t counts_read = 0;      ///< by which the card's encoder counter EP has changed
    std::int64_t counts_expected = 0;  ///< and would have if every pulse had moved the motor
    std::int64_t lost_pulses = 0;      ///< pulses that the motor did not follow
    double planned_end = 0;            ///< mm or degrees
    double real_end = 0;               ///< where the machine is, by the last reference of its position
    AxisStatistics top;
};

/// A sentence about something that happened, with its instant.
struct JobWarning {
    Instant at{};
    int line = 0;
    std::string text;
};

struct JobOutcome {
    Result<void> ended;  ///< how it ended
    control::ProgramResult run;
    Duration time{};     ///< virtual time of the job
    double path_mm = 0;  ///< planned XYZ path
    std::vector<AxisOutcome> axes;
    PathDeviation worst;
    double tolerance_mm = 0;  ///< greatest deviation that the program allows somewhere
    std::vector<JobWarning> warnings;
    std::int64_t chip_segments = 0;
    std::uint64_t events = 0;  ///< kernel events: what it cost
    std::uint64_t trace_hash = 0;
    int rest_axis = -1;   ///< of the servos the one that stands farthest from where it was sent; -1: no servo
    double rest_off = 0;  ///< and how far, mm or degrees
    bool position_trusted =
        true;           ///< false once steps were lost, or an axis that positions by itself does not know where it is
    Breaches breaches;  ///< what the controller must not do to the machine, and did

    /// It ended, and nothing was lost or broken on the way.
    bool good() const { return ended.has_value() && position_trusted && breaches.all().empty(); }
};

/// What a monitor watches of a rack: all its axes.
std::vector<WatchedAxis> watched_axes(Rack& rack);
/// How a rack's controller reads part programs; they begin where the axes start.
control::gcode::Settings reader_settings(const RackConfig& config, bool block_delete = false);

/// Runs programs that have been checked on a rack at standstill, one after the other: each begins where its axes stand,
/// and its outcome is of it alone. `monitor` keeps what was seen of the last one.
class Job {
  public:
    /// Before the rack is started: adds the monitor to it.
    Job(Rack& rack, JobSettings settings);
    ~Job();

    /// Another program than that of the settings, before run(), and how it is read. The text must outlive the run.
    void give(std::string_view program, std::string name, control::gcode::Settings reading);

    /// Between programs: where the next one begins, mm or degrees. Errors: those of PositionReference::check.
    Result<control::Point> start() const;
    JobOutcome run();
    /// home_axes, which gives axes another reference.
    HomingOutcome home(const HomingSettings& settings);
    /// Where the controller of this job's world has its axes becomes that of another one, whose rack is this one's
    /// copy.
    void copy_from(const Job& other) {
        reference_.copy_from(other.reference_);
        told_ = other.told_;
    }
    const Monitor& monitor() const { return *monitor_; }
    /// Every planned move as it was handed out, at most `max_planned`.
    const std::vector<control::PlannedMove>& planned() const { return planned_; }
    static constexpr std::size_t max_planned = 20'000;

  private:
    /// What moves of some lines were driven with instead, and what that costs at most.
    struct DrivenOtherwise {
        control::PathWarning first;
        int last_line = 0;
        std::int64_t lines = 0;
    };

    /// What was counted when the program began.
    struct Before {
        std::int64_t pulses_made = 0, commanded = 0, pulse_counter = 0, encoder_counter = 0;
    };

    void restart();
    void note_before();
    void judge_positions(TrustWatch& trust, JobOutcome& out);
    Result<void> drive(control::AxisGroup& axes, JobOutcome& out);
    Result<void> drive_by_stream(control::AxisGroup& axes, const control::ExecutorSettings& settings, JobOutcome& out);
    void programmed(const control::Move& move, const control::Point& start, JobOutcome& out);
    void planned(std::int64_t block, const control::PlannedMove& move);
    void listen(const std::vector<control::MoveStart>& starts);
    std::vector<AxisOutcome> axis_outcomes(const control::Point& sent_to);
    std::vector<DrivenOtherwise> take_path_warnings(control::AxisGroup& axes, JobOutcome& out);
    void tell(const std::vector<DrivenOtherwise>& others, JobOutcome& out) const;
    void collect_breaches(JobOutcome& out);
    void collect_conditions(JobOutcome& out);
    void tell_stop(JobOutcome& out);

    Rack& rack_;
    JobSettings settings_;
    PositionReference reference_;
    control::Point start_ = {};   ///< of the program
    std::vector<Before> before_;  ///< one an axis
    std::uint64_t told_ = 0;      ///< conditions of the kernel, by the programs before
    std::unique_ptr<Monitor> monitor_;
    std::vector<control::PlannedMove> planned_;
    Instant given_{};  ///< before its axes were set up
    Instant began_{};
    int line_ = 0;            ///< being driven
    std::int64_t lines_ = 0;  ///< of the program
};

}  // namespace motionrack::rack
