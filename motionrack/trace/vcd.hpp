// Wires and values over time as a VCD file (IEEE 1364, clause 18), for GTKWave, PulseView, sigrok-cli and the like.
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
    /// What one unit of the file's time is: 1, 10 or 100 of ps (from 100 ps), ns, us, ms, or 1 s. Changes inside one
    /// unit keep their order and share its time. sigrok and PulseView sample at the timescale, and 1 s of 100 ps is
    /// 1e10 samples: let them read such a file with `sigrok-cli -I vcd:downsample=1000` (100 ns a sample; without it
    /// it takes more than a minute), or write 100 ns at once. 125 ns is no VCD timescale; 1 ns holds its edges exactly.
    Duration timescale{1};
    /// "x_step" instead of "step" for a wire of the scope x: sigrok and PulseView show the last name only.
    bool full_names = false;
    std::string comment;  ///< goes into the head of the file
};

/// Errors: refused, for a unit of time that VCD files do not have.
Result<void> check_unit(Duration unit);

/// Writes one VCD file. Declare everything first; the first change ends the declarations. The file holds no date, so
/// the same changes give the same bytes. Once the buffer is there changes do not allocate; they write to the disk
/// whenever 256 KiB have come together. A write error (disk full) stops the writing and is told by close.
class VcdWriter {
  public:
    using Id = std::uint32_t;

    /// Errors: refused (timescale), io (the file cannot be made).
    static Result<VcdWriter> create(const std::string& path, const VcdSettings& settings = {});

    VcdWriter(VcdWriter&& other) noexcept;
    VcdWriter& operator=(VcdWriter&& other) noexcept;
    VcdWriter(const VcdWriter&) = delete;
    VcdWriter& operator=(const VcdWriter&) = delete;
    ~VcdWriter();

    /// Names become letters, digits and '_', as every reader takes them; '+' becomes 'p', '-' 'm', anything else '_'. A
    /// name that is there already in its scope gets "_2", "_3".
    void push_scope(std::string_view name);
    void pop_scope();
    Id add_wire(std::string_view name, bool initial = false);
    Id add_vector(std::string_view name, int bits, std::uint64_t initial = 0);  ///< bits: 1 .. 64; higher bits are cut
    Id add_real(std::string_view name, double initial = 0);

    /// The wire or vector has a new value; nothing is written if it is the one it has. `at` must not lie before an
    /// earlier change.
    void change(Id id, std::uint64_t value, Instant at);
    /// The same for reals; NaN and infinities have no VCD form and are left out.
    void change_real(Id id, double value, Instant at);

    /// Bytes handed over so far, those in the buffer included.
    std::uint64_t bytes() const { return file_.written() + used_; }
    const std::string& path() const { return path_; }

    /// Ends the file at `end` (not before the last change), so that viewers show the time after the last change.
    /// Errors: io, the first error met; if only the end is missing it can go on and be closed again. The changes of a
    /// writer that is destroyed unclosed stay in `NAME.new`.
    Result<void> close(Instant end);

  private:
    enum class Kind : std::uint8_t { wire, vector, real };
    struct Variable {
        std::uint64_t value;  ///< of a real: its bits
        char code[6];
        std::uint8_t code_length;
        std::uint8_t bits;
        Kind kind;
    };

    VcdWriter() = default;
    Id declare(std::string_view name, Kind kind, int bits, std::uint64_t value);
    std::string unique_name(std::string_view name);
    void end_declarations();
    void put(std::string_view text);
    void put_value(const Variable& variable);
    void room(std::size_t bytes);
    void flush();
    void write_out();
    void advance(Instant at);
    void put_time(std::int64_t units);

    std::string path_;
    disk::NewFile file_;
    bool gave_up_ = false;  ///< bytes were left out: the file cannot become whole
    std::int64_t timescale_ = 1;
    std::vector<Variable> variables_;
    std::vector<std::set<std::string>> names_;  ///< those of each open scope
    std::vector<std::string> scopes_;           ///< the open scopes
    bool full_names_ = false;
    std::vector<char> buffer_;
    std::size_t used_ = 0;
    bool declaring_ = true;
    Instant now_{0};
    std::int64_t unit_ = -1;  ///< time last written
    Instant unit_end_{0};     ///< changes before this share it
    std::int64_t high_ = -1;  ///< unit_ / 1e8, whose text is high_text_
    char high_text_[24] = {};
    std::size_t high_length_ = 0;
};

}  // namespace motionrack::trace
