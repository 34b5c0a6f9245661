// Prints a program as canonical calls, in the format of LinuxCNC's `rs274 -g`, so that the two can be compared.
//
// The motion lines (STRAIGHT_TRAVERSE, STRAIGHT_FEED, ARC_FEED, DWELL) equal those of rs274 to the last digit for every
// program that both accept. The other lines have the rs274 format with three exceptions: no modal changes in COMMENT
// lines, no SET_NAIVECAM_TOLERANCE, and no calls for missing features (ON_RESET, SET_FEED_REFERENCE, SET_SPINDLE_MODE).
#pragma once

#include <functional>
#include <motionrack/control/gcode/program_reader.hpp>
#include <string>
#include <string_view>

namespace motionrack::control::gcode {

enum class Coordinates : std::uint8_t {
    program,  ///< as rs274: in the length units of the program, without the offsets
    machine   ///< mm and degrees, machine coordinates
};

struct CanonOptions {
    Coordinates coordinates = Coordinates::program;
    bool numbered = true;  ///< prints the first two columns of rs274: a running number and the N word
};

/// Prints line by line. For each line call `interpreter.line(...)`, then `line(interpreter)`, which pulls the calls.
class CanonPrinter {
  public:
    using Put = std::function<void(std::string_view line)>;  ///< receives each line with its '\n'

    CanonPrinter(CanonOptions options, Put put) : options_(options), put_(std::move(put)) {}

    void begin(const Interpreter& interpreter);
    void line(Interpreter& interpreter);
    /// Prints the remaining calls after the last line and Interpreter::finish().
    void rest(Interpreter& interpreter);

  private:
    void call(std::string_view text);
    void event(const CanonCall& step, const Interpreter& interpreter);
    void move(const Move& move, const Interpreter& interpreter);
    void probe(const Move& move, const Interpreter& interpreter);
    void here(const Interpreter& interpreter);
    void note(const Interpreter& interpreter);
    void feed(const Interpreter& interpreter);
    void feed_rate(const ModalState& now);
    void modes(const Interpreter& interpreter);
    void print_restored_modes(const Interpreter& interpreter);
    void units(const ModalState& now);
    void plane(const ModalState& now);
    void system(const Interpreter& interpreter);
    void shift(const Interpreter& interpreter);
    void turn(const Interpreter& interpreter);
    void overrides(std::int32_t code, bool on);
    void output(const CanonCall& step);
    void path(PathControl path, double tolerance_mm, const Interpreter& interpreter);
    Point shown(const Interpreter& interpreter, const Point& machine) const;

    CanonOptions options_;
    Put put_;
    std::int64_t count_ = 0;
    std::int64_t n_word_ = -1;
    PathControl path_ = PathControl::continuous;
    // State after the previous line; calls that waited are printed in the frame and unit of their own line.
    Point position_ = {};
    WorkFrame frame_;
    ModalState modes_;
    bool late_ = false;  ///< the current call belongs to an earlier line
};

/// Prints a whole program; stops at the first error.
Outcome<void> print_canon(std::string_view text, const Settings& settings, CanonOptions options,
                          const CanonPrinter::Put& put, const std::string& file = {});

}  // namespace motionrack::control::gcode
