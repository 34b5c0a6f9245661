// A running rack as programs outside of it use it: by names and plain numbers, every mistake an error, nothing aborts.
//
//               ┌──► Card: bus accesses, registers by name
//               ├──► WireAccess: pins, switches
//   outside ──► Session ──► quantities, faults: the machine
//               ├──► WaveRecorder: recordings
//               ├──► Job: a part program; home_axes
//               └──► Kernel: time, copies, hash ──conditions, between runs──► call-back
//
// What the C interface (motionrack/c.h) gives to other languages; one thread at a time.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <motionrack/rack/homing.hpp>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/wave_recorder.hpp>
#include <motionrack/rack/wire_access.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

/// A part program for Session::run_program.
struct ProgramOrder {
    std::string_view path_or_text;  ///< a text has a line end in it; subprograms lie beside a file
    std::string tools = {};         ///< path of a tool table (LinuxCNC's .tbl); empty: none
    bool block_delete = false;
    /// About every 50 ms of virtual time; false: the axes come to rest along the path. May be empty.
    std::function<bool(const JobProgress&)> progress = {};
};

/// What came of it.
struct ProgramReport {
    Result<void> ended;  ///< refused and invalid_input: nothing moved; machine: also where something was lost or broken
    Place place;         ///< of the first error
    JobOutcome outcome;  ///< where it moved
    std::string sentence;  ///< all that was wrong, a line each; or that it ended well
    std::string summary;   ///< as the command line prints it; empty where nothing moved
};

// The two refusals of calls that a host makes a million times a second; the checks before them are inlined.
Result<void> refuse_in_a_call_back();
Result<void> refuse_time_beyond_end(Instant now);

class Session {
  public:
    /// Whether part programs will be run: the axes are watched from the start then.
    enum class Programs : std::uint8_t { no, yes };
    /// Reads a rack file (a path, or the text itself: see read_rack), builds the rack and starts it. Errors:
    /// invalid_input with everything that is wrong, a line each; io.
    static Result<std::unique_ptr<Session>> open(std::string_view path_or_text, Programs programs = Programs::no);
    ~Session();

    Rack& rack() { return rack_; }

    // ---- time
    /// Lets the world run for `ns` nanoseconds, 0 .. max_ns. Errors: refused beyond that, beyond latest, and by
    /// check_free.
    Result<void> advance(std::uint64_t ns);
    std::uint64_t now_ns() const { return static_cast<std::uint64_t>(now().count()) / 10; }
    static constexpr std::uint64_t max_ns = 1'000'000'000'000'000;
    static constexpr Instant latest{never.count() / 2};

    // ---- the bus
    /// One access of the host's bus: it takes the card's bus time. `bits`: 8, 16, 32. Errors: invalid_input (there is
    /// no such card), refused (the card has no accesses of that width, nothing at that address; see check_free).
    Result<std::uint32_t> read(std::string_view card, int bits, std::uint32_t address);
    Result<void> write(std::string_view card, int bits, std::uint32_t address, std::uint32_t value);

    /// Lets the world run until the card's interrupt is active, for `ns` nanoseconds at most; whether it is active.
    /// Errors: invalid_input (there is no such card), those of advance.
    Result<bool> wait(std::string_view card, std::uint64_t ns);

    /// A register or value of a card by its name, without effects: see Card::inspect. Takes no time. Errors:
    /// invalid_input.
    Result<std::int64_t> peek(std::string_view card, std::string_view name);

    // ---- wires and parts
    /// See WireAccess.
    Result<double> wire(std::string_view name) const { return desk_.get(name); }
    Result<void> set_wire(std::string_view name, double value);
    /// See quantities.hpp.
    Result<double> part(std::string_view part_dot_quantity);
    Result<void> set_part(std::string_view part_dot_quantity, double value);
    /// See faults.hpp.
    Result<void> fault(std::string_view fault, std::string_view target);

    // ---- what a controller does
    /// Runs a part program on the controller of a rack that was opened for programs, from where the axes stand: see
    /// PositionReference. What is wrong in it is found before anything moves.
    ProgramReport run_program(const ProgramOrder& order);
    /// Homes axes: letters, with blanks and commas between them or not; empty: all that have a home switch. Errors (in
    /// `ended`): as home_axes, and refused by check_free.
    HomingOutcome home(std::string_view axes);

    // ---- the whole world
    /// A world of its own in the same state: the same calls from here on do the same in both. A recording and the
    /// call-back of on_condition stay with this one. Errors: refused by check_free.
    Result<std::unique_ptr<Session>> copy();
    /// Equal worlds, equal hash: time, cards, wires, parts, conditions told, and the history of the wires.
    std::uint64_t state_hash() { return rack_.kernel().state_hash(); }

    /// What happened, as a sentence.
    struct Told {
        std::uint64_t number = 0;  ///< from 1
        Instant at{};
        std::string device;  ///< a card's name, or of what else it happened to
        int code = 0;        ///< of this kind of device
        std::string sentence;
    };
    /// Those with numbers above `since`, oldest first; the kernel keeps the last ones.
    std::vector<Told> conditions(std::uint64_t since);
    /// Calls `call` with each condition from now on, once and in their order, between runs of the kernel: time stands
    /// at the event that reported it; in a program or a homing at most 50 ms later. Empty: no more.
    void on_condition(std::function<void(const Told&)> call);
    /// Errors: refused: this is a call-back (of on_condition, of a program's progress) in the middle of what lets time
    /// pass.
    Result<void> check_free() const {
        if (!telling_ && !driving_) return {};
        return refuse_in_a_call_back();
    }

    // ---- recordings
    /// Of VCD files that are begun from now on; 0: see WaveSettings::unit. Errors: refused (no unit of VCD).
    Result<void> set_trace_unit(double ns);
    /// Begins one; its name ends in .vcd, .csv or .h5. `signals`: patterns with * and ?, separated by blanks or commas;
    /// empty: all but the pins that cards drive on demand. `version`: of the program that records. One whose end failed
    /// is given up for it. Errors: refused (one runs already, the name's ending), invalid_input (no signal fits), io.
    Result<void> start_trace(const std::string& path, std::string_view signals, std::string_view version = {});
    /// One runs, or could not be ended.
    bool is_recording() const { return recorder_ != nullptr; }
    /// Ends it. Errors: refused (none runs), io: it goes on, and what could not be written is kept for the next time;
    /// an .h5 file is lost.
    Result<void> stop_trace();

  private:
    Session(const RackConfig& config, Programs programs);
    std::unique_ptr<Job> make_job(Programs programs);
    Instant now() const { return rack_.kernel().now(); }
    Result<void> room_for(Duration time) const {
        if (now() <= latest - time) return {};
        return refuse_time_beyond_end(now());
    }
    Result<Duration> time_of(std::uint64_t ns) const;
    void run_to(Instant until);
    void look();
    void between();
    void tell_conditions();
    std::uint64_t condition_count() const;
    Result<control::gcode::Settings> read_program(const ProgramOrder& order, std::string& name);
    Result<void> drive_program(const ProgramOrder& order, ProgramReport& report);

    Rack rack_;
    std::unique_ptr<Job> job_;  // may be nullptr: no programs
    std::string program_;       // the text of the last one
    std::atomic<bool> stop_{false};
    std::function<bool(const JobProgress&)> progress_;
    std::function<void(const Told&)> on_condition_;
    std::uint64_t told_ = 0;  // conditions that it has heard of
    bool telling_ = false;    // it is being called
    bool driving_ = false;    // a program or a homing runs
    std::unique_ptr<WireTap> tap_;
    WireAccess desk_;
    std::unique_ptr<WaveRecorder> recorder_;
    Duration trace_unit_{0};
    Instant next_look_ = never;  // of the recorder at the registers
};

}  // namespace motionrack::rack
