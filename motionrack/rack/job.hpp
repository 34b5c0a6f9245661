// A job: a part program run on a rack, monitored from start to standstill, with all data for a report.
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
    double seconds = 0;      ///< virtual time since the start of the job
    std::int64_t line = 0;   ///< current program line
    std::int64_t lines = 0;  ///< number of program lines
};

struct JobSettings {
    std::string_view program;  ///< program text; must outlive the job
    std::string program_name;  ///< for messages
    /// Reader settings; none: reader_settings() of the rack.
    std::optional<control::gcode::Settings> reading = {};
    Duration sample_period = milliseconds(1);
    std::size_t max_samples = 200'000;
    const std::atomic<bool>* stop = nullptr;                ///< stop request (Ctrl-C); ignored if `commands` is set
    CommandSchedule* commands = nullptr;                    ///< planned commands and stops; must outlive the job
    std::function<void(const JobProgress&)> progress = {};  ///< about every 50 ms of virtual time
    std::function<void()> on_slice = {};                    ///< called between runs: recorders drain here
    std::function<void(const MonitorSample&, double deviation_mm)> on_sample =
        {};  ///< called with every sample, between runs
};

/// Result of one axis.
struct AxisOutcome {
    int index = 0;  ///< 0 .. 5
    std::string unit;
    bool servo = false;  ///< the axis follows a voltage: `pulses` are encoder counts, and no pulses are sent
    control::AxisLimits limits;
    std::int64_t pulses_sent = 0;      ///< pulses in both directions since the start of the job
    std::int64_t pulses_net = 0;       ///< forward pulses minus backward pulses
    std::int64_t pulse_position = 0;   ///< the card's counter LP at the end
    std::int64_t pulse_start = 0;      ///< the card's counter LP at the start of the job
    std::int64_t encoder_counts = 0;   ///< change of the card's encoder counter EP
    std::int64_t expected_counts = 0;  ///< expected change if the motor followed every pulse
    std::int64_t lost_pulses = 0;      ///< step loss of the motor
    double planned_end = 0;            ///< mm or degrees
    double actual_end = 0;             ///< machine position, by the last position reference
    AxisStatistics top;
};

/// A sentence about an event, with its instant.
struct JobWarning {
    Instant at{};
    int line = 0;
    std::string text;
};

struct JobOutcome {
    Result<void> ended;  ///< error that ended the job, if any
    control::ProgramResult run;
    Duration time{};     ///< duration in virtual time
    double path_mm = 0;  ///< planned XYZ path length
    std::vector<AxisOutcome> axes;
    PathDeviation max_deviation;
    double tolerance_mm = 0;  ///< largest deviation that the program allows on its path
    std::vector<JobWarning> warnings;
    std::int64_t chip_segments = 0;
    std::uint64_t events = 0;  ///< kernel events: cost of the simulation
    std::uint64_t trace_hash = 0;
    int rest_axis = -1;   ///< servo axis with the largest position error at the end; -1: no servo
    double rest_off = 0;  ///< position error of rest_axis, mm or degrees
    bool position_valid =
        true;           ///< false after step loss, or if an axis that positions by itself has lost its position
    Breaches breaches;  ///< breaches caused by the controller

    /// Returns true if the job ended well without step loss or breach.
    bool good() const { return ended.has_value() && position_valid && breaches.all().empty(); }
};

/// Returns all axes of a rack with the data that a monitor needs.
std::vector<WatchedAxis> watched_axes(Rack& rack);
/// Reader settings of a rack's controller; programs begin at the axes' initial positions.
control::gcode::Settings reader_settings(const RackConfig& config, bool block_delete = false);

/// Runs checked programs one after the other on a rack at standstill. Each program begins at the axes' present
/// positions and has its own outcome. `monitor` keeps the data of the last one.
class Job {
  public:
    /// Call before the rack starts; adds the monitor to the rack.
    Job(Rack& rack, JobSettings settings);
    ~Job();

    /// Replaces the program of the settings and its reader settings; call before run(). The text must outlive the run.
    void give(std::string_view program, std::string name, control::gcode::Settings reading);

    /// Start position of the next program, mm or degrees; call between programs. Errors: as PositionReference::check.
    Result<control::Point> start() const;
    JobOutcome run();
    /// Homes axes as home_axes does, which sets their position reference.
    HomingOutcome home(const HomingSettings& settings);
    /// Takes over the controller's axis positions from another job, whose rack was copied into this job's rack.
    void copy_from(const Job& other) {
        reference_.copy_from(other.reference_);
        reported_ = other.reported_;
    }
    const Monitor& monitor() const { return *monitor_; }
    /// Planned moves as they were submitted, at most `max_planned`.
    const std::vector<control::PlannedMove>& planned() const { return planned_; }
    static constexpr std::size_t max_planned = 20'000;

  private:
    /// Lines whose moves were replaced for execution, and the largest deviation caused by that.
    struct DrivenOtherwise {
        control::PathWarning first;
        int last_line = 0;
        std::int64_t lines = 0;
    };

    /// Counter values at the start of the program.
    struct Before {
        std::int64_t pulses_made = 0, commanded = 0, pulse_counter = 0, encoder_counter = 0;
    };

    void restart();
    void note_before();
    void judge_positions(ValidityWatch& validity, JobOutcome& out);
    Result<void> drive(control::AxisGroup& axes, JobOutcome& out);
    Result<void> drive_by_stream(control::AxisGroup& axes, const control::ExecutorSettings& settings, JobOutcome& out);
    void programmed(const control::Move& move, const control::Point& start, JobOutcome& out);
    void planned(std::int64_t block, const control::PlannedMove& move);
    void listen(const std::vector<control::MoveStart>& starts);
    std::vector<AxisOutcome> axis_outcomes(const control::Point& sent_to);
    std::vector<DrivenOtherwise> take_path_warnings(control::AxisGroup& axes, JobOutcome& out);
    void report_other_motion(const std::vector<DrivenOtherwise>& others, JobOutcome& out) const;
    void collect_breaches(JobOutcome& out);
    void collect_conditions(JobOutcome& out);
    void report_stop(JobOutcome& out);

    Rack& rack_;
    JobSettings settings_;
    PositionReference reference_;
    control::Point start_ = {};   ///< start of the program
    std::vector<Before> before_;  ///< one per axis
    std::int64_t segments_before_ = 0;
    std::uint64_t reported_ = 0;  ///< kernel conditions reported before this program
    std::unique_ptr<Monitor> monitor_;
    std::vector<control::PlannedMove> planned_;
    Instant given_{};  ///< instant before the axes were set up for the program
    Instant began_{};
    int line_ = 0;            ///< current program line
    std::int64_t lines_ = 0;  ///< number of program lines
};

}  // namespace motionrack::rack
