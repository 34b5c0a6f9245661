// The state of the card except its lists and tables. Every member has 8 bytes (or comes in pairs), so no padding enters
// a snapshot's hash. A part that keeps values at a reset has its own reset(); the others get their initial values.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/rtc5/map.hpp>
#include <motionrack/cards/rtc5/model/settings.hpp>
#include <string_view>

namespace motionrack::rtc5 {

struct Point {
    double x = 0, y = 0;
    friend constexpr Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
    friend constexpr Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
};

/// Bounding box of positions in bits; initially empty.
struct PlanExtent {
    double min_x = std::numeric_limits<double>::infinity(), max_x = -std::numeric_limits<double>::infinity();
    double min_y = std::numeric_limits<double>::infinity(), max_y = -std::numeric_limits<double>::infinity();

    bool empty() const { return !(min_x <= max_x); }
    void take(const PlanExtent& e) {
        min_x = std::min(min_x, e.min_x), max_x = std::max(max_x, e.max_x);
        min_y = std::min(min_y, e.min_y), max_y = std::max(max_y, e.max_y);
    }
};

/// Returns the angle of a rotary correction in radians, 0 to 2 pi, for an encoder count or word; `resolution`: counts
/// per revolution.
inline double turn_of(double value, double resolution) {
    const double turns = value / resolution;
    return 2 * pi * (turns - std::floor(turns));
}

/// Affine transform: x' = m11 x + m12 y + ox, with m = `product` = Scale * Angle * Matrix.
struct Transform {
    std::array<double, 4> matrix{1, 0, 0, 1};
    double angle_deg = 0, scale = 1;
    Point offset;
    std::array<double, 4> product{1, 0, 0, 1};
    std::int64_t neutral = 1;
};

enum class ActivityKind : std::int64_t { none, line, arc, hold, wait_encoder, wait_range, wait_mcbsp };
enum class Ending : std::int64_t { none, jump, mark, laser_off };

/// Present activity of the list: step `done` of `steps`.
struct Activity {
    ActivityKind kind = ActivityKind::none;
    Ending ending = Ending::none;
    std::int64_t done = 0, steps = 0;
    Point from, step, to;                 ///< line; arc: from: radius vector, to: centre, step.x: radians per tick
    std::array<std::int64_t, 4> value{};  ///< parameters of a wait: value(s), encoder or axis, mode
    Point direction;                      ///< direction of motion at the end, for the corner delay

    /// Returns the position after `steps_done` steps. `stationary`: position during activities other than lines and
    /// arcs.
    Point position(std::int64_t steps_done, Point stationary) const {
        const double at = static_cast<double>(steps_done);
        if (kind == ActivityKind::line)
            return steps_done == steps ? to : Point{from.x + at * step.x, from.y + at * step.y};
        if (kind != ActivityKind::arc) return stationary;
        const SinCos t = sin_cos(at * step.x);
        return {to.x + (t.cos * from.x - t.sin * from.y), to.y + (t.sin * from.x + t.cos * from.y)};
    }
};

struct BeltCounter {
    std::int64_t travel = 0, zero = 0, raw = 0;
    std::int64_t previous = 0;  ///< count of the previous tick
    std::int64_t simulated = 0, reset_at_start = 0;
    double slow1 = 0, slow2 = 0;  ///< velocity after the first and the second filter, counts/ms
    std::int32_t count() const {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(travel) - static_cast<std::uint32_t>(zero));
    }
};

struct EncodersState {
    std::array<BeltCounter, encoder_count> counters{};
    std::array<std::int64_t, encoder_count> input{};  ///< counts of the input lines
    std::array<std::int64_t, 4> stored{};             ///< counts of Encoder0, Encoder1 at Pos 0, then at Pos 1
    std::array<std::int64_t, encoder_count> tracking_error{};
    std::int64_t speed_watched = 0, speed_encoder = 0;
    double speed_target = 0, speed_smooth = 0;

    /// Resets everything except the counts of the input lines.
    void reset();
};

enum class FlyKind : std::int64_t { off, encoder, encoder_2d, encoder_rot, mcbsp, mcbsp_rot, multi };

struct Fly {
    FlyKind kind = FlyKind::off;
    std::int64_t x = 0, y = 0, z = 0;  ///< 1: the axis is corrected
    double scale_x = 0, scale_y = 0, scale_z = 0, resolution = 0;
    std::int64_t z_encoder = 0;
    bool on() const { return kind != FlyKind::off; }
};

struct FlyState {
    Fly now, paused;  ///< paused: the correction that park_position paused
    Point park_from, rot_center, offset_2d;
    std::int64_t parked = 0;
    bool on() const { return now.on(); }
};

/// Reason why the location of received words has no value.
inline constexpr std::string_view no_word_yet = "no word was received over McBSP yet; let the sender send one first";

struct McBsp {
    std::int64_t word = 0, previous = 0;
    std::array<std::int32_t, 4> memory{};
    std::array<std::int32_t, 8> typed{};
    std::array<std::uint32_t, 4> pending{};
    std::int64_t pending_count = 0;
    std::int64_t to_zero = 0;   ///< location 0 receives all words
    std::int64_t received = 0;  ///< a word has been received
    std::int64_t filled = 0;    ///< bit i: location i has a value
    std::int64_t in_mode = 0, multi = 0, round = 0;
    std::int64_t online_x = 0, online_y = 0, online_rot = 0;
    std::int64_t online_matrix = 0;
    std::int64_t power_port = 0, power_factor = 0, power_mode = 0;  ///< parameters of set_multi_mcbsp_in
    double online_scale_x = 0, online_scale_y = 0, online_resolution = 0;

    void put(std::int64_t location, std::int32_t value) {
        memory[static_cast<std::size_t>(location)] = value;
        filled |= std::int64_t{1} << location;
    }
    bool online() const { return online_x || online_y || online_rot; }
    /// Resets everything except the received words, and location 0 with its filled bit.
    void reset();
    /// Returns true if received words are stored at this location.
    bool goes_to(int location) const;
    /// Returns the value of location 0 .. 3. Errors: refused if the location is empty; the sentence names the command
    /// that must come first.
    Result<std::int32_t> read(int location) const;
};

/// Range of corrected positions that set no LIMIT flag, bits: min and max of X, Y and Z.
using FlyLimits = std::array<std::int64_t, 6>;

struct FlagsState {
    std::int64_t marking_info = 0, startstop_info = 0;
    std::array<std::int64_t, 32> flag_tick{};  ///< tick at which a bit of the marking info changed from 0 to 1
};

struct Laser {
    static constexpr std::int64_t capacity = 16;
    std::int64_t on = 0, count = 0, head = 0;
    std::array<std::int64_t, capacity> at{};  ///< half-microseconds; ring buffer from head; levels alternate from !on
    std::int64_t on_since = 0, on_time = 0, lost = 0;
    std::int64_t disabled = 0;

    /// Drops pending changes and enables the laser; keeps the present level and the on-time so far.
    void reset();
};

struct Start {
    std::int64_t target = 0, delay = 0, encoder = 0;
};

struct Starts {
    std::array<Start, start_queue> queue{};
    std::int64_t waiting = 0, triggers = 0, delay = 0, encoder = 0;
    std::array<Start, start_queue> asked{};  ///< requested by simulate_ext_start since the last tick
    std::int64_t asked_count = 0;
    std::int64_t position = 0, has_last = 0;
    std::array<std::int64_t, encoder_count> last{};  ///< encoder travel at the last start, counts
};

struct Delays {
    std::int64_t jump = 0, mark = 0, polygon = 0;
    std::int64_t laser_on = 0, laser_off = 0;
    std::int64_t variable_polygon = 0, edge_level = 0, min_jump = 0;
    double jump_limit = 0;  ///< bits; a shorter jump has a shorter delay
};

struct PathSettings {
    double jump_speed = 1000, mark_speed = 1000;  ///< bits/ms
    Delays delays;
};

struct Lists {
    std::array<std::int64_t, 4> begin{};    ///< start of list 1, 2, 3; end of the memory
    std::int64_t input = 0, input_end = 0;  ///< input pointer of put(); end of the opened list
    std::int64_t next = 0, running = 0, current = 0, paused = 0, paused_laser = 0;
    std::int64_t auto_change = 0, loop = 0, changed_at = -1, skip = 0, again = 0, marking = 0, moving_alone = 0;
    std::int64_t ended_unwritten = 0;                          ///< times that a list reached an empty position
    std::array<std::int64_t, max_depth> returns{};             ///< return positions of calls
    std::int64_t depth = 0, calls = 0, called_at = -1;         ///< calls in the tick called_at
    std::array<std::int64_t, subroutine_count> subroutines{};  ///< start positions in list 3; 0: undefined
    std::int64_t loading = 0, list3_used = 0;                  ///< the subroutine being loaded, from 1; positions used
    std::int64_t loaded = list_status_bit("USED1") | list_status_bit("USED2");  ///< read_status without BUSY

    void reset(const Settings& settings);
};

/// Wobbel motion of set_wobbel: an ellipse about the path while a polyline is marked.
struct Wobbel {
    double transversal = 0, longitudinal = 0, turns = 0;  ///< amplitudes in bits; revolutions per tick
    std::int64_t step = 0;                                ///< ticks since the start of the polyline
    Point direction{1, 0}, offset;                        ///< values in the last tick
    bool on() const { return turns != 0 && (transversal != 0 || longitudinal != 0); }
};

/// Recording of set_trigger; the next sample has the number `count`.
struct Recording {
    std::int64_t period = 0;  ///< ticks; 0: off
    std::int64_t channels = 0, first = 0, count = 0;
    std::array<std::int64_t, record_channels> signals{};
};

/// Transmission of set_mcbsp_out: signals are sent in turn, one per tick.
struct Sender {
    std::int64_t count = 0, first = 0;
    std::array<std::int64_t, sent_signals> signals{};
};

struct Head {
    Transform transform;
    std::int64_t table = 0;  ///< correction table 1 .. 4; 0: 1:1 (head A), no output (head B)
    Point gain{1, 1}, offset;
};

struct TransformsState {
    Transform global;
    std::array<Head, head_count> heads{};
    std::int64_t later_count = 0;      ///< bit set of the transforms in `later` that apply from the next jump on
    std::array<Transform, 3> later{};  ///< heads A, B, global
};

struct HeadOutput {
    std::array<std::int32_t, 2> a{}, b{};  ///< x, y of head A and head B, bits
    double z = 0;
    Point corrected;  ///< position after the fly correction, before the heads, bits
};

struct State {
    std::int64_t tick = 0;      ///< number of the next tick
    std::int64_t sampled = -1;  ///< the last tick with sampled inputs
    Point p;
    double z = 0;
    Activity activity;
    Lists lists;
    PathSettings path;
    EncodersState encoders;
    FlyState fly;
    FlyLimits limits{-8388608, 8388607, -8388608, 8388607, -8388608, 8388607};
    McBsp mcbsp;
    Laser laser;
    Starts starts;
    std::int64_t control_mode = 0;
    FlagsState flags;
    TransformsState transforms;
    std::int64_t io = 0;
    Wobbel wobbel;
    Recording recording;
    Sender sender;
    HeadOutput output;
    std::uint64_t memory_hash = 0;  ///< hash of the lists' memory: every command at its position; 0: empty

    /// Resets everything except the tick numbers and the values that the parts keep.
    void reset(const Settings& settings);
};

}  // namespace motionrack::rtc5
