// The card as a slow loop: simple and evidently correct, written from RULES.md alone. It is the oracle of the
// event-driven model.
//
// Time advances in halves of a sample (50 ns); every second half is a sample, at which every line of every axis is
// read.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace motionrack::ioflex02::twin {

struct Note {
    int code = 0;
    std::int64_t a = 0, b = 0;
    friend auto operator<=>(const Note&, const Note&) = default;
};

class Twin {
  public:
    Twin(bool preloaded, int ident, int serial, std::int64_t configuration_halves);

    /// Advances to that half; a sample at it is not taken yet.
    void run_to(std::int64_t half);
    void wire(int axis, int line, int level) { axes_[axis].wire[line] = level; }
    /// Sets the level of an input by its bit in IN.
    void input(int number, int level) { wire(number / 4, number % 4, level); }
    void write(int at, int value);
    int read(int at);
    int outputs() const { return outputs_; }
    std::vector<Note> notes() const { return notes_; }

  private:
    struct Axis {
        int wire[4] = {};
        int taken[4] = {};
        std::deque<int> history[4];  // the last samples, the newest first
        int mode = 0, image_mode = 0;
        std::int64_t position = 0, raw = 0, age = 0;
        bool counted = false, reported = false;
        int down = 0, edges_a = 0, edges_b = 0, indexes = 0, illegal = 0;
        std::int64_t index_at = 0, illegal_at = 0;
        int state = 0;  // 0 calibrated, 1 wait index, 2 wait cal
    };
    enum Phase { empty, loading, starting, running, failed };

    void see();
    void sample(Axis& axis, int number);
    void begin();
    void note(int code, std::int64_t a, std::int64_t b) { notes_.push_back({code, a, b}); }
    void byte(int value);
    void refuse(int code);
    int captured(int at) const;
    int status() const;
    bool project() const { return phase_ == running && known_; }

    Axis axes_[4];
    Axis latched_[4];
    std::int64_t latched_time_ = 0;
    int outputs_ = 0;
    int chosen_ = 0;
    int serial_;
    std::int64_t now_ = 0;
    bool sampled_ = false;  // the sample of this half has been taken
    bool first_ = true;     // the next sample is the project's first
    std::int64_t began_ = 0, time_ = 0;
    Phase phase_ = empty;
    std::int64_t start_at_ = 0, configuration_;
    std::vector<int> image_;
    int error_ = 0, ident_ = 0;
    bool known_ = false, reported_no_project_ = false;
    std::vector<Note> notes_;
};

}  // namespace motionrack::ioflex02::twin
