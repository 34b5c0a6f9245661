// The twin's bit pattern: registers, a stack of three words and the remaining steps of the running word.
#pragma once

#include <array>
#include <cstdint>
#include <deque>

namespace motionrack::mcx314::twin {

class Pattern {
  public:
    /// One step of AX1..AX3.
    struct Step {
        std::array<bool, 3> plus{}, minus{};
        bool is_end(int axes) const {
            for (int i = 0; i < axes; ++i)
                if (plus[i] && minus[i]) return true;
            return false;
        }
        int of(int i) const { return plus[i] ? (minus[i] ? 0 : +1) : minus[i] ? -1 : 0; }
    };
    /// Values of BP1P, BP1M, BP2P, BP2M, BP3P, BP3M.
    using Word = std::array<std::uint16_t, 6>;

    bool writable = false;  ///< 36h has enabled the pattern registers
    bool interrupt = false;
    Word registers{};

    /// Returns BPSC, the number of stacked words.
    int counter() const { return static_cast<int>(stack_.size()); }
    /// Executes 38h; returns false if the stack is full.
    bool stack() {
        if (counter() >= 3) return false;
        stack_.push_back(registers);
        return true;
    }
    void clear() {
        stack_.clear();
        running_.clear();
    }
    bool running() const { return !running_.empty(); }
    /// Makes the oldest stacked word the running one; returns false if there is none.
    bool take() {
        running_.clear();
        if (stack_.empty()) return false;
        for (int n = 0; n < 16; ++n) {
            Step step;
            for (int i = 0; i < 3; ++i) {
                step.plus[i] = (stack_.front()[2 * i] >> n & 1) != 0;
                step.minus[i] = (stack_.front()[2 * i + 1] >> n & 1) != 0;
            }
            running_.push_back(step);
        }
        stack_.pop_front();
        return true;
    }
    /// Executes the next step.
    Step pop() {
        const Step step = running_.front();
        running_.pop_front();
        return step;
    }
    /// Returns the direction of AX(i+1)'s next step in the running word, before the end code; 0: it has no further
    /// step.
    int next_direction(int i, int axes) const {
        for (const Step& step : running_) {
            if (step.is_end(axes)) return 0;
            if (step.of(i) != 0) return step.of(i);
        }
        return 0;
    }

  private:
    std::deque<Word> stack_;
    std::deque<Step> running_;
};

}  // namespace motionrack::mcx314::twin
