// Random part programs of all kinds for a router with X Y Z and a rotary axis A, always within its limits.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

namespace motionrack::test {

struct RandomProgram {
    std::string text;
    std::array<double, 4> end = {};  ///< X Y Z mm, A degrees
    bool curves = false;             ///< has arcs or helices
    bool chords = false;             ///< may have one that the chip does not draw itself
};

/// Largest length of a move: 100, 2 or 0.05 mm; `mixed`: 100 or 2.
enum class ProgramSize { big, small, tiny, mixed };

/// Makes lines, arcs, helices, rapids and dwells; one to four axes; large and tiny moves; G61, G61.1 and G64.
class ProgramMaker {
  public:
    ProgramMaker(std::uint64_t seed, ProgramSize size) : random_(seed), size_(size) {}

    RandomProgram make() {
        out_ = {};
        axes_ = 1 + pick(4);
        out_.text = fmt::format("G21 G90 G17 {}\nG0 X150 Y100 Z40\n",
                                std::array{"G61", "G61.1", "G64 P0.05", "G64 P0.005"}[pick(4)]);
        at_ = {150, 100, 40, 0};
        const int moves = size_ == ProgramSize::tiny ? 60 : 25;
        for (int i = 0; i < moves; ++i) {
            reach_ = size_ == ProgramSize::mixed ? std::array{100.0, 2.0}[pick(2)]
                                                 : std::array{100.0, 2.0, 0.05}[static_cast<int>(size_)];
            const int kind = pick(40);
            if (kind == 0)
                out_.text += fmt::format("G4 P{:.3f}\n", number(0, 0.05));
            else if (kind < 14 && axes_ > 1)
                add_curve();
            else
                add_straight(kind < 20);
        }
        out_.text += "M2\n";
        out_.end = at_;
        return out_;
    }

  private:
    int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
    double number(double low, double high) {
        return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
    }
    static double rounded(double x) { return std::round(x * 1000) / 1000; }
    double feed() { return std::round(std::exp(number(std::log(100.0), std::log(6000.0)))); }

    double next(int axis) {
        constexpr std::array<double, 4> low = {60, 50, 10, -900}, high = {240, 150, 70, 900};
        return rounded(std::clamp(at_[axis] + number(-reach_, reach_) * (axis == 3 ? 3 : 1), low[axis], high[axis]));
    }

    void add_straight(bool rapid) {
        std::string words;
        for (int axis = 0; axis < axes_; ++axis) {
            if (pick(10) < 3) continue;
            at_[axis] = next(axis);
            words += fmt::format(" {}{:.3f}", "XYZA"[axis], at_[axis]);
        }
        if (words.empty()) return;
        out_.text += rapid ? fmt::format("G0{}\n", words) : fmt::format("G1{} F{}\n", words, feed());
    }

    /// Adds an arc by its radius, so that it is always possible; the full circle around the middle of the chord is
    /// within the limits.
    void add_curve() {
        const int plane = axes_ < 3 ? 0 : pick(4) < 3 ? 0 : 1 + pick(2);
        const int first = std::array{0, 2, 1}[plane], second = std::array{1, 0, 2}[plane], third = 3 - first - second;
        if (plane > 0) reach_ = std::min(reach_, 8.0);
        const double a = next(first), b = next(second);
        const double half = std::sqrt((a - at_[first]) * (a - at_[first]) + (b - at_[second]) * (b - at_[second])) / 2;
        if (half < 0.005) return;
        const double radius = rounded(half * number(1.02, 3) + 0.002);
        // R > 0: at most half a turn, bulging by less than the half chord; R < 0: more than half a turn.
        const bool major_arc = half < 5 && pick(3) == 0;
        out_.text +=
            fmt::format("G{} G{} {}{:.3f} {}{:.3f}", 17 + plane, 2 + pick(2), "XYZ"[first], a, "XYZ"[second], b);
        at_[first] = a;
        at_[second] = b;
        if (axes_ > 2 && pick(3) == 0) {
            at_[third] = next(third);
            out_.text += fmt::format(" {}{:.3f}", "XYZ"[third], at_[third]);
            out_.chords = true;
        }
        if (axes_ > 3 && pick(4) == 0) {
            at_[3] = next(3);
            out_.text += fmt::format(" A{:.3f}", at_[3]);
            out_.chords = true;
        }
        out_.text += fmt::format(" R{:.3f} F{}\n", major_arc ? -radius : radius, feed());
        out_.curves = true;
    }

    std::mt19937_64 random_;
    ProgramSize size_;
    RandomProgram out_;
    std::array<double, 4> at_ = {};
    int axes_ = 4;
    double reach_ = 1;
};

}  // namespace motionrack::test
