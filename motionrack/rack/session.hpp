// A running rack as programs outside of it use it: by names and plain numbers, every mistake an error, nothing aborts.
//
//               ┌──► Card: bus accesses, registers by name
//               ├──► WireDesk: pins, switches
//   outside ──► Session ──► quantities, faults: the machine
//               ├──► WaveRecorder: recordings
//               └──► Kernel: time, copies, hash
//
// What the C interface (motionrack/c.h) gives to other languages; one thread at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/wave_recorder.hpp>
#include <motionrack/rack/wire_desk.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

class Session {
  public:
    /// Reads a rack file (a path, or the text itself: see read_rack), builds the rack and starts it. Errors: bad_input
    /// with everything that is wrong, a line each; io.
    static Result<std::unique_ptr<Session>> open(std::string_view path_or_text);
    ~Session();

    Rack& rack() { return rack_; }

    // ---- time
    /// Lets the world run for `ns` nanoseconds, 0 .. most_ns. Errors: refused beyond that, and beyond latest.
    Result<void> advance(std::uint64_t ns);
    std::uint64_t now_ns() const { return static_cast<std::uint64_t>(now().count()) / 10; }
    static constexpr std::uint64_t most_ns = 1'000'000'000'000'000;
    static constexpr Instant latest{never.count() / 2};

    // ---- the bus
    /// One access of the host's bus: it takes the card's bus time. `bits`: 8, 16, 32. Errors: bad_input (there is no
    /// such card), refused (the card has no accesses of that width, nothing at that address).
    Result<std::uint32_t> read(std::string_view card, int bits, std::uint32_t address);
    Result<void> write(std::string_view card, int bits, std::uint32_t address, std::uint32_t value);

    /// Lets the world run until the card's interrupt is active, for `ns` nanoseconds at most; whether it is active.
    /// Errors: bad_input (there is no such card), those of advance.
    Result<bool> wait(std::string_view card, std::uint64_t ns);

    /// A register or value of a card by its name, without effects: see Card::inspect. Takes no time. Errors: bad_input.
    Result<std::int64_t> peek(std::string_view card, std::string_view name);

    // ---- wires and parts
    /// See WireDesk.
    Result<double> wire(std::string_view name) const { return desk_.get(name); }
    Result<void> set_wire(std::string_view name, double value) { return desk_.set(name, value); }
    /// See quantities.hpp.
    Result<double> part(std::string_view part_dot_quantity);
    Result<void> set_part(std::string_view part_dot_quantity, double value);
    /// See faults.hpp.
    Result<void> fault(std::string_view fault, std::string_view target);

    // ---- the whole world
    /// A world of its own in the same state: the same calls from here on do the same in both. A recording stays with
    /// this one.
    std::unique_ptr<Session> copy();
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

    // ---- recordings
    /// Of VCD files that are begun from now on; 0: see WaveSettings::unit. Errors: refused (no unit of VCD).
    Result<void> set_trace_unit(double ns);
    /// Begins one; its name ends in .vcd or .csv. `signals`: patterns with * and ?, separated by blanks or commas;
    /// empty: all but the pins that cards drive on demand. One whose end failed is given up for it. Errors: refused
    /// (one runs already, the name's ending), bad_input (no signal fits), io.
    Result<void> start_trace(const std::string& path, std::string_view signals);
    /// Ends it. Errors: refused (none runs), io: it goes on, and what could not be written is kept for the next time.
    Result<void> stop_trace();

  private:
    explicit Session(const RackConfig& config);
    Instant now() const { return rack_.kernel().now(); }
    Result<void> room_for(Duration time) const;
    Result<Duration> time_of(std::uint64_t ns) const;
    void run_to(Instant until);
    void run_slice(Instant until);
    void look();

    Rack rack_;
    std::unique_ptr<WireTap> tap_;
    WireDesk desk_;
    std::unique_ptr<WaveRecorder> recorder_;
    Duration trace_unit_{0};
    Instant next_look_ = never;  // of the recorder at the registers
};

}  // namespace motionrack::rack
