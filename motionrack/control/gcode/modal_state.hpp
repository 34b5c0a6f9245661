// The modal state of a program: after the last line, with the changes of the current one, and as M70 and M73 saved it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/control/gcode/arc.hpp>
#include <motionrack/control/gcode/canon_call.hpp>
#include <optional>
#include <vector>

namespace motionrack::control::gcode {

inline constexpr std::int16_t no_motion = -1;

/// Side of the contour, seen along it from the positive third axis.
enum class CutterSide : std::uint8_t { off, left, right };

/// Numeric modal state.
struct ModalState {
    std::int16_t motion =
        no_motion;             ///< G code in tenths: 0, 10, 20, 30, 50, 51, 382 .. 385, 730 .. 890; no_motion after G80
    std::uint8_t plane = 0;    ///< 0 G17, 1 G18, 2 G19
    std::uint8_t system = 0;   ///< 0 G54 .. 5 G59, 6 G59.1 .. 8 G59.3
    bool inch = false;         ///< G20
    bool incremental = false;  ///< G91
    bool arc_absolute = false;  ///< G90.1
    bool inverse_time = false;  ///< G93
    bool retract_to_r = false;  ///< G99
    PathControl path = PathControl::continuous;
    CutterSide cutter = CutterSide::off;  ///< G40 G41 G42
    Spindle spindle = Spindle::off;
    bool mist = false;
    bool flood = false;
    bool ended = false;               ///< the program was ended by M2 or M30
    bool feed_override = true;        ///< M48, M50
    bool speed_override = true;       ///< M48, M51
    bool feed_stop = true;            ///< M53
    std::int32_t tool_selected = -1;  ///< tool selected by T; -1: none yet
    std::int32_t tool_loaded = -1;    ///< tool loaded by M6; -1: none yet
    double cutter_radius_mm = 0;      ///< radius of the compensation; used unless `cutter` is off
    double tolerance_mm = 0;
    double feed = 0;         ///< feed rate, G94: mm/s, G93: 1/s; 0: none yet
    double feed_rotary = 0;  ///< feed rate in G94 if no linear axis moves, degrees/s
    double speed_rpm = 0;
    std::uint32_t cycle_words = 0;  ///< bits of the next four words that were given since the cycle's G word
    double cycle_r = 0;             ///< R word as written, mm
    double cycle_z = 0;             ///< word of the drilling axis, as written, mm
    double cycle_q = 0;             ///< Q word (peck), mm
    double cycle_p = 0;             ///< P word (dwell), s
    PlanePoint spline_end;          ///< P and Q of the last G5, mm
    PlanePoint spline_at;           ///< end of the last G5
    double cycle_level = 0;         ///< G98: machine coordinate of the drilling axis before the first hole
};

class Modes {
  public:
    const ModalState& now() const { return now_; }  ///< modal state after the last line
    /// Returns the state after the current line; it becomes the active one when the line is valid.
    ModalState& next() { return next_; }
    const ModalState& next() const { return next_; }
    void begin_line() { next_ = now_; }
    void commit() { now_ = next_; }

    void start(double tolerance_mm, bool in_g0);
    void set_coolant(bool mist, bool flood);
    void switch_cutter_off() { now_.cutter = CutterSide::off; }
    void enable_overrides() { now_.feed_override = now_.speed_override = true; }
    /// Applies the state after M2 and M30 that Grbl and LinuxCNC reset.
    void end_program();

    /// Executes M70 (saves the modes), M71 (discards the saved ones) or M73 (saves the modes until the call ends).
    /// `level`: the call depth, 0 in the main program.
    void save(int code, std::size_t level);
    /// Returns the modes saved at this call depth; null if there are none.
    const ModalState* saved(std::size_t level) const;
    /// Restores saved modes (M72); spindle and coolant are not affected.
    void restore(const ModalState& saved);
    /// Drops the saved modes of a call that ends; returns those that M73 saved.
    std::optional<ModalState> leave_call(std::size_t level);
    /// Returns true if cutter compensation can stay on with the restored modes.
    bool can_stay_beside(const ModalState& saved) const;

  private:
    struct SavedModes {
        std::optional<ModalState> modes;
        bool comes_back = false;  ///< restored at the end of the call (M73)
    };

    ModalState now_;
    ModalState next_;
    std::vector<SavedModes> kept_;  ///< saved modes, indexed by call depth
};

}  // namespace motionrack::control::gcode
