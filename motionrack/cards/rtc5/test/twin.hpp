// Reference implementation of the RTC5 for tests: every rule of RULES.md in the simplest form, evaluated at every tick,
// and therefore slow. It shares only the tables of commands and bits with the card's model.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <motionrack/cards/rtc5/map.hpp>
#include <motionrack/cards/rtc5/model/correction.hpp>
#include <motionrack/cards/rtc5/model/fly_table.hpp>
#include <optional>
#include <vector>

namespace motionrack::rtc5::twin {

struct Xy {
    double x = 0, y = 0;
};

inline double clip24(double v) {
    return std::clamp(v, -8388608.0, 8388607.0);
}

inline std::int64_t whole(double v) {
    return static_cast<std::int64_t>(v);
}

struct Matrix {
    double m[4] = {1, 0, 0, 1}, angle = 0, scale = 1;
    Xy offset;
    bool neutral() const;
    Xy of(Xy p) const;
    void product(double out[4]) const;
};

struct Sample {
    std::int32_t x = 0, y = 0, x_b = 0, y_b = 0;
    int laser = 0;
    unsigned outside = 0;  ///< bits 0 to 3 of the marking info that this tick sets
    bool operator==(const Sample&) const = default;
};

class Twin {
  public:
    explicit Twin(std::int64_t memory, std::int64_t list1, std::int64_t list2);
    Sample tick();

    // Between ticks.
    void execute(std::int64_t position);
    void stop();
    void pause();
    void restart();
    void disable_laser();
    void jump_alone(Xy to);
    void set_matrix(int head, int at_once, const double m[4]);
    void set_offset(int head, int at_once, Xy offset);
    void set_angle(int head, int at_once, double degrees);
    void set_scale(int head, int at_once, double scale);
    void set_mcbsp_in(int mode, double scale);
    void set_multi();
    void set_online(double x, double y, double rot);
    void set_one_online(int which, double value);
    void set_online_matrix();
    void apply_online(int head, int at_once);
    void receive(std::uint32_t word);
    std::uint32_t take_marking_info();

    std::vector<Command> memory;
    std::int64_t begins[4];
    std::int64_t now = 0;
    Xy p;
    double z = 0;
    double jump_speed = 1000, mark_speed = 1000;
    std::int64_t jump_delay = 0, mark_delay = 0, polygon_delay = 0, laser_on = 0, laser_off = 0;
    bool variable_polygon = false;
    std::int64_t edge_level = 0, min_jump = 0;
    double jump_limit = 0;

    struct Counter {
        std::int64_t travel = 0, zero = 0;
        std::int32_t raw = 0, input = 0, before = 0;
        bool simulated = false, reset_at_start = false;
        double slow1 = 0, slow2 = 0;
        std::int32_t count() const { return static_cast<std::int32_t>(travel - zero); }
    } encoders[2];
    std::int64_t stored[4] = {};
    int tracking[2] = {};
    bool watch_speed = false;
    double smooth = 0;

    enum class Kind { off, encoder, two_d, turn, mcbsp, mcbsp_turn, multi };
    struct Correction {
        Kind kind = Kind::off;
        bool x = false, y = false, z = false;
        double sx = 0, sy = 0, sz = 0, resolution = 0;
        int ez = 0;
    } fly, paused;
    bool parked = false;
    Xy park_from, centre, offset_2d;
    const FlyTable* table_2d = nullptr;
    std::int64_t limits[6] = {-8388608, 8388607, -8388608, 8388607, -8388608, 8388607};

    std::uint32_t word = 0, word_before = 0;
    std::deque<std::uint32_t> words;
    std::optional<std::int32_t> locations[4];  // empty: the location has no value yet
    std::int32_t typed[8] = {}, in_mode = 0, round = 0;
    bool to_zero = false, multi = false, heard = false;
    bool online[3] = {}, online_matrix = false;
    double online_scale[3] = {};

    std::uint32_t control = 0, marking = 0, startstop = 0;
    std::int64_t flag_tick[32] = {};
    struct Pending {
        std::int64_t target, delay;
        int encoder;
    };
    std::deque<Pending> waiting;
    int triggers = 0;
    std::vector<Pending> asked;
    std::int64_t start_delay = 0, start_position = 0, last_start[2] = {};
    int start_encoder = 0;
    bool started_once = false;

    bool running = false, paused_list = false, alone = false, auto_change = false, loop = false;
    std::int64_t next = 0, current = 0, changed_at = -1, unwritten = 0;
    bool skip = false, again = false, marking_line = false, laser_in_pause = false;

    bool laser = false, laser_disabled = false;
    std::deque<std::pair<std::int64_t, bool>> changes;

    Matrix heads[2], global;
    std::optional<Matrix> later[3];
    const CorrectionFile* tables[2] = {};
    bool second_head = false;
    double gain[2][2] = {{1, 1}, {1, 1}}, gain_offset[2][2] = {};
    std::int64_t io = 0;

    std::int64_t subroutines[1024] = {};
    std::vector<std::int64_t> returns;
    std::int64_t calls = 0, called_at = -1;

    double across = 0, along = 0, wobbel_turns = 0;  // parameters of the wobbel
    std::int64_t wobbel_step = 0;
    Xy wobbel_direction{1, 0}, wobbel_offset;

    std::int64_t period = 0, first_record = 0;
    std::vector<int> recorded_signals;
    std::vector<std::vector<std::int32_t>> rows;

  private:
    struct Doing {
        enum What { nothing, line, arc, hold, wait } what = nothing;
        std::int64_t done = 0, steps = 0;
        Xy from, step, to, direction;
        char ending = 0;  // delay after the line: j jump delay, m mark delay; l: the laser goes off
        Command command;
    } doing;

    void inputs();
    void starts();
    void start_now();
    void ask_start(std::int64_t delay, int encoder);
    void list();
    void end_list(bool written);
    void take(const Command& c);
    void call(std::int64_t position);
    void wobbel();
    void mark(const Command& c);
    void after();
    void line_to(Xy to, double speed, char ending, std::int64_t steps = 0);
    void jump(Xy to);
    void hold(std::int64_t n, char ending = 0);
    void fly_command(const Command& c);
    bool zero(std::vector<int> which);
    void leave();
    bool condition(const Command& c);
    bool wait_over() const;
    bool reached(std::int64_t value, std::int64_t mode, std::int32_t before, std::int32_t present) const;
    double ahead(int e) const;
    std::int32_t axis(std::uint32_t w, bool y) const;
    Xy corrected(Xy g, bool backwards) const;
    void flags(Xy q);
    void set_flag(int bit);
    void change_laser(std::int64_t at, bool on);
    int laser_of_tick();
    void set_trigger(const Command& c);
    void record(const Sample& out, Xy q);
    Xy through_table(int h, Xy r) const;
    void transform_command(const Command& c);
    template <class F>
    void transforms(int head, int at_once, F f);
    Xy target(const Command& c) const;
};

}  // namespace motionrack::rtc5::twin
