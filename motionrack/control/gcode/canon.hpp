// Prints what a program does as canonical calls, in the format of LinuxCNC's `rs274 -g`, so that the two can be
// compared.
//
// The motion lines (STRAIGHT_TRAVERSE, STRAIGHT_FEED, ARC_FEED, DWELL) are those of rs274 for the same program, to the
// last digit, where both take it. The other lines have rs274's format, but: modal changes are not told in COMMENT
// lines, no SET_NAIVECAM_TOLERANCE, and no calls for what this reader does not have (ON_RESET, SET_FEED_REFERENCE,
// SET_SPINDLE_MODE).
#pragma once

#include <functional>
#include <motionrack/control/gcode/program_reader.hpp>
#include <string>
#include <string_view>

namespace motionrack::control::gcode {

enum class Coordinates : std::uint8_t {
    program,  ///< as rs274: in the program's length units, less the offsets
    machine   ///< mm and degrees, machine coordinates
};

struct CanonOptions {
    Coordinates coordinates = Coordinates::program;
    bool numbered = true;  ///< with rs274's first two columns: a running number and the line's N word
};

/// Prints line by line. For each line: `interpreter.line(...)`, then `line(interpreter)`, which pulls the steps.
class CanonPrinter {
  public:
    using Put = std::function<void(std::string_view line)>;  ///< gets each line with its '\n'

    CanonPrinter(CanonOptions options, Put put) : options_(options), put_(std::move(put)) {}

    void begin(const Interpreter& interpreter);
    void line(Interpreter& interpreter);
    /// After the last line and Interpreter::finish().
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
    // After the line before; steps that waited are shown in the frame and the unit of their own line.
    Point position_ = {};
    WorkFrame frame_;
    ModalState modes_;
    bool late_ = false;  ///< the step being printed is of a line before
};

/// Prints a whole program; stops at the first problem.
Outcome<void> print_canon(std::string_view text, const Settings& settings, CanonOptions options,
                          const CanonPrinter::Put& put, const std::string& file = {});

}  // namespace motionrack::control::gcode
