// Accesses of random register programs, of 16 or 8 bits, their wires, and the time between them.
#pragma once

#include <motionrack/cards/mcx314/test/program_values.hpp>

namespace motionrack::mcx314::twin {

class Traffic : protected Values {
  protected:
    using Values::Values;

    void add(Op::Kind kind, int offset, std::int64_t value) {
        Op op;
        op.tick = now_, op.between = between_, op.kind = kind;
        op.offset = static_cast<std::uint8_t>(offset);
        op.value = static_cast<std::uint16_t>(value);
        program_.ops.push_back(op);
    }
    void write(int offset, std::int64_t value) {
        if (bytes_ && !random_.one_in(16)) return write_bytes(offset, value);
        add(Op::Kind::write, offset, value);
        if (random_.one_in(60)) gap();
    }
    // Writes the high byte, then the low byte, as WR0 requires; sometimes in reverse, or only one of them.
    void write_bytes(int offset, std::int64_t value) {
        const int first = random_.one_in(12) ? 0 : 1;
        for (const int half : {first, 1 - first}) {
            if (random_.one_in(40)) continue;
            add(Op::Kind::write_byte, offset + half, value >> (8 * half) & 0xFF);
            if (random_.one_in(60)) gap();
        }
    }
    void read(int offset) {
        if (!bytes_ || random_.one_in(16)) return add(Op::Kind::read, offset, 0);
        const int first = random_.one_in(4) ? 1 : 0;
        add(Op::Kind::read_byte, offset + first, 0);
        if (!random_.one_in(8)) add(Op::Kind::read_byte, offset + 1 - first, 0);
    }
    void input(int axis, Pin pin, bool level) {
        add(Op::Kind::input, 0, level);
        program_.ops.back().axis = static_cast<std::int8_t>(axis);
        program_.ops.back().pin = pin;
    }
    void command(unsigned axes, int code) {
        write(0, static_cast<std::int64_t>(axes << 8 | static_cast<unsigned>(code)));
    }
    void data(unsigned axes, int code, std::int64_t value) {
        write(14, value >> 16);
        write(12, value);
        command(axes, code);
    }
    void mode(unsigned axes, int number, std::int64_t value) {
        command(axes, 0x0F);
        write(2 * number, value);
    }
    void gap() {
        const std::int64_t max_ticks = random_.one_in(busy_ < 10 ? 8 : 3) ? 4
                                       : random_.one_in(6)                ? program_.ticks / 6
                                                                          : program_.ticks / busy_;
        now_ += random_.between(0, std::max<std::int64_t>(max_ticks, 4));
        between_ = random_.one_in(2);
    }
    unsigned axes() {
        return random_.one_in(2) ? 1u << random_.between(0, 3) : static_cast<unsigned>(random_.between(1, 15));
    }
    // Makes a few edges of an axis' encoder in one direction, or a bounce of one line.
    void turn(int axis) {
        const std::int64_t pause = random_.one_in(3) ? program_.ticks / 100 : 2;
        const int direction = random_.one_in(2) ? 1 : -1;
        for (std::int64_t n = random_.between(1, 20); n > 0; --n) {
            now_ += random_.between(0, pause);
            if (between_) ++now_;
            between_ = !between_;
            const int before = phase_[axis], after = before + direction;
            const int line = random_.one_in(30) ? 0 : ((before ^ before >> 1) ^ (after ^ after >> 1)) >> 1 & 1;
            phase_[axis] = after;
            add(Op::Kind::encoder, line, (after ^ after >> 1) >> line & 1);
            program_.ops.back().axis = static_cast<std::int8_t>(axis);
        }
    }

    // Sets an input Low for a while, sometimes permanently.
    void pull(int axis, Pin pin, std::int64_t max_ticks) {
        input(axis, pin, false);
        const std::int64_t from = now_;
        now_ += random_.between(0, max_ticks);
        between_ = random_.one_in(2);
        if (!random_.one_in(8)) input(axis, pin, true);
        now_ = from;
    }

    void speeds(unsigned some) {
        const std::int64_t start = start_speed();
        data(some, 0x00, range());
        data(some, 0x04, start);
        data(some, 0x05, speed(start));
        data(some, 0x02, accel());
        data(some, 0x03, accel());
        data(some, 0x01, jerk());
        data(some, 0x0D, random_.one_in(3) ? 0 : random_.between(0, random_.one_in(10) ? 65'535 : 30));
        data(some, 0x07, pulses());
    }

    int phase_[4] = {2, 2, 2, 2};  // phases of the encoders; 2: both lines High
    std::int64_t now_ = 0;
    bool between_ = false;
    bool bytes_ = false;  // true: the program uses an 8-bit bus
    std::int64_t busy_ = 30;
};

}  // namespace motionrack::mcx314::twin
