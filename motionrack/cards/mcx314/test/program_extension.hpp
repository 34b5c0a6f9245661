// Generates the MCX314As parts of random register programs: extension modes, home searches, synchronous actions,
// bounce.
#pragma once

#include <motionrack/cards/mcx314/test/program_paths.hpp>

namespace motionrack::mcx314::twin {

class ExtensionActions : protected Paths {
  protected:
    using Paths::Paths;

    void begin_extension() {
        for (unsigned a = 0; a < 4; ++a) {
            if (random_.one_in(2)) data(1u << a, 0x60, extension_mode());
            if (random_.one_in(3)) data(1u << a, 0x64, action_mode());
            if (random_.one_in(3)) data(1u << a, 0x0E, jerk());
            data(1u << a, 0x61, slow_speed());
        }
    }

    void extension() {
        const std::int64_t roll = random_.between(0, 12);
        if (roll == 0) return data(axes(), 0x60, extension_mode());
        if (roll == 1) return data(axes(), 0x64, action_mode());
        if (roll == 2) return command(axes(), random_.one_in(2) ? 0x63 : 0x65);
        if (roll == 3) return data(axes(), random_.one_in(2) ? 0x61 : 0x0E, random_.one_in(2) ? slow_speed() : jerk());
        if (roll == 4) return command(1u << random_.between(0, 3), 0x14), read(12), read(14);
        if (roll < 7) return bounce();
        if (roll == 7) return turn_ring();
        if (roll == 8) return act();
        roll == 12 ? turn_wheel() : search();
    }

  private:
    std::int64_t word(std::int64_t high, std::int64_t low) { return high << 16 | low; }
    std::int64_t slow_speed() {
        if (nasty_ && random_.one_in(8)) return random_.between(0, 65'535);
        return random_.one_in(6) ? random_.between(1, 8000) : random_.between(500, 3000);
    }
    std::int64_t extension_mode() {
        if (nasty_ && random_.one_in(6)) return random_.between(0, 0xFFFF'FFFF);
        std::int64_t low = random_.between(0, 0x3F) & random_.between(0, 0x3F);
        if (random_.one_in(2)) low |= random_.between(0, 31) << 8;
        if (random_.one_in(8)) low |= random_.between(1, 2) << 13;
        return word(home_mode(), low);
    }
    std::int64_t home_mode() {
        std::int64_t high = random_.between(0, 0xFF) | (random_.one_in(2) ? 0x55 : 0);
        if (random_.one_in(2)) high |= random_.between(0, 31) << 8;
        return high | random_.between(0, 3) << 13;
    }
    std::int64_t action_mode() {
        if (nasty_ && random_.one_in(6)) return random_.between(0, 0xFFFF'FFFF);
        std::int64_t conditions = std::int64_t{1} << random_.between(0, 9);
        if (random_.one_in(3)) conditions |= std::int64_t{1} << random_.between(0, 9);
        if (random_.one_in(2)) conditions |= random_.between(0, 7) << 13;
        std::int64_t actions = random_.one_in(4) ? 0 : std::int64_t{1} << random_.between(0, 15);
        if (random_.one_in(2)) actions |= std::int64_t{1} << random_.between(0, 15);
        return word(actions, conditions);
    }
    // Makes short pulses on an input, about as long as the shortest filter's delay.
    void bounce() {
        const int axis = static_cast<int>(random_.between(0, 3));
        const Pin pin = static_cast<Pin>(random_.between(0, pin_count - 1));
        const std::int64_t back = now_;
        bool high = true;
        for (std::int64_t n = random_.between(1, 8); n > 0; --n) {
            high = !high;
            if (axis == 0 && pin == Pin::exp_plus)
                emergency(high);
            else
                input(axis, pin, high);
            now_ += random_.one_in(3) ? random_.between(14, 19) : random_.between(0, 40);
            between_ = random_.one_in(2);
        }
        if (!high && axis == 0 && pin == Pin::exp_plus) emergency(true);
        if (!high && !random_.one_in(8)) input(axis, pin, true);
        now_ = back;
    }
    void emergency(bool high) {
        Op op;
        op.tick = now_, op.between = between_, op.kind = Op::Kind::emergency, op.value = high;
        program_.ops.push_back(op);
    }
    // Turns a hand wheel with lines A and B at nEXPP and nEXPM; sometimes it bounces.
    void turn_wheel() {
        const int axis = static_cast<int>(random_.between(0, 3));
        mode(1u << axis, 3, 0x18 | random_.between(0, 3));
        data(1u << axis, 0x06, random_.between(0, 5));
        const std::int64_t back = now_, max_ticks = random_.one_in(2) ? 40 : program_.ticks / 30;
        std::int64_t phase = 2;  // both High
        for (std::int64_t n = random_.between(2, 16); n > 0; --n) {
            phase += random_.one_in(4) ? -1 : 1;
            input(axis, Pin::exp_plus, (phase & 3) == 1 || (phase & 3) == 2);
            input(axis, Pin::exp_minus, (phase & 3) >= 2);
            now_ += random_.between(0, max_ticks);
            between_ = random_.one_in(2);
        }
        input(axis, Pin::exp_plus, true);
        input(axis, Pin::exp_minus, true);
        now_ = back;
    }
    void turn_ring() {
        const unsigned axis = 1u << random_.between(0, 3);
        data(axis, 0x60, extension_mode() | 0x10);
        data(axis, 0x0B, random_.one_in(4) ? position() : random_.between(0, 50));
        if (random_.one_in(2)) data(axis, 0x09, position());
        if (random_.one_in(3)) mode(axis, 1, random_.between(0, 15) << 9);
        command(axis, static_cast<int>(random_.between(0x20, 0x23)));
    }
    void act() {
        const int axis = static_cast<int>(random_.between(0, 3));
        data(1u << axis, 0x64, action_mode());
        if (random_.one_in(2)) command(1u << axis, static_cast<int>(random_.between(0x20, 0x23)));
        write(14, 0);
        write(12, random_.between(0, 300));
        if (random_.one_in(3)) command(1u << axis, random_.one_in(2) ? 0x65 : 0x10);
        if (!random_.one_in(3)) return;
        input(axis, Pin::in3, false);
        const std::int64_t back = now_;
        now_ += random_.between(0, 60);
        input(axis, Pin::in3, true);
        now_ = back;
    }
    // Starts a home search with switches that act for a while.
    void search() {
        const int axis = static_cast<int>(random_.between(0, 3));
        if (random_.one_in(2)) data(1u << axis, 0x60, extension_mode());
        if (random_.one_in(2)) data(1u << axis, 0x06, random_.between(0, 30));
        if (random_.one_in(4)) mode(1u << axis, 2, random_.one_in(2) ? 4 : 0);
        static constexpr Pin pins[] = {Pin::in0, Pin::in0, Pin::in1, Pin::in1,        Pin::in1,
                                       Pin::in2, Pin::in2, Pin::in2, Pin::limit_plus, Pin::limit_minus};
        bool high[pin_count] = {true, true, true, true, true, true, true, true, true, true};
        if (random_.one_in(3)) input(axis, Pin::in1, high[1] = false);
        command(1u << axis, 0x62);
        for (std::int64_t n = random_.between(2, 12); n > 0; --n) {
            now_ += random_.between(0, program_.ticks / random_.between(10, 60));
            between_ = random_.one_in(2);
            const Pin pin = random_.of(pins);
            bool& level = high[static_cast<int>(pin)];
            level = !level;
            input(axis, pin, level);
            if (random_.one_in(4)) command(1u << axis, 0x0F), read(4);
            if (random_.one_in(30)) command(1u << axis, static_cast<int>(random_.between(0x20, 0x27)));
        }
        for (int p = 0; p < pin_count; ++p)
            if (!high[p] && !random_.one_in(8)) input(axis, static_cast<Pin>(p), true);
    }
};

}  // namespace motionrack::mcx314::twin
