// A running rack for external programs: names and plain numbers, an error for every mistake, no aborts.
//
//               ┌──► Card: bus accesses, registers by name
//               ├──► WireAccess: pins, switches
//   outside ──► Session ──► quantities, faults: the machine
//               ├──► Recorder: recordings
//               ├──► Job: a part program; home_axes
//               └──► Kernel: time, copies, hash ──conditions, between runs──► call-back
//
// Basis of the C interface (motionrack/c.h) for other languages; one thread at a time.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <motionrack/rack/homing.hpp>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/recorder.hpp>
#include <motionrack/rack/reported_condition.hpp>
#include <motionrack/rack/wire_access.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

/// A part program for Session::run_program.
struct ProgramRequest {
    std::string_view path_or_text;  ///< a text contains a line end; the subprograms of a file lie beside it
    std::string tools = {};         ///< path of a tool table (LinuxCNC's .tbl); empty: none
    bool block_delete = false;
    /// Called about every 50 ms of virtual time. If it returns false, the axes decelerate to a stop on the path. May be
    /// empty.
    std::function<bool(const JobProgress&)> progress = {};
};

/// Result of a part program.
struct ProgramReport {
    Result<void> ended;     ///< refused and invalid_input: nothing moved; machine: also after step loss or a breach
    TextPosition location;  ///< location of the first error
    JobOutcome outcome;     ///< valid if the program moved
    std::string sentence;   ///< all errors, one per line, or a statement of success
    std::string summary;    ///< as printed by the command line; empty if nothing moved
};

// Errors of functions that a host may call a million times per second; only the checks are inlined.
Result<void> refuse_in_a_call_back();
Result<void> refuse_time_beyond_end(Instant now);

class Session {
  public:
    /// Whether part programs may be run; if yes, the axes are monitored from the start.
    enum class Programs : std::uint8_t { no, yes };
    /// Reads a rack file (a path, or the text itself: see read_rack), builds the rack and starts it. Errors:
    /// invalid_input with all errors, one per line; io.
    static Result<std::unique_ptr<Session>> open(std::string_view path_or_text, Programs programs = Programs::no);
    ~Session();

    Rack& rack() { return rack_; }

    // ---- time
    /// Advances virtual time by `ns` nanoseconds, 0 .. max_ns. Errors: refused beyond max_ns, beyond `latest`, and by
    /// check_free.
    Result<void> advance(std::uint64_t ns);
    std::uint64_t now_ns() const { return static_cast<std::uint64_t>(now().count()) / 10; }
    static constexpr std::uint64_t max_ns = 1'000'000'000'000'000;
    static constexpr Instant latest{never.count() / 2};

    // ---- the bus
    /// One access on the host's bus; takes the card's bus access time. `bits`: 8, 16, 32. Errors: invalid_input
    /// (unknown card), refused (no accesses of that width, no register at that address, or by check_free).
    Result<std::uint32_t> read(std::string_view card, int bits, std::uint32_t address);
    Result<void> write(std::string_view card, int bits, std::uint32_t address, std::uint32_t value);

    /// For a driver with a card's own port, after each access: samples and reports as read() and write() do.
    void after_access() {
        poll();
        report_conditions();
    }

    /// Advances virtual time until the card's interrupt is active, by `ns` nanoseconds at most. Returns whether it is
    /// active. Errors: invalid_input (unknown card), those of advance.
    Result<bool> wait(std::string_view card, std::uint64_t ns);

    /// Reads a register or value of a card by name, without side effects and without virtual time: see Card::inspect.
    /// Errors: invalid_input.
    Result<std::int64_t> peek(std::string_view card, std::string_view name);

    // ---- wires and parts
    /// Reads or forces a wire: see WireAccess.
    Result<double> wire(std::string_view name) const { return context_.get(name); }
    Result<void> set_wire(std::string_view name, double value);
    /// Reads or sets a quantity: see quantities.hpp.
    Result<double> part(std::string_view part_dot_quantity);
    Result<void> set_part(std::string_view part_dot_quantity, double value);
    /// Injects a fault: see faults.hpp.
    Result<void> fault(std::string_view fault, std::string_view target);

    // ---- controller functions
    /// Runs a part program on the controller of a rack opened for programs, from the axes' present positions: see
    /// PositionReference. Checks the whole program before anything moves.
    ProgramReport run_program(const ProgramRequest& request);
    /// Homes axes: letters, optionally with blanks and commas between them; empty: all axes with a home switch. Errors
    /// (in `ended`): as home_axes, and refused by check_free.
    HomingOutcome home(std::string_view axes);

    // ---- the whole simulation
    /// Returns an independent session in the same state: equal calls have equal effects in both. A recording and the
    /// call-back of on_condition stay with the original. Errors: refused by check_free.
    Result<std::unique_ptr<Session>> copy();
    /// Hash of the state: time, cards, wires, parts, reported conditions, and the event trace of the wires. Equal
    /// states have equal hashes.
    std::uint64_t state_hash() { return rack_.kernel().state_hash(); }

    /// Returns the conditions with numbers above `since`, oldest first; the kernel stores the most recent ones.
    std::vector<ReportedCondition> conditions(std::uint64_t since);
    /// Calls `call` with each later condition, once and in order, between runs of the kernel. Time is that of the event
    /// that reported it; during a program or homing it may be up to 50 ms later. Empty: ends the calls.
    void on_condition(std::function<void(const ReportedCondition&)> call);
    /// Errors: refused within a call-back (of on_condition, or of a program's progress) of a function that advances
    /// time.
    Result<void> check_free() const {
        if (!telling_ && !driving_) return {};
        return refuse_in_a_call_back();
    }

    // ---- recordings
    /// Sets the time unit of later VCD files; 0: see WaveFile::unit. Errors: refused (not a VCD unit).
    Result<void> set_trace_unit(double ns);
    /// Starts a recording; its name ends in .vcd, .csv or .h5. `signals`: patterns with * and ?, separated by blanks or
    /// commas; empty: all signals except the pins that cards drive on demand. `version`: version of the recording
    /// program. Discards a recording that could not be ended. Errors: refused (already recording, the name's ending),
    /// invalid_input (no matching signal), io.
    Result<void> start_trace(const std::string& path, std::string_view signals, std::string_view version = {});
    /// Returns true while a recording is active or could not be ended.
    bool is_recording() const { return recorder_ != nullptr; }
    /// Ends the recording. Errors: refused (no recording); io: the recording continues and keeps the unwritten data for
    /// a retry; an .h5 file, and one of which more was dropped than a buffer keeps, is lost.
    Result<void> stop_trace();

  private:
    Session(const RackConfig& config, Programs programs);
    std::unique_ptr<Job> make_job(Programs programs);
    Instant now() const { return rack_.kernel().now(); }
    Result<void> check_time_left(Duration time) const {
        if (now() <= latest - time) return {};
        return refuse_time_beyond_end(now());
    }
    Result<Duration> time_of(std::uint64_t ns) const;
    void run_to(Instant until);
    void poll();
    void drop_recorder();
    void between();
    void report_conditions();
    std::uint64_t condition_count() const;
    Result<control::gcode::Settings> read_program(const ProgramRequest& request, std::string& name);
    Result<void> drive_program(const ProgramRequest& request, ProgramReport& report);

    Rack rack_;
    std::unique_ptr<Job> job_;  // nullptr: no programs
    std::string program_;       // text of the last program
    std::atomic<bool> stop_{false};
    std::function<bool(const JobProgress&)> progress_;
    std::function<void(const ReportedCondition&)> on_condition_;
    std::uint64_t reported_ = 0;  // conditions reported
    bool telling_ = false;        // the call-back is running
    bool driving_ = false;        // a program or homing is running
    std::unique_ptr<RecorderTap> tap_;
    WireAccess context_;
    std::unique_ptr<Recorder> recorder_;
    Duration trace_unit_{0};
    Instant next_poll_ = never;  // next sampling of the registers by the recorder; never without a recorder
};

}  // namespace motionrack::rack
