// Cards on a bus with a host and manually driven wires.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <motionrack/cards/ioflex02/model/bus.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <string>
#include <tests/environment.hpp>
#include <vector>

namespace motionrack::ioflex02 {

/// The lines B A of a phase 0 .. 3.
inline int lines_of_phase(std::int64_t phase) {
    constexpr int lines[4] = {0, 1, 3, 2};
    return lines[phase & 3];
}

inline Settings loaded_settings() {
    Settings out;
    out.preloaded = true;
    return out;
}

struct Rig {
    explicit Rig(const Settings& settings = loaded_settings(), Duration access = Duration{0})
        : card(kernel, "c1", settings),
          bus(kernel, "c1"),
          port(kernel, bus, bus.id(), bus.interrupt_wire(), access),
          base(settings.base_address) {
        bus.plug(card);
    }
    void start() {
        kernel.start();
        run(nanoseconds(1));
    }
    void run(Duration time) { port.pass(time); }
    void set(const std::string& pin, int level) {
        kernel.set_wire(kernel.find_wire("c1." + pin), level);
        kernel.settle();
    }
    int level(const std::string& pin) { return kernel.level(kernel.find_wire("c1." + pin)); }
    /// Moves an encoder by `counts`, an edge every `period`.
    void turn(int axis, std::int64_t counts, Duration period = microseconds(1)) {
        const std::string number = std::to_string(axis);
        for (std::int64_t i = 0; i != counts; i += counts > 0 ? 1 : -1) {
            phase[axis] += counts > 0 ? 1 : -1;
            const int lines = lines_of_phase(phase[axis]);
            kernel.set_wire(kernel.find_wire("c1.a" + number), lines & 1);
            kernel.set_wire(kernel.find_wire("c1.b" + number), lines >> 1);
            run(period);
        }
    }
    void pulse(const std::string& pin) {
        set(pin, 1);
        run(microseconds(1));
        set(pin, 0);
        run(microseconds(1));
    }
    std::uint16_t read(std::uint32_t at) { return port.read(base + at); }
    void write(std::uint32_t at, int value) { port.write(base + at, static_cast<std::uint16_t>(value)); }
    std::int32_t read24(std::uint32_t at) { return read(at) | (read(at + 2) << 16); }
    void command(int axis, tIOFlexCmd cmd) { write(offset("CMD"), cmd << (2 * axis)); }
    void capture(int more = 0) { write(offset("STROBE"), 1 | more); }
    void feed(const std::vector<std::uint8_t>& raw, bool end = true) {
        write(offset("CONTROL"), field("CONTROL", "CONFIGURE").mask);
        for (std::size_t i = 0; i < raw.size(); i += 2)
            write(offset("DATA"), raw[i] | (i + 1 < raw.size() ? raw[i + 1] << 8 : 0));
        if (end) write(offset("CONTROL"), field("CONTROL", "END").mask);
    }
    std::vector<CardCondition> conditions() {
        std::vector<CardCondition> out;
        for (const sim::Condition& c : kernel.conditions()) out.push_back(static_cast<CardCondition>(c.code));
        return out;
    }

    sim::Kernel kernel;
    Card card;
    Bus bus;
    sim::VirtualPort port;
    std::uint32_t base;
    std::int64_t phase[4] = {};
};

/// Captures all values at this instant (STROBE) and returns the position of an axis, counts.
inline int position(Rig& rig, int axis) {
    rig.capture();
    return signed24(rig.read24(offset("POS0_L") + 4 * static_cast<std::uint32_t>(axis)));
}
inline int status(Rig& rig, int axis) {
    return rig.read(offset("STS")) >> axis & 1;
}
/// Captures all values at this instant and reads a register of one axis.
inline int of_axis(Rig& rig, int axis, std::uint32_t at) {
    rig.capture();
    rig.write(offset("AXIS"), axis);
    return rig.read(at);
}

}  // namespace motionrack::ioflex02
