// A rack that is operated while it runs.
//
//   any thread ──post──► [ inbox ] ──► motion thread: Machine::run ──► StreamExecutor, axes, homing ──► cards
//                                            │ every 2 ms of virtual time: pace, inbox, status ──► on_status
//
//   disabled ──enable──► standstill ──line, program──► moving ◄──hold, resume──► hold
//                            │  ▲ ├──jog──► jogging      │ a limit, an alarm, the emergency stop, a watchdog: from
//                            │  └─┴──home─► homing       ▼ every state, as the rack's stop latch says; stop(), too
//                            ├◄───────reset────────── error stop
//                            └──service──► service: manual calls of a card's functions, see service.hpp
//
// An error stop begins when every axis is at standstill; while one still decelerates the machine is stopping. A reset
// moves nothing; pending motion is dropped, and a new command is needed.
//
// Only the motion thread touches the rack. Posted work runs there between two runs of the kernel, often in the middle
// of a motion. So commands only record requests, and the motion thread's loop executes them.
//
// Machine has the states and the loop, and wires its parts, each of which owns its own state:
//   StatusPublisher   status, listeners          AxisHandover     the driver that has the axes
//   AlarmList         alarms                     AxisEnables      enabled axes
//   ProgramRun        executor, programs, lines  PositionSetter   set positions until they are executed
//   ManualOperation   jogs, homing               PendingStop      stops and resets until they are executed
//   StartConditions   reasons of refusals        Instruments      recordings, samples, frames of the grating bus
#pragma once

#include <functional>
#include <memory>
#include <motionrack/operate/alarm_list.hpp>
#include <motionrack/operate/axis_enables.hpp>
#include <motionrack/operate/axis_handover.hpp>
#include <motionrack/operate/door.hpp>
#include <motionrack/operate/instruments.hpp>
#include <motionrack/operate/manual_access.hpp>
#include <motionrack/operate/manual_operation.hpp>
#include <motionrack/operate/pending_stop.hpp>
#include <motionrack/operate/position_setter.hpp>
#include <motionrack/operate/position_validity.hpp>
#include <motionrack/operate/program_run.hpp>
#include <motionrack/operate/service.hpp>
#include <motionrack/operate/start_conditions.hpp>
#include <motionrack/operate/status.hpp>
#include <motionrack/operate/status_publisher.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/wire_access.hpp>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::operate {

struct MachineSettings {
    /// Called in every slice on the motion thread, which processes its inbox and calls again until the result is true:
    /// virtual time may advance. It may wait a few ms. Empty: unthrottled.
    std::function<bool(Instant now)> pace = {};
    std::function<Instant()> wall = {};                 ///< wall clock for leases of jogs; empty: virtual time
    Duration jog_lease = milliseconds(250);             ///< wall-clock time after which a jog without renewal ends
    std::function<void(const Status&)> on_status = {};  ///< every slice, on the motion thread
    std::function<void(const control::gcode::CanonCall&)> on_event = {};  ///< for each event of a program
    std::vector<InitialAxisState> initial_axes = {};  ///< axes with another position than the rack file's
    std::string alarm = {};                           ///< text of an initial alarm; empty: none
    std::vector<LivePlace> live = {};                 ///< cards replaced by real ones, in service only
    Duration slice = milliseconds(2);
    Duration quiet = milliseconds(20);  ///< pause after which a sender's input counts as complete
    std::size_t max_alarms = 100;       ///< see AlarmList
};

class Machine {
  public:
    /// Builds and starts the rack. In a rack without home switches the axes start at the rack file's positions.
    /// Otherwise their positions are not valid, except those in MachineSettings::initial_axes. A rack may have no axes:
    /// programs, lines and jogs are refused then. Errors: as Rack::path_axes.
    static Result<std::unique_ptr<Machine>> make(const rack::RackConfig& config, MachineSettings settings);
    ~Machine();

    // ---- from any thread
    /// Runs `work` on the motion thread, in order and without delay.
    void post(std::function<void()> work);
    /// Ends the loop after the present slice; stops any motion first.
    void quit();

    // ---- the motion thread
    /// Runs the loop until quit().
    void run();
    /// Adds listeners, called on the motion thread: for every slice's status, and for every stop and reset with a kind,
    /// within the command. Call before run().
    void listen(std::function<void(const Status&)> call, std::function<void(const StopReport&)> on_stop = {}) {
        publisher_.listen(std::move(call), std::move(on_stop));
    }

    // ---- commands, posted; refused ones (ErrorKind::refused) change nothing
    /// Enables or disables these axes; empty: all. Disabling stops any motion first; a disabled axis is never moved.
    /// Errors: invalid_input.
    Result<void> enable(bool on, std::string_view axes = {});
    /// Checks a whole program, then starts it. Errors: invalid_input: its first problem with line and column.
    Result<void> begin_program(std::string text, std::string name);
    /// Appends one line to the pending ones. Refused: a program runs, no room (see ProgramRun::has_room).
    control::gcode::Outcome<void> line(std::string_view text, std::int32_t number);
    Result<void> hold();
    Result<void> resume();
    /// STOP command: sets the rack's stop latch. All axes decelerate and stay stopped until a reset; programs and lines
    /// are dropped. Never refused. A stop with a source is reported to stop listeners immediately, and the status names
    /// its source.
    void stop(const StopOrigin& by = {});
    /// Decelerates all motion, and drops programs and lines; needs no reset. Never refused. Reported like a stop.
    void cancel(const StopOrigin& by = {});
    /// Ends an error stop, and drops programs and modal state; work offsets and positions stay. Stops any motion.
    void reset(const StopOrigin& by = {});
    /// Switches the coolant immediately, otherwise like M7, M8 and M9. Has no effect if it would switch anything on
    /// while nothing may begin: a stop is in force, the door is open, or starts are forbidden.
    void set_coolant(bool mist, bool flood);
    /// Acknowledges an alarm, as AlarmList::acknowledge.
    bool acknowledge_alarm(std::int64_t alarm) { return alarms_.acknowledge(alarm); }
    /// Blocks starts because the machine's actions can no longer be recorded. Until the process restarts, no program,
    /// line or homing starts and nothing resumes. Motion decelerates, a program by a feed hold; jogs remain possible.
    /// The first call raises a permanent alarm.
    void forbid_starts(std::string source, std::string text);

    // ---- queries, on the motion thread
    const Status& status() const { return publisher_.status(); }
    MachineState state() const { return publisher_.state(); }
    /// Conditions for starts that are not commands of the machine, such as laser marking.
    const StartConditions& conditions() const { return conditions_; }
    /// Returns true if the position of this axis is valid.
    bool position_valid(const rack::RackAxis& axis) const { return validity_.of(axis.letter); }
    /// Settings for programs and lines: overrides, single block, work offsets.
    ProgramRun& programs() { return programs_; }
    const control::StreamExecutor& stream() const { return programs_.stream(); }
    /// Commands for jogs, homing and set positions.
    ManualOperation& manual() { return manual_; }
    /// Manual calls of a card's function library.
    Service& service() { return service_; }
    /// Manual accesses to the cards' buses.
    ManualAccess& manual_access() { return manual_access_; }
    rack::Rack& rack() { return rack_; }
    rack::WireAccess& wires() { return context_; }
    Instruments& instruments() { return instruments_; }
    Instant now() const { return rack_.kernel().now(); }

  private:
    friend class Service;
    friend class ManualAccess;
    Machine(const rack::RackConfig& config, MachineSettings settings);
    Result<void> start(const rack::RackConfig& config);
    void slice();
    void step();
    void drive();
    void failed(const Error& error);
    void enter_failures();
    void wait_for_standstill();
    void take_stop();
    void enter_error_stop(std::string source, std::string text);

    /// Failure that ends all motion.
    struct Failure {
        std::string at_work;  ///< what it has ended
        std::string text;
    };

    MachineSettings settings_;
    rack::Rack rack_;
    rack::WireAccess context_;
    Instruments instruments_{rack_};
    ProgramRun programs_;
    AxisHandover handover_{rack_, programs_};
    PositionValidity validity_;
    Door door_;
    AxisEnables enables_{rack_.config()};
    StatusPublisher publisher_{{rack_, validity_, enables_, programs_, service_}, settings_.on_status};
    AlarmList alarms_{rack_, publisher_.status().alarms, settings_.max_alarms};
    PositionSetter positions_{validity_, handover_, publisher_, alarms_};
    PendingStop pending_stop_;
    StartConditions conditions_{
        {rack_, publisher_, enables_, validity_, door_, positions_, pending_stop_, manual_access_, service_}};
    bool quit_ = false;
    bool stop_taken_ = false;        ///< the axes have received the stop of the stop latch
    bool stop_ordered_ = false;      ///< the present error stop has no other cause than a command
    std::vector<Failure> failures_;  ///< until every axis is at standstill
    std::string ordered_by_;         ///< description of the stop command in force; empty: none
    ManualOperation manual_;
    ManualAccess manual_access_{*this};
    std::mutex lock_;
    std::vector<std::function<void()>> inbox_;
    Service service_{*this};  ///< destroyed first: the stop of a real card takes time, in which slices run
};

/// Sets the work offset so that the present position of an axis has this value (touch off), as G10 L20 does; mm or
/// degrees. Refused while something moves, and as Machine::line.
Result<void> touch_off(Machine& machine, char axis, double value);
/// Returns true if an axis of this rack can be homed.
bool can_home(const rack::RackConfig& config);

}  // namespace motionrack::operate
