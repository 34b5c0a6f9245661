// Wires and values over time as a VCD file (IEEE 1364, clause 18), for GTKWave, PulseView, sigrok-cli and similar
// tools.
//
//     MOTIONRACK_TRY(VcdWriter vcd, VcdWriter::create("run.vcd"));
//     vcd.push_scope("x");
//     const auto step = vcd.add_wire("step");
//     vcd.pop_scope();
//     vcd.change(step, 1, microseconds(5));
//     MOTIONRACK_CHECK(vcd.close(milliseconds(1)));
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/disk/new_file.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::trace {

struct VcdSettings {
    /// Time unit of the file: 1, 10 or 100 of ps (from 100 ps), ns, us, ms, or 1 s. Changes within one unit keep their
    /// order and share its time. sigrok and PulseView sample at the timescale: 1 s of 100 ps is 1e10 samples. Read such
    /// a file with `sigrok-cli -I vcd:downsample=1000` (100 ns per sample), or write 100 ns at once. Otherwise
    /// reading takes more than a minute. 125 ns is not a VCD timescale; 1 ns represents its edges exactly.
    Duration timescale{1};
    /// Writes "x_step" instead of "step" for a wire of scope x: sigrok and PulseView show the last name only.
    bool full_names = false;
    std::string comment;  ///< stored in the head of the file
};

/// Errors: refused if VCD does not support this time unit.
Result<void> check_unit(Duration unit);

/// Writes one VCD file. Declare everything first; the first change ends the declarations. The file contains no date, so
/// that equal changes give equal bytes. Changes do not allocate after the buffer exists; they are written to disk in
/// blocks of 256 KiB. A write error (disk full) stops writing; close() reports it.
class VcdWriter {
  public:
    using Id = std::uint32_t;

    /// Errors: refused (timescale), io (the file cannot be created).
    static Result<VcdWriter> create(const std::string& path, const VcdSettings& settings = {});

    VcdWriter(VcdWriter&& other) noexcept;
    VcdWriter& operator=(VcdWriter&& other) noexcept;
    VcdWriter(const VcdWriter&) = delete;
    VcdWriter& operator=(const VcdWriter&) = delete;
    ~VcdWriter();

    /// Converts names to letters, digits and '_', which every reader accepts: '+' becomes 'p', '-' 'm', any other
    /// character '_'. A duplicate name in its scope gets "_2", "_3".
    void push_scope(std::string_view name);
    void pop_scope();
    Id add_wire(std::string_view name, bool initial = false);
    Id add_vector(std::string_view name, int bits, std::uint64_t initial = 0);  ///< bits: 1 .. 64; higher bits are cut
    Id add_real(std::string_view name, double initial = 0);

    /// Sets a new value of the wire or vector; writes nothing if it is unchanged. `at` must not precede an earlier
    /// change.
    void change(Id id, std::uint64_t value, Instant at);
    /// As change() for reals; skips NaN and infinities, which VCD cannot represent.
    void change_real(Id id, double value, Instant at);

    /// Bytes so far, including the buffer.
    std::uint64_t bytes() const { return file_.written() + used_; }
    const std::string& path() const { return path_; }

    /// Ends the file at `end` (not before the last change), so that viewers show the time after the last change.
    /// Errors: io, the first error; if only the end is missing, writing can continue and close() can be called again.
    /// If a writer is destroyed without close(), its changes stay in `NAME.incomplete`.
    Result<void> close(Instant end);
    /// Returns true after a write error with data omitted: the file cannot be completed.
    bool gave_up() const { return gave_up_; }

  private:
    enum class VariableKind : std::uint8_t { wire, vector, real };
    struct Variable {
        std::uint64_t value;  ///< bits of a real
        char code[6];
        std::uint8_t code_length;
        std::uint8_t bits;
        VariableKind kind;
    };

    VcdWriter() = default;
    Id declare(std::string_view name, VariableKind kind, int bits, std::uint64_t value);
    std::string unique_name(std::string_view name);
    void end_declarations();
    void put(std::string_view text);
    void put_value(const Variable& variable);
    void reserve(std::size_t bytes);
    void flush();
    void write_out();
    void advance(Instant at);
    void put_time(std::int64_t units);

    std::string path_;
    disk::NewFile file_;
    bool gave_up_ = false;  ///< bytes were dropped: the file cannot be completed
    std::int64_t timescale_ = 1;
    std::vector<Variable> variables_;
    std::vector<std::set<std::string>> names_;  ///< names of each open scope
    std::vector<std::string> scopes_;           ///< open scopes
    bool full_names_ = false;
    std::vector<char> buffer_;
    std::size_t used_ = 0;
    bool declaring_ = true;
    Instant now_{0};
    std::int64_t unit_ = -1;  ///< last written time
    Instant unit_end_{0};     ///< changes before this share it
    std::int64_t high_ = -1;  ///< unit_ / 1e8, whose text is high_text_
    char high_text_[24] = {};
    std::size_t high_length_ = 0;
};

}  // namespace motionrack::trace
