// The card as a slow loop: simple and evidently correct, written from RULES.md alone. It is the oracle of the
// event-driven model.
//
//   slice (0.5 us):  divider ─► encoder ─► lines ─► watchdog ─► (every pass) firmware: access, stops, position, speed
//
// Nothing is precomputed: the divider counts down, the encoder moves edge by edge, and the firmware evaluates
// everything in every pass.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace motionrack::databoard4002::twin {

inline constexpr std::int64_t slices_of_tick = 5;  // a slice is 0.5 us, a tick of the card 2.5 us

/// Straps of the card, and the drive of its encoder.
struct Strapping {
    int firmware_pass_ticks = 1;
    std::int64_t byte_slices = 200;
    int version = 0x20;
    bool zeroing = true;
    bool quit_zeroes = true;
    bool up_down = false;
    int folding = 4;
    int first_pair = 0;
    bool single_ended = false;
    enum class Source { wires, laws, own_output } source = Source::own_output;
};

enum class In : int { o1, o2, zero, ref, ems, esr, esl };
enum class Out : int { vout, sign, relay, rst, interrupt };
inline constexpr int out_count = 5;

struct Note {
    std::int64_t slice = 0;
    int code = 0;
    std::int64_t a = 0, b = 0;
    friend bool operator==(const Note&, const Note&) = default;
};

class Twin {
  public:
    explicit Twin(const Strapping& strapping);

    void write(int port, int value);
    int read(int port);
    void set(In pin, int level);
    /// Generates an encoder edge every `period` units of 100 ps from now on.
    void law(std::int64_t period, int direction);
    void hang(bool on);
    void break_wire(In pin, bool broken);

    void slice();
    std::int64_t now() const { return now_; }

    int status() const;
    int latch() const { return latch_; }
    std::int64_t position() const;
    std::int64_t output_pulses() const { return pulses_; }
    std::array<int, out_count> outputs() const;
    const std::vector<Note>& notes() const { return notes_; }

  private:
    struct Line {
        int raw = 0, taken = 0;
        std::int64_t free_at = 0;
        int changes = 0;
    };
    using Table = std::array<int, 240>;

    void reset();
    void firmware();
    void work();
    void command(int code);
    void argument(int value);
    void go();
    void begin_move(std::int64_t target);
    int table_rate(const Table& table, std::int64_t travelled, std::int64_t to_go) const;
    void flaws();
    void note(int code, std::int64_t a = 0, std::int64_t b = 0) { notes_.push_back({now_, code, a, b}); }
    void access(int kind, int port, int value);
    void drive();
    void encoder_edge(int step);
    void new_rate(double counts_a_second);
    void zero_counter();
    void raise(int bits);
    void check_events();
    bool zero_wanted() const;
    void look_at_zero();
    bool active(In pin) const { return broken_[static_cast<int>(pin)] || level_[static_cast<int>(pin)]; }
    int stops() const;
    bool gate() const;
    bool driven() const { return rate_out_ > 0 && gate(); }
    void take(int line);
    void look_at_lines();
    std::int64_t half_period() const { return s_.single_ended ? 20 : 10; }

    Strapping s_;
    std::int64_t now_ = 0;
    std::array<int, 7> level_{};
    std::array<bool, 7> broken_{};
    std::vector<Note> notes_;

    // hardware
    std::int64_t counter_ = 0;
    std::int64_t disc_ = 0;  // the encoder's own count
    std::int64_t law_period_ = 0, law_next_ = 0;
    int law_direction_ = 0;
    bool too_quick_ = false;
    std::int64_t missed_ = 0;
    Line line_[2];
    bool running_ = false;
    int running_direction_ = 1;
    std::int64_t left_ = 0, reload_ = 0, pulses_ = 0;
    std::int64_t reset_pulse_until_ = -1;
    bool hung_ = false;
    std::int64_t watchdog_at_ = -1;

    // firmware
    bool ready_ = true;
    int access_ = 0, access_value_ = 0;
    std::int64_t access_at_ = 0;
    int latch_ = 0;
    std::vector<int> answer_;
    int open_ = 0;  // command with open data
    bool may_write_ = false, may_read_ = false;
    std::vector<int> bytes_;
    std::int64_t target_ = 0, number_ = 0, window_ = 0, requested_ = 0;
    int rate_ = 0;
    bool relative_ = false, sloped_ = false, lock_ = false, went_ = false;
    Table table_{};
    bool moving_ = false, move_sloped_ = false;
    std::int64_t move_target_ = 0, move_start_ = 0;
    int direction_ = 1;
    Table move_table_{};
    int event_ = 0x80, latched_ = 0, enables_ = 0, interrupts_ = 0, armed_ = 0;
    bool pending_ = false, armed_was_ = false;
    int stops_ = 0;
    int rate_out_ = 0;
    std::int64_t turn_ = 0;
};

}  // namespace motionrack::databoard4002::twin
