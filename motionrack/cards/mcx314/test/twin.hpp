// The MCX314 tick by tick: simple, slow and evidently correct, written from RULES.md alone. It is the oracle of the
// event-driven model's tests and the baseline of the benchmarks.
//
//     write / read            tick n: 1 inputs ─► 2 pulse ─► 3 speed, for every driving generator
//     set_input                       (an access at the instant of tick n comes after it)
//
// One tick is 125 ns (SCLK = 8 MHz).
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/mcx314/chip/options.hpp>
#include <motionrack/cards/mcx314/test/twin_extension.hpp>
#include <motionrack/cards/mcx314/test/twin_path.hpp>
#include <motionrack/cards/mcx314/test/twin_pattern.hpp>
#include <vector>

namespace motionrack::mcx314::twin {

constexpr bool bit(std::uint16_t value, int n) {
    return (value >> n & 1) != 0;
}

inline constexpr int axis_count = 4;

/// A pulse: the tick of its active edge, the axis 0..3 and the direction +1 or -1.
struct Pulse {
    std::int64_t tick = 0;
    int axis = 0;
    int direction = 0;
    friend bool operator==(const Pulse&, const Pulse&) = default;
};

/// The parameter registers as written: truncated to their width, but not limited to their range.
struct Parameters {
    std::uint32_t range = 0, jerk = 0, decel_jerk = 0, accel = 0, decel = 0, start_speed = 0, speed = 0;
    std::uint32_t pulses = 0, decel_point = 0, centre = 0, offset = 8;
};

/// A running generator.
struct Generator {
    enum class Kind : std::uint8_t { idle, fixed, continuous, path };
    enum class Phase : std::uint8_t { increasing, constant, decreasing };
    Kind kind = Kind::idle;
    int wait = 0;  ///< ticks until the generator's first working tick
    bool manual = false, own_decel = false, s_curve = false;
    std::int64_t range = 0, range_now = 0;
    std::int64_t acc = 0, speed = 0, speed_part = 0;        ///< acc, CV and va of RULES.md
    std::int64_t rate = 0, rate_part = 0, lower_rates = 0;  ///< CA and ja of RULES.md; 0 + 1 + .. + (CA - 1)
    std::int64_t aim = 0, n = 0, accel_pulses = 0;
    int ramp = 0;
    Phase phase = Phase::increasing;
    bool final = false, final_seen = false, stopping = false, constant = false;
    bool no_triangle = false;
    bool ask_decelerating = false, ask_immediate = false;  ///< commands 26h and 27h, applied at the next working tick
};

/// One axis: its registers, counters, inputs and generator.
struct Axis {
    Parameters reg;
    std::uint16_t wr1 = 0, wr2 = 0, wr3 = 0;
    std::int32_t lp = 0, ep = 0, comp_plus = 0, comp_minus = 0;
    int direction = +1;
    std::uint16_t causes = 0;    ///< stop causes of the running drive, RR1 D8-D15
    std::uint16_t finished = 0;  ///< stop causes of finished drives, RR1 D8-D15
    std::uint16_t flags = 0;     ///< interrupt flags, RR3
    unsigned compared = 0;       ///< previous results of the four comparisons, in the bits of RR3
    bool waits_position = false;
    std::array<bool, 2> lines{true, true}, heard{true, true};  ///< encoder lines A and B, and their counted levels
    std::array<int, 2> low{3, 3};                              ///< ticks, up to 3, since nEXPP, nEXPM were seen High
    std::int64_t pulse_end = 0;                                ///< tick at which the last pulse on its wire ends
    int pulse_direction = +1;
    int external = -1;  ///< number of the input (0 nEXPP, 1 nEXPM) that drives the axis until it is High; -1: none
    bool hold = false;
    int held_command = 0;
    Segment held_segment;
    std::array<bool, pin_count> pin{true, true, true, true, true, true, true, true, true, true};
    Generator gen;
    Extension as;

    /// Returns the level of an input as the chip sees it.
    bool level(Pin which) const {
        const auto i = static_cast<std::size_t>(which);
        return as.filters(which) ? as.filter[i].out : pin[i];
    }
};

class Twin {
  public:
    explicit Twin(const ChipOptions& options = {});

    /// Accesses a register by its byte offset 0, 2, .. 14; an access comes after the last tick and before the next.
    void write(std::uint32_t offset, std::uint16_t value);
    void write_byte(std::uint32_t port, std::uint8_t value);
    std::uint8_t read_byte(std::uint32_t port);
    std::uint16_t read(std::uint32_t offset);
    std::uint16_t peek(std::uint32_t offset) const;

    /// Set the level of an input. It applies from the next tick on, in the status registers at once.
    void set_input(int axis, Pin pin, bool level) { axes_[axis].pin[static_cast<int>(pin)] = level; }
    void set_emergency(bool level) { emgn_ = level; }
    void set_step(bool level) { expls_ = level; }
    /// Sets encoder line 0 (A) or 1 (B); hear_encoders() counts once all wires of the instant are set.
    void set_encoder(int axis, int line, bool level) { axes_[axis].lines[line] = level; }
    void hear_encoders();

    void tick();
    void run(std::int64_t ticks) {
        for (; ticks > 0; --ticks) tick();
    }

    std::int64_t now() const { return now_; }
    const Axis& axis(int a) const { return axes_[a]; }
    bool driving(int a) const {
        return axes_[a].gen.kind != Generator::Kind::idle || (chain_ >> a & 1) != 0 || axes_[a].as.hmst != 0;
    }
    /// Returns n-DRV of RR0.
    bool busy(int a) const;
    /// Returns the level of the pin nDRIVE.
    bool drive_output(int a) const;
    bool any_driving() const;
    /// Returns the net pulses of an axis since the start, + minus -.
    std::int64_t count(int a) const { return count_[a]; }
    /// Returns the pulses of both directions since the start.
    std::int64_t made(int a) const { return made_[a]; }
    /// Returns true if an interrupt is requested (INTN Low).
    bool interrupt() const;
    /// Returns the levels of the output pins: nPP, nPM, nOUT4..7, nOUT0..3, nDRIVE.
    unsigned outputs(int a) const { return outputs(a, now_ < axes_[a].pulse_end); }
    /// Returns the same levels without a pulse.
    unsigned outputs_at_rest(int a) const { return outputs(a, false); }
    /// Returns the number of conditions since the start: ignored commands, and patterns whose data ran out.
    std::uint64_t conditions() const { return conditions_; }

    /// Switches the recording of pulses on or off; initially it is on.
    void record(bool on) { recording_ = on; }
    const std::vector<Pulse>& pulses() const { return pulses_; }

  private:
    // twin.cpp: the tick
    void work(int a);
    bool inputs(int a);
    std::uint16_t active_inputs(const Axis& axis, bool& decelerating, bool& immediate) const;
    bool beyond_software_limit(const Axis& axis) const;
    bool stop(int a, bool decelerating, bool immediate);
    bool pulse(int a);
    void show_pulse(int a);
    int step_axes(int a);
    int step_pattern();
    void next_word();
    void look_ahead();
    bool path_finished() const;
    void move(int a, int direction);
    bool segment_end(int a);
    void check_final(int a);
    void check_final_of_path();
    void end(int a);
    void compare(int a);
    bool moves_with(int a, int other) const;
    void begin_segment(const Segment& segment);

    // twin_wires.cpp: wires that request drives and steps
    void look_at_wires();
    void look_at_external(int a);
    void look_at_wheel(int a);
    void write_wr3(Axis& axis, std::uint16_t value);
    bool ask_step(Segment::Steps by);
    bool by_steps(int a) const;
    bool halted(int a) const { return by_steps(a) && !step_under_way_; }

    // MCX314As only. twin_extension.cpp
    bool extended_command(int code, unsigned axes);
    void extended_write(int code, int a);
    void sample();
    std::int32_t next_count(const Axis& axis, std::int32_t counter, int direction) const;
    void set_lp(Axis& axis, std::uint32_t value);
    void set_ep(Axis& axis, std::uint32_t value);
    void ask_clear(Axis& axis);
    bool emergency_level() const { return axes_[0].as.em6 & 0x100 ? emergency_filter_.out : emgn_; }
    bool weighs(const Axis& axis) const;
    std::int64_t final_pulses(const Axis& axis) const;
    void avoid_triangle(Axis& axis);
    // twin_home.cpp
    void start_home(int a);
    void begin_home_step(int a, int step);
    void go_home(int a, int hmst);
    bool home_input(const Axis& axis, int step) const;
    bool at_limit(const Axis& axis, int direction) const;
    bool home_stops(Axis& axis);
    void look_at_home(int a);
    void finish_home(int a);
    void end_home(int a);
    // twin_sync.cpp
    void note(int a, unsigned condition);
    void act_together();
    void act_alone(int a);

    // twin_speed.cpp: the speed step
    bool speed_step(int a);
    std::int64_t target(int a) const;
    std::int64_t drive_speed(const Axis& axis) const;
    void t_curve(int a);
    void s_curve(int a);
    void s_turn_final(int a);
    void s_advance(int a);
    void set_ramp(int a, int ramp);

    // twin_bus.cpp: registers and commands; twin_status.cpp: what they show
    void write_register(std::uint32_t offset, std::uint16_t value, std::uint16_t mask);
    void command(std::uint16_t value);
    void pattern_command(int code);
    void data_write(int code, Axis& axis);
    void data_read(int code, const Axis& axis);
    void drive_command(int code, unsigned axes);
    void start_drive(int a, int code);
    void path_command(int code);
    void start_path(const Segment& segment);
    Segment captured(int code) const;
    bool any_busy(const Segment& segment) const;
    void begin_generator(int a, Generator::Kind kind);
    void free_held(unsigned axes);
    void ask_stop(unsigned axes, bool immediate);
    void reset();
    int selected() const;
    unsigned outputs(int a, bool pulse) const;
    std::uint16_t main_status() const;
    std::uint16_t status1(int a) const;
    std::uint16_t status2(int a) const;
    std::uint16_t levels(int a) const;

    const ChipOptions options_;
    const bool extended_;
    std::array<Axis, axis_count> axes_;
    std::array<std::int64_t, axis_count> count_{}, made_{};
    std::int64_t now_ = 0;
    bool emgn_ = true;
    Filter emergency_filter_, step_filter_;
    unsigned selected_ = 1;
    std::uint16_t wr4_ = 0, wr5_ = 0, wr6_ = 0, wr7_ = 0, rr6_ = 0, rr7_ = 0;
    // The interpolation: axes of its chain (0: none), generator, running and queued segment.
    unsigned chain_ = 0;
    int master_ = 0;
    Path path_;
    bool queued_ = false;
    Segment queue_;
    std::array<std::int64_t, 3> path_range_{};  // Rnow when one, two, three axes step
    int path_stepped_ = 1;                      // axes stepped in the last pulse
    bool decel_enabled_ = false;
    bool path_interrupt_ = false;
    Pattern pattern_;
    bool step_under_way_ = false;
    bool expls_ = true;
    int expls_low_ = 0;  // ticks, up to 3, since EXPLSN was seen High
    std::uint8_t wr0_high_ = 0;
    std::uint64_t conditions_ = 0;
    bool recording_ = true;
    std::vector<Pulse> pulses_;
};

/// Returns a register's value as the generator uses it: limited to its documented range.
constexpr std::int64_t used(std::uint32_t written, std::int64_t low, std::int64_t high) {
    return written < low ? low : written > high ? high : written;
}
constexpr std::int64_t used_range(const Parameters& p) {
    return used(p.range, 16'000, 16'777'215);
}
constexpr std::int64_t used_speed(const Parameters& p) {
    return used(p.speed, 1, 8'000);
}
constexpr std::int64_t used_start_speed(const Parameters& p) {
    return used(p.start_speed, 1, 8'000);
}
constexpr std::int64_t used_accel(const Parameters& p) {
    return used(p.accel, 1, 8'000);
}
constexpr std::int64_t used_decel(const Parameters& p) {
    return used(p.decel, 1, 8'000);
}
constexpr std::int64_t used_jerk(std::uint32_t jerk) {
    return used(jerk, 1, 65'535);
}

}  // namespace motionrack::mcx314::twin
