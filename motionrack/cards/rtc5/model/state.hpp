// The state of the card except its lists and tables. Every member has 8 bytes (or comes in pairs), so no padding enters
// a snapshot's hash. A part whose reset() keeps something has one of its own; the others get their first values.
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

/// Extent of positions; empty at first.
struct PlanExtent {
    double min_x = std::numeric_limits<double>::infinity(), max_x = -std::numeric_limits<double>::infinity();
    double min_y = std::numeric_limits<double>::infinity(), max_y = -std::numeric_limits<double>::infinity();

    bool empty() const { return !(min_x <= max_x); }
    void take(const PlanExtent& e) {
        min_x = std::min(min_x, e.min_x), max_x = std::max(max_x, e.max_x);
        min_y = std::min(min_y, e.min_y), max_y = std::max(max_y, e.max_y);
    }
};

/// Angle of a rotary correction in radians. Whole turns are removed, so every count has an angle.
inline double turn_of(double value, double resolution) {
    const double turns = value / resolution;
    return 2 * pi * (turns - std::floor(turns));
}

/// x' = m11 x + m12 y + ox. Matrix = Scale * Angle * Matrix.
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
    Point from, step, to;                 ///< line; arc: from is the radius, to the centre, step.x the angle of a step
    std::array<std::int64_t, 4> value{};  ///< waits: values; then encoder or axis, mode
    Point direction;                      ///< direction at its end, for the corner

    /// After `steps_done` steps. `stationary`: the position in which other activities than lines and arcs stay.
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
    double slow1 = 0, slow2 = 0;  ///< velocity after the filters, counts/ms
    std::int32_t count() const {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(travel) - static_cast<std::uint32_t>(zero));
    }
};

struct EncodersState {
    std::array<BeltCounter, encoder_count> counters{};
    std::array<std::int64_t, encoder_count> input{};  ///< counts of the input lines
    std::array<std::int64_t, 4> stored{};             ///< Encoder0, Encoder1 of Pos 0; of Pos 1
    std::array<std::int64_t, encoder_count> tracking_error{};
    std::int64_t speed_watched = 0, speed_encoder = 0;
    double speed_target = 0, speed_smooth = 0;

    /// Keeps the input lines.
    void reset();
};

enum class FlyKind : std::int64_t { off, encoder, encoder_2d, encoder_rot, mcbsp, mcbsp_rot, multi };

struct Fly {
    FlyKind kind = FlyKind::off;
    std::int64_t x = 0, y = 0, z = 0;  ///< enabled corrections
    double scale_x = 0, scale_y = 0, scale_z = 0, resolution = 0;
    std::int64_t z_encoder = 0;
    bool on() const { return kind != FlyKind::off; }
};

struct FlyState {
    Fly now, paused;  ///< paused: by park_position
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
    std::int64_t filled = 0;    ///< bits of the locations that have a value
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
    /// Keeps the words, and location 0 with its filling.
    void reset();
    /// Received words go there (too).
    bool goes_to(int location) const;
    /// Value of location 0 .. 3. Errors: refused if the location is empty; the sentence names the command that must
    /// come first.
    Result<std::int32_t> read(int location) const;
};

/// Corrected positions without a LIMIT flag: min and max of X, of Y, of Z.
using FlyLimits = std::array<std::int64_t, 6>;

struct FlagsState {
    std::int64_t marking_info = 0, startstop_info = 0;
    std::array<std::int64_t, 32> flag_tick{};  ///< tick at which a bit of marking info was set, since it was last clear
};

struct Laser {
    static constexpr std::int64_t capacity = 16;
    std::int64_t on = 0, count = 0, head = 0;
    std::array<std::int64_t, capacity> at{};  ///< half-microseconds; ring buffer from head; levels alternate from !on
    std::int64_t on_since = 0, on_time = 0, lost = 0;
    std::int64_t disabled = 0;

    /// Keeps what it has emitted so far.
    void reset();
};

struct Start {
    std::int64_t target = 0, delay = 0, encoder = 0;
};

struct Starts {
    std::array<Start, start_queue> queue{};
    std::int64_t waiting = 0, triggers = 0, delay = 0, encoder = 0;
    std::array<Start, start_queue> asked{};  ///< by simulate_ext_start, since the last tick
    std::int64_t asked_count = 0;
    std::int64_t position = 0, has_last = 0;
    std::array<std::int64_t, encoder_count> last{};  ///< travel at the last start
};

struct Delays {
    std::int64_t jump = 0, mark = 0, polygon = 0;
    std::int64_t laser_on = 0, laser_off = 0;
    std::int64_t variable_polygon = 0, edge_level = 0, min_jump = 0;
    double jump_limit = 0;  ///< bits
};

struct PathSettings {
    double jump_speed = 1000, mark_speed = 1000;  ///< bits/ms
    Delays delays;
};

struct Lists {
    std::array<std::int64_t, 4> begin{};    ///< start of list 1, 2, 3; end of the memory
    std::int64_t input = 0, input_end = 0;  ///< position of the next command
    std::int64_t next = 0, running = 0, current = 0, paused = 0, paused_laser = 0;
    std::int64_t auto_change = 0, loop = 0, changed_at = -1, skip = 0, again = 0, marking = 0, moving_alone = 0;
    std::int64_t ended_unwritten = 0;                          ///< times that a list reached an unwritten position
    std::array<std::int64_t, max_depth> returns{};             ///< return positions of calls
    std::int64_t depth = 0, calls = 0, called_at = -1;         ///< calls in the tick called_at
    std::array<std::int64_t, subroutine_count> subroutines{};  ///< their start positions in list 3; 0: none
    std::int64_t loading = 0, list3_used = 0;                  ///< the subroutine being loaded, from 1; positions used
    std::int64_t loaded = list_status_bit("USED1") | list_status_bit("USED2");  ///< read_status without BUSY

    void reset(const Settings& settings);
};

/// set_wobbel: an ellipse about p while a polyline is marked.
struct Wobbel {
    double transversal = 0, longitudinal = 0, turns = 0;  ///< bits; turns a tick
    std::int64_t step = 0;                                ///< ticks since the start of the polyline
    Point direction{1, 0}, offset;                        ///< values in the last tick
    bool on() const { return turns != 0 && (transversal != 0 || longitudinal != 0); }
};

/// set_trigger: sample number `count` is next.
struct Recording {
    std::int64_t period = 0;  ///< ticks; 0: off
    std::int64_t channels = 0, first = 0, count = 0;
    std::array<std::int64_t, record_channels> signals{};
};

/// set_mcbsp_out: signals that are sent in turn, one per tick.
struct Sender {
    std::int64_t count = 0, first = 0;
    std::array<std::int64_t, sent_signals> signals{};
};

struct Head {
    Transform transform;
    std::int64_t table = 0;  ///< 0: 1:1
    Point gain{1, 1}, offset;
};

struct TransformsState {
    Transform global;
    std::array<Head, head_count> heads{};
    std::int64_t later_count = 0;      ///< transforms pending until the next jump: bit HeadNo
    std::array<Transform, 3> later{};  ///< heads A, B, global
};

struct HeadOutput {
    std::array<std::int32_t, 2> a{}, b{};  ///< x, y of both heads
    double z = 0;
    Point corrected;  ///< after fly
};

struct State {
    std::int64_t tick = 0;      ///< the next tick
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

    /// Keeps the time and what its parts keep.
    void reset(const Settings& settings);
};

}  // namespace motionrack::rtc5
