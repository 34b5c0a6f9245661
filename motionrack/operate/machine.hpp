// A rack that people operate while it runs.
//
//   any thread ──post──► [ inbox ] ──► motion thread: Machine::run ──► Stream, axes, homing ──► cards
//                                            │ every 2 ms of virtual time: pace, inbox, picture ──► on_status
//
//   disabled ──enable──► standstill ──line, program──► moving ◄──hold, resume──► hold
//                            │  ▲ ├──jog──► jogging      │ a limit, an alarm, the emergency stop, a watchdog: from
//                            │  └─┴──home─► homing       ▼ every state, as the rack's stop latch says; stop(), too
//                            ├◄───────reset────────── error stop
//                            └──service──► service: somebody calls a card's functions, see service.hpp
//
// A reset moves nothing; what was under way is forgotten, and something new must be ordered.
//
// Only the motion thread touches the rack. What a front end posts runs there between two runs of the kernel, often in
// the middle of a drive: so orders only note what is wanted, and the motion thread's loop does it.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <motionrack/control/gcode/program_reader.hpp>
#include <motionrack/control/stream_executor.hpp>
#include <motionrack/operate/door.hpp>
#include <motionrack/operate/jogs.hpp>
#include <motionrack/operate/service.hpp>
#include <motionrack/operate/status.hpp>
#include <motionrack/operate/trust.hpp>
#include <motionrack/rack/frame_monitor.hpp>
#include <motionrack/rack/homing.hpp>
#include <motionrack/rack/periodic_sampler.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/wave_recorder.hpp>
#include <motionrack/rack/wire_access.hpp>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::operate {

struct MachineSettings {
    /// Called every slice on the motion thread, which hears what was posted and asks again until it is true: the world
    /// may run on. It waits a few ms at most. Empty: as fast as possible.
    std::function<bool(Instant now)> pace = {};
    std::function<Instant()> wall = {};  ///< the clock of the people, for leases of jogs; empty: the rack's own time
    Duration jog_lease = milliseconds(250);             ///< of that clock: a jog that was not renewed for so long ends
    std::function<void(const Status&)> on_status = {};  ///< every slice, on the motion thread
    std::function<void(const control::gcode::CanonCall&)> on_event = {};  ///< the machine passes an event of a program
    std::vector<InitialAxisState> standing = {};  ///< axes that do not begin where the rack's file says
    std::string alarm = {};                       ///< the machine begins with it, if there is one
    std::vector<LivePlace> live = {};             ///< cards for which real ones stand, in service only
    Duration slice = milliseconds(2);
    Duration quiet = milliseconds(20);  ///< a sender that has said nothing for so long has said all for now
    std::size_t max_alarms = 100;       ///< those that are over and acknowledged go, then the oldest
};

class Machine {
  public:
    /// Builds and starts the rack. Axes of a rack without any home switch stand where its file says; the others'
    /// positions are not trusted; but see `standing`. Errors: as Rack::path_axes.
    static Result<std::unique_ptr<Machine>> make(const rack::RackConfig& config, MachineSettings settings);
    ~Machine();

    // ---- from any thread
    /// Runs `work` on the motion thread, soon and in order.
    void post(std::function<void()> work);
    /// The loop ends after the present slice; motion that runs is stopped first.
    void quit();

    // ---- the motion thread
    /// Works until quit().
    void run();
    /// Somebody else who is to see every slice's status, and to hear of every stop and reset of a kind within the
    /// order; on the motion thread. Before run().
    void listen(std::function<void(const Status&)> call, std::function<void(const StopReport&)> on_stop = {}) {
        listeners_.push_back(std::move(call));
        if (on_stop) stop_listeners_.push_back(std::move(on_stop));
    }

    // ---- orders, posted; refused ones (ErrorKind::refused) change nothing
    /// These axes; empty: all. Disabling stops whatever moves first; an axis that is disabled is moved by nobody.
    /// Errors: invalid_input.
    Result<void> enable(bool on, std::string_view axes = {});
    /// Checks a program whole, then begins it. Errors: invalid_input, its first problem with line and column.
    Result<void> begin_program(std::string text, std::string name);
    /// One line, behind those that are there. Refused: a program runs, no room.
    control::gcode::Outcome<void> line(std::string_view text, std::int32_t number);
    bool has_room() const { return stream_->has_room() && !program_runs_; }
    Result<void> hold();
    Result<void> resume();
    /// The STOP order: sets the rack's stop latch, so that everything decelerates, goes off and stays so until a reset;
    /// programs and lines are forgotten. Never refused. Who listens to stops hears of one with a source at once, and
    /// the status says who it was.
    void stop(const StopOrigin& by = {});
    /// Decelerates whatever moves, and forgets programs and lines; no reset is needed afterwards. Never refused. Told
    /// as a stop is.
    void cancel(const StopOrigin& by = {});
    /// Ends an error stop and forgets programs and modes; work offsets and positions stay. Stops if something moves.
    void reset(const StopOrigin& by = {});
    /// Jogs at `speed` a second (sign: direction; 0 lets go) for as long as it is called again within the lease, and no
    /// further than to the end of its travel. Refused also: an order that is older than another one of its session, and
    /// one that only renews where the jog has ended.
    Result<void> jog(char axis, double speed, const JogOrigin& origin = {});
    /// Jogs by a distance.
    Result<void> jog_by(char axis, double distance, double speed);
    /// Jogs along a straight line in machine coordinates at `speed` along it, behind the jogs of this kind that run;
    /// cancel() ends them. Modes stay as they are. Errors: refused, also where no axis may go; invalid_input, an axis
    /// that the machine has not, or no speed.
    Result<void> jog_to(const control::Point& target, double speed);
    /// Homes these axes; empty: all that have a home switch.
    Result<void> home(std::string axes);
    /// Declares where an axis stands; it is trusted then. Refused while something moves.
    Result<void> set_position(char axis, double position);
    void set_overrides(double feed, double rapid) { stream_->set_overrides(feed_ = feed, rapid_ = rapid); }
    void set_single_step(bool on) { stream_->set_single_step(single_step_ = on); }
    /// Switches the coolant, as M7, M8 and M9 do, but at once.
    void set_coolant(bool mist, bool flood);
    /// Work offsets, G28 and G30 become 0. Refused while something moves.
    Result<void> clear_offsets();
    /// False: there is no such alarm.
    bool acknowledge(std::int64_t alarm);
    /// What the machine does can no longer be recorded: no program, line or homing is begun, and nothing held goes on,
    /// until this program is started anew. What moves decelerates, in a program with a hold; jogs are taken. Raises an
    /// alarm that stays, the first time.
    void forbid_starts(std::string source, std::string text);
    /// Errors: refused, after forbid_starts.
    Result<void> may_start(const char* what) const;
    /// What this place of an axis is called in the active work coordinates, as G10 L20 does; mm or degrees.
    Result<void> set_work_zero(char axis, double value);
    /// One access of the host to a card, done by the loop while the machine stands; `ready` hears what was read, later.
    /// A card that moves axes is not trusted after a write: they must be homed, or declared. Refused: the machine does
    /// not stand still, the access is none of this card.
    struct BusAccess {
        std::string card;
        int bits = 16;                       ///< a width of the card's bus
        std::uint32_t address = 0;           ///< on the host's bus
        std::optional<std::uint32_t> value;  ///< written; without one it is read, with all effects
    };
    Result<void> access(const BusAccess& access, std::function<void(std::uint32_t)> ready);

    // ---- looking, on the motion thread
    const Status& status() const { return status_; }
    MachineState state() const { return state_; }
    /// A stop, a reset or a declared position is not carried out yet.
    bool has_orders() const { return stop_wanted_ || !positions_wanted_.empty(); }
    /// Whether the positions of this axis mean places of the machine.
    bool position_valid(const rack::RackAxis& axis) const { return trust_.of(axis.letter); }
    double feed_override() const { return feed_; }
    double rapid_override() const { return rapid_; }
    /// How the last homing went, if there was one.
    const std::optional<rack::HomingOutcome>& last_homing() const { return homed_; }
    const control::StreamExecutor& stream() const { return *stream_; }
    Jogs& jogs() { return jogs_; }
    /// Calls of a card's function library by hand.
    Service& service() { return service_; }
    rack::Rack& rack() { return rack_; }
    rack::WireAccess& wires() { return desk_; }
    /// For recordings of pins that are driven on demand; for numbers at equal distances of time; of the grating bus, if
    /// there is one.
    rack::WireTap& tap() { return tap_; }
    rack::PeriodicSampler& probe() { return probe_; }
    const rack::FrameMonitor* frames() const { return frames_ ? &*frames_ : nullptr; }
    Instant now() const { return rack_.kernel().now(); }

  private:
    friend class Service;
    Machine(const rack::RackConfig& config, MachineSettings settings);
    Result<void> start(const rack::RackConfig& config);
    Result<void> take_group();
    Result<control::Axis*> take_axis(char letter);
    void slice();
    void step();
    void drive();
    void feed_program();
    void jog_all();
    void home_all();
    void access_bus();
    void change_positions();
    void failed(const Error& error);
    void raise(std::string source, std::string text, char axis = '\0');
    std::string at_work() const;
    void wait_for_standstill();
    void take_stop();
    void enter_error_stop(std::string source, std::string text);
    Result<void> ready(const char* what);
    Result<void> axes_may_move(const char* what, std::string_view axes) const;
    Result<void> ready_for_lines(const char* what);
    void pass_event(const control::gcode::CanonCall& step);
    void tools_off();
    void publish_status();
    void enter(MachineState state, std::string why = {});

    MachineSettings settings_;
    rack::Rack rack_;
    rack::WireAccess desk_;
    rack::WireTap tap_;
    rack::PeriodicSampler probe_;
    std::optional<rack::FrameMonitor> frames_;
    std::unique_ptr<control::StreamExecutor> stream_;
    bool group_holds_ = false;  ///< the card's axes; else each by itself
    bool hands_over_ = false;   ///< a card is being set up for the other ones: its counters mean nothing
    Trust trust_;
    Door door_;
    std::array<bool, control::axis_count> enabled_ = {}, disable_wanted_ = {};
    MachineState state_ = MachineState::disabled;
    bool quit_ = false, stop_wanted_ = false;
    std::optional<std::uint64_t> reset_wanted_;  ///< with StopLatch::trips() when it was ordered
    bool stop_taken_ = false;                    ///< what the stop latch stops was told to
    std::string no_starts_;                      ///< why nothing may be begun; empty: it may
    std::string ordered_by_;                     ///< the STOP that is in force, in words; empty: nobody gave one
    // the program, or lines one by one
    std::string program_, program_name_;
    std::optional<control::gcode::ProgramFlow> walk_;
    bool over_ = false;  ///< the last line was read, and what may wait for the next one still waits
    std::int32_t line_count_ = 0;
    bool program_runs_ = false, single_step_ = false;
    Instant last_line_{};
    double feed_ = 1, rapid_ = 1;
    // by hand
    Jogs jogs_;
    std::optional<std::string> home_wanted_;
    std::vector<Declared> positions_wanted_;  ///< until all of them are taken
    std::optional<rack::HomingOutcome> homed_;
    rack::SeenIndexes seen_indexes_;
    std::atomic<bool> home_stop_{false};
    std::vector<std::pair<BusAccess, std::function<void(std::uint32_t)>>> accesses_;
    Service service_{*this};
    // told
    Status status_;
    std::vector<std::function<void(const Status&)>> listeners_;
    std::vector<std::function<void(const StopReport&)>> stop_listeners_;
    std::int64_t next_alarm_ = 1;
    std::mutex lock_;
    std::vector<std::function<void()>> inbox_;
};

/// Its time and interrupt line, for whoever waits.
inline Interrupt& host_of(rack::Rack& rack) {
    return rack.cards().front()->host();
}
/// Some axis of this rack.
bool can_home(const rack::RackConfig& config);
/// Errors: invalid_input, beginning with `what` was not done.
Result<const rack::RackAxis*> axis_named(const rack::RackConfig& config, const char* what, char letter);

}  // namespace motionrack::operate
