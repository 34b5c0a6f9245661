// Generates lines, arcs, chains of them, bit patterns and single steps of random register programs.
#pragma once

#include <algorithm>
#include <motionrack/cards/mcx314/test/program_traffic.hpp>
#include <utility>

namespace motionrack::mcx314::twin {

class Paths : protected Traffic {
  protected:
    using Traffic::Traffic;

    void choose_axes() {
        int order[4] = {0, 1, 2, 3};
        for (int i = 3; i > 0; --i) std::swap(order[i], order[random_.between(0, i)]);
        if (!random_.one_in(3)) std::sort(order, order + 4);
        if (random_.one_in(30)) order[1] = order[0];
        static constexpr int constant[] = {0, 0, 0, 1, 3, 3, 2};
        wr5_ = order[0] | order[1] << 2 | order[2] << 4 | random_.of(constant) << 8 | (random_.one_in(2) ? 1 << 14 : 0);
        if (random_.one_in(steps_ ? 2 : 20)) wr5_ |= static_cast<int>(random_.between(1, 3)) << 11;
        if (random_.one_in(2)) wr5_ |= 1 << 15;
        write(10, wr5_);
    }
    void segment() {
        if (wr5_ == 0 || random_.one_in(4)) choose_axes();
        if (random_.one_in(8)) {
            speeds(1u << (wr5_ & 3));
            if (random_.one_in(2)) data(1u << (wr5_ >> 2 & 3), 0x00, range());
        }
        const int code = static_cast<int>(random_.between(0x30, 0x33));
        if (code >= 0x32) {
            arc_data();
        } else {
            for (int i = 0; i < 3; ++i) data(1u << (wr5_ >> (2 * i) & 3), 0x06, coordinate());
        }
        command(0, code);
        if ((wr5_ & 0x1800) != 0) steps();
    }
    void arc_data() {
        const unsigned first = 1u << (wr5_ & 3), second = 1u << (wr5_ >> 2 & 3);
        const std::int64_t cx = coordinate(), cy = coordinate();
        data(first, 0x08, cx);
        data(second, 0x08, cy);
        std::int64_t px = 0, py = 0;
        const std::int64_t turn = random_.between(0, 4);  // a full circle, quarters, or anything
        if (turn == 1) px = cx - cy, py = cy + cx;
        if (turn == 2) px = 2 * cx, py = 2 * cy;
        if (turn == 3) px = cx + cy, py = cy - cx;
        if (turn == 4) px = coordinate(), py = coordinate();
        if (random_.one_in(4)) px += random_.between(-1, 1), py += random_.between(-1, 1);
        data(first, 0x06, px);
        data(second, 0x06, py);
    }
    void chain() {
        if (random_.one_in(2)) command(0, random_.one_in(2) ? 0x3B : 0x3C);
        for (std::int64_t n = random_.between(2, 6); n > 0; --n) {
            segment();
            if (random_.one_in(3)) data(1u << (wr5_ & 3), 0x05, speed(4000));
            if (random_.one_in(2)) read(0);
            if (random_.one_in(2)) now_ += random_.between(0, program_.ticks / 20);
            if (n == 1 && random_.one_in(2)) command(0, 0x3B);
        }
    }
    // Requests single steps, by command and by wire, slower or faster than the speed allows.
    void steps() {
        const std::int64_t from = now_, pause = random_.between(1, random_.one_in(3) ? program_.ticks / 20 : 30);
        for (std::int64_t n = random_.between(1, 12); n > 0; --n) {
            now_ += random_.between(0, pause);
            between_ = random_.one_in(2);
            if (random_.one_in(2)) {
                command(0, 0x3A);
            } else {
                add(Op::Kind::step, 0, 0);
                const std::int64_t at = now_;
                now_ += random_.between(0, 4);
                between_ = random_.one_in(2);
                if (!random_.one_in(20)) add(Op::Kind::step, 0, 1);
                if (random_.one_in(2)) now_ = at;
            }
        }
        if (random_.one_in(3)) now_ = from;
    }
    // Writes the six pattern registers: their bits mostly step one way and rarely both.
    void pattern_word(bool last) {
        const std::int64_t thin = random_.between(0, 0xFFFF) | (random_.one_in(2) ? 0xFFFF : 0);
        for (int i = 0; i < 3; ++i) {
            std::int64_t plus = random_.between(0, 0xFFFF) & thin, minus = ~plus & random_.between(0, 0xFFFF) & thin;
            if (random_.one_in(3)) plus |= minus, minus = 0;
            if (random_.one_in(3)) minus |= plus, plus = 0;
            if (last && i == 0) plus |= 1 << random_.between(0, 15), minus |= plus & -plus;
            if (random_.one_in(60)) minus |= plus;
            write(4 + 4 * i, plus);
            write(6 + 4 * i, minus);
        }
        command(0, 0x38);
    }
    void pattern() {
        if (wr5_ == 0 || random_.one_in(3)) choose_axes();
        if (random_.one_in(8)) speeds(1u << (wr5_ & 3));
        if (random_.one_in(6)) command(0, 0x39);
        const std::int64_t words = random_.between(0, 5), before = random_.between(0, 3);
        if (!random_.one_in(8)) command(0, 0x36);
        bool begun = false;
        for (std::int64_t n = 0; n < words; ++n) {
            if (n >= before && !begun) begun = true, start_pattern();
            if (n >= before) now_ += random_.between(0, random_.one_in(2) ? 60 : program_.ticks / 20);
            pattern_word(n + 1 == words && random_.one_in(2));
        }
        if (!random_.one_in(10)) command(0, 0x37);
        if (!begun) start_pattern();
        if (random_.one_in(4)) command(0, random_.one_in(2) ? 0x3B : 0x3D);
    }
    void start_pattern() {
        command(0, random_.one_in(2) ? 0x34 : 0x35);
        if ((wr5_ & 0x1800) != 0) steps();
        if (random_.one_in(3)) read(0);
    }

    int wr5_ = 0;
    bool steps_ = false;
};

}  // namespace motionrack::mcx314::twin
