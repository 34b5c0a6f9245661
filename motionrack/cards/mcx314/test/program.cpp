// Generates random register programs.
#include <algorithm>
#include <motionrack/cards/mcx314/test/program_extension.hpp>

namespace motionrack::mcx314::twin {

std::uint64_t Random::next() {
    std::uint64_t v = state_ += 0x9E3779B97F4A7C15ull;
    v = (v ^ v >> 30) * 0xBF58476D1CE4E5B9ull;
    v = (v ^ v >> 27) * 0x94D049BB133111EBull;
    return v ^ v >> 31;
}

std::int64_t Random::between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(next() % static_cast<std::uint64_t>(high - low + 1));
}

namespace {

class Maker : private ExtensionActions {
  public:
    Maker(std::uint64_t seed, std::uint64_t number, const ChipOptions& options)
        : ExtensionActions(seed, number, options) {}

    Program make() {
        static constexpr std::int64_t lengths[] = {2'000, 2'000, 2'000, 2'000, 4'000, 4'000, 8'000, 8'000};
        program_.ticks = random_.one_in(16) ? 200'000 : random_.of(lengths);
        long_ = program_.ticks > 100'000;
        static constexpr std::int64_t busyness[] = {300, 30, 6};
        busy_ = random_.of(busyness);
        s_curve_ = random_.one_in(3);
        if (s_curve_ && !long_) program_.ticks *= random_.between(1, 3);
        nasty_ = random_.one_in(4);
        bytes_ = random_.one_in(8);
        steps_ = random_.one_in(6);
        external_ = random_.one_in(4);
        const std::int64_t theme = random_.between(0, 3);  // single axes, interpolation, both, everything
        initial();
        if (program_.extended()) begin_extension();
        if (random_.one_in(4)) retarget();
        while (now_ < program_.ticks) {
            action(theme);
            gap();
        }
        now_ = program_.ticks;
        read_everything();
        std::stable_sort(program_.ops.begin(), program_.ops.end(),
                         [](const Op& a, const Op& b) { return a.order() < b.order(); });
        return std::move(program_);
    }

  private:
    // ---- parameters
    void initial() {
        now_ = random_.between(0, 3);
        if (random_.one_in(4)) {
            for (unsigned a = 0; a < 4; ++a) speeds(1u << a);
        } else {
            speeds(15);
        }
        for (unsigned a = 0; a < 4; ++a) {
            if (s_curve_ || random_.one_in(3)) mode(1u << a, 3, drive_mode());
            if (random_.one_in(4)) mode(1u << a, 1, random_.between(0, 255) << 8);
            data(1u << a, 0x0B, position() + program_.ticks / 20);
            data(1u << a, 0x0C, position() - program_.ticks / 20);
        }
        data(15, 0x06, pulses());
    }
    std::int64_t drive_mode() {
        std::int64_t bits = (random_.one_in(4) ? 1 : 0) | (random_.one_in(3) ? 2 : 0);
        if (s_curve_ && !random_.one_in(4)) bits |= 4;
        if (random_.one_in(external_ ? 2 : 12)) bits |= random_.between(1, 3) << 3;
        if (random_.one_in(4)) bits |= random_.between(0, 31) << 7;
        return bits;
    }

    // ---- actions
    void action(std::int64_t theme) {
        if (program_.extended() && random_.one_in(4)) return extension();
        const bool calm = busy_ < 10;  // a program usually does not disturb its drives
        const std::int64_t roll = random_.between(0, calm && !random_.one_in(4) ? 67 : 99);
        const bool path = theme == 1 || (theme >= 2 && random_.one_in(2));
        if (roll < 26) {
            if (path)
                random_.one_in(3) ? chain() : random_.one_in(3) ? pattern() : segment();
            else
                drive();
        } else if (roll < 38) {
            rewrite();
        } else if (roll < 68) {
            poll();
        } else if (roll < 74) {
            command(axes(), random_.one_in(3) ? 0x27 : 0x26);
        } else if (roll < 84) {
            external_&& random_.one_in(2) ? external() : wire();
        } else if (roll < 90) {
            modes();
        } else if (roll < 93) {
            command(axes(), random_.one_in(2) ? 0x24 : 0x25);
        } else if (roll < 96) {
            command(0, random_.one_in(3) ? 0x3C : random_.one_in(4) ? 0x3D : 0x3B);
        } else if (roll < 99) {
            data(axes(), static_cast<int>(random_.between(0x09, 0x0C)), position());
        } else {
            nasty();
        }
    }
    void drive() {
        const unsigned some = axes();
        if (random_.one_in(8)) speeds(some);
        if (random_.one_in(6)) mode(some, 3, drive_mode());
        if (!random_.one_in(4)) data(some, 0x06, pulses());
        if (random_.one_in(3)) data(some, 0x07, pulses());
        command(some, static_cast<int>(random_.one_in(4) ? random_.between(0x22, 0x23) : random_.between(0x20, 0x21)));
    }
    // Starts a drive and rewrites its speed, pulses and offset repeatedly while it runs, with few other accesses.
    void retarget() {
        const unsigned axis = 1u << random_.between(0, 3);
        const std::int64_t start = start_speed(), r = range();
        data(axis, 0x00, r);
        data(axis, 0x04, start);
        data(axis, 0x05, speed(start));
        const std::int64_t max_pulses =
            program_.ticks * start / std::max<std::int64_t>(r, 16'000) + 2;  // pulses at the start speed
        data(axis, 0x06, random_.between(0, max_pulses));
        data(axis, 0x07, random_.between(0, max_pulses));
        mode(axis, 3, drive_mode());
        command(axis, random_.one_in(3) ? 0x22 : 0x20);
        for (std::int64_t n = random_.between(1, 12); n > 0; --n) {
            now_ += random_.between(0, program_.ticks / 10);
            between_ = random_.one_in(2);
            const std::int64_t roll = random_.between(0, 7);
            if (roll == 0) data(axis, 0x06, random_.between(0, max_pulses));
            if (roll == 1) data(axis, 0x0D, random_.between(0, 50));
            if (roll == 2) data(axis, 0x02, accel());
            if (roll == 3) command(axis, random_.one_in(2) ? 0x26 : 0x12), read(12);
            if (roll > 3) data(axis, 0x05, speed(start));
        }
    }
    void rewrite() {
        const unsigned some = axes();
        static constexpr int codes[] = {0x04, 0x02, 0x03, 0x01, 0x0D, 0x07, 0x06, 0x00, 0x05, 0x05};
        const int code = random_.of(codes);
        data(some, code, value_of(code));
    }
    std::int64_t value_of(int code) {
        if (code == 0x00) return range();
        if (code == 0x01) return jerk();
        if (code == 0x02 || code == 0x03) return accel();
        if (code == 0x04) return start_speed();
        if (code == 0x05) return speed(start_speed());
        return code == 0x0D ? random_.between(0, 60) : pulses();
    }
    void wire() {
        const int axis = static_cast<int>(random_.between(0, 3));
        if (random_.one_in(4)) return encoder(axis);
        if (random_.one_in(25)) {
            Op op;
            op.tick = now_, op.between = between_, op.kind = Op::Kind::emergency, op.value = 0;
            program_.ops.push_back(op);
            op.tick += random_.between(1, program_.ticks / 20), op.value = 1;
            program_.ops.push_back(op);
            return;
        }
        const Pin pin = static_cast<Pin>(random_.between(0, pin_count - 1));
        pull(axis, pin, random_.one_in(3) ? program_.ticks / 8 : 20);
    }
    // Moves EP, sometimes across its comparison value.
    void encoder(int axis) {
        if (random_.one_in(3)) {
            mode(1u << axis, 2, 0x20 | random_.between(0, 7) << 9 | (random_.one_in(2) ? random_.between(0, 3) : 0));
            data(1u << axis, 0x0A, random_.between(-4, 4));
            data(1u << axis, 0x0B + static_cast<int>(random_.between(0, 1)), random_.between(-8, 8));
        }
        turn(axis);
    }
    void external() {
        const int axis = static_cast<int>(random_.between(0, 3));
        if (random_.one_in(3)) mode(1u << axis, 3, drive_mode());
        for (std::int64_t n = random_.between(1, 3); n > 0; --n) {
            pull(axis, random_.one_in(2) ? Pin::exp_plus : Pin::exp_minus, random_.one_in(3) ? program_.ticks / 8 : 4);
            now_ += random_.between(0, 6);
        }
    }
    void modes() {
        const unsigned some = axes();
        const std::int64_t roll = random_.between(0, 3);
        if (roll == 0) {
            const std::int64_t enables = random_.between(0, 255) & random_.between(0, 255) & 0xAA;
            mode(some, 1,
                 random_.between(0, 255) << 8 | enables | (random_.one_in(8) ? random_.between(0, 255) & 0x55 : 0));
        } else if (roll == 1) {
            std::int64_t bits = random_.between(0, 0xFFFF) & 0xEFE7 & ~0x5018;
            if (random_.one_in(12)) bits |= random_.between(0, 0xFFFF) & 0x5018;
            mode(some, 2, bits);
        } else {
            mode(some, 3, drive_mode());
        }
    }
    void poll() {
        const unsigned axis = 1u << random_.between(0, 3);
        const std::int64_t roll = random_.between(0, 6);
        if (roll == 0) {
            read(0);
        } else if (roll == 1) {
            command(axis, 0x0F), read(2 * static_cast<int>(random_.between(1, 3)));
        } else if (roll == 2) {
            read(random_.one_in(2) ? 8 : 10);
        } else if (roll < 6) {
            command(axis, static_cast<int>(random_.between(0x10, 0x13))), read(12), read(14);
        } else {  // as in an interrupt handler
            for (unsigned a = 0; a < 4; ++a) command(1u << a, 0x0F), read(6);
            if (random_.one_in(2)) command(0, 0x3D);
        }
    }
    void read_everything() {
        read(0);
        for (unsigned a = 0; a < 4; ++a) {
            for (int code = 0x10; code <= (program_.extended() ? 0x14 : 0x13); ++code) {
                command(1u << a, code);
                read(12);
                read(14);
            }
            for (int offset = 2; offset <= 6; offset += 2) read(offset);
        }
        read(8);
        read(10);
        read(0);
    }
    void nasty() {
        if (random_.one_in(6)) return write(0, 0x8000);
        if (random_.one_in(3))
            return command(static_cast<unsigned>(random_.between(0, 15)),
                           static_cast<int>(random_.between(0x10, 0x13)));
        static constexpr int strange[] = {0x0E, 0x14, 0x1F, 0x28, 0x2F, 0x3E, 0x40, 0x7F, 0xFF};
        command(static_cast<unsigned>(random_.between(0, 15)), random_.of(strange));
        read(2 * static_cast<int>(random_.between(0, 7)));
    }

    bool external_ = false;  // nEXPP and nEXPM start many drives
};

}  // namespace

Program make_program(std::uint64_t seed, std::uint64_t number, const ChipOptions& options) {
    return Maker(seed, number, options).make();
}

}  // namespace motionrack::mcx314::twin
