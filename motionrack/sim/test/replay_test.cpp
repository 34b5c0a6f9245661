// A rack driven through its port, recorded, and replayed into a new one: the same history, bit for bit.
#include <gtest/gtest.h>

#include <motionrack/sim/input_log.hpp>
#include <motionrack/sim/parts/axis_mechanics.hpp>
#include <motionrack/sim/test/fake_pulses.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <vector>

namespace motionrack::sim {
namespace {

/// A card with three registers. 0: period of the pulses in microseconds (0: stop); 1: direction; 2: number of reads of
/// this register.
class PulseCard final : public RegisterDevice, public Device {
  public:
    PulseCard(Kernel& kernel, FakePulses& pulses) : kernel_(kernel), pulses_(pulses) {
        id = kernel.add(*this, Phase::cards, "card");
        interrupt = kernel.add_wire("card.int_n", 1);
    }
    std::uint16_t read(std::uint32_t offset) override { return offset == 2 ? ++state_.reads : peek(offset); }
    std::uint16_t peek(std::uint32_t offset) const override { return offset == 2 ? state_.reads : state_.direction; }
    void write(std::uint32_t offset, std::uint16_t value) override {
        if (offset == 1) {
            state_.direction = value;
            return;
        }
        pulses_.drive(microseconds(value == 0 ? 1 : value), value == 0 ? 0 : state_.direction ? -1 : 1);
        kernel_.set_wire(interrupt, value == 0);  // active (low) while pulses run
        kernel_.break_run();
    }
    void on_scheduled(Instant) override {}
    std::span<std::byte> state() override { return bytes_of(state_); }

    DeviceId id{};
    WireId interrupt{};

  private:
    struct {
        std::uint16_t direction = 0;
        std::uint16_t reads = 0;
    } state_;
    Kernel& kernel_;
    FakePulses& pulses_;
};

parts::AxisMechanicsSettings settings() {
    parts::AxisMechanicsSettings s;
    s.motor.start_stop_hz = 8000;
    s.limit_plus.position = 0.4;
    s.home.position = 0.1;
    return s;
}

struct World {
    World() { machine.connect(pulses), kernel.start(); }
    void apply(const LoggedInput& input) {
        switch (input.kind) {
            case InputKind::register_write:
                card.write(input.offset, input.value);
                break;
            case InputKind::register_read:
                (void)card.read(input.offset);
                break;
            case InputKind::force_wire:
                kernel.force(static_cast<WireId>(input.target), input.value);
                break;
            case InputKind::release_wire:
                kernel.release(static_cast<WireId>(input.target));
                break;
            case InputKind::fault:
                kernel.device(static_cast<DeviceId>(input.target)).fault("push", input.value, kernel.now());
                break;
        }
    }
    Kernel kernel;
    FakePulses pulses{kernel, {}};
    PulseCard card{kernel, pulses};
    parts::AxisMechanics machine{kernel, "X", settings()};
};

TEST(InputLog, AReplayGivesTheSameEventTrace) {
    World live;
    InputLog log;
    VirtualPort port(live.kernel, live.card, live.card.id, live.card.interrupt, nanoseconds(250), &log);
    auto from_outside = [&](const LoggedInput& input) {
        log.add(input);
        live.apply(input);
        live.kernel.settle();
    };
    port.write(0, 100);
    EXPECT_TRUE(port.wait(milliseconds(1)));
    port.pass(milliseconds(50));
    port.write(1, 1);
    port.write(0, 130);
    (void)port.read(2);
    port.pass(milliseconds(30));
    const auto home = static_cast<std::uint16_t>(live.machine.home_wire());
    from_outside({live.kernel.now(), InputKind::force_wire, home, 0, 1});
    port.pass(milliseconds(40));
    from_outside({live.kernel.now(), InputKind::release_wire, home, 0, 0});
    from_outside({live.kernel.now(), InputKind::fault, static_cast<std::uint16_t>(live.machine.id()), 0, 640});
    port.write(0, 0);
    EXPECT_FALSE(port.wait(milliseconds(20)));
    EXPECT_FALSE(live.kernel.conditions().empty());

    World again;
    replay(again.kernel, log.inputs(), live.kernel.now(), [&again](const LoggedInput& input) { again.apply(input); });
    EXPECT_EQ(again.kernel.now(), live.kernel.now());
    EXPECT_EQ(again.kernel.trace_hash(), live.kernel.trace_hash());
    EXPECT_EQ(again.kernel.state_hash(), live.kernel.state_hash());
    EXPECT_EQ(again.card.peek(2), 1);
}

TEST(VirtualPort, EveryAccessTakesItsTimeAndSlicesAreCalledBetweenRuns) {
    World w;
    VirtualPort port(w.kernel, w.card, w.card.id, w.card.interrupt, nanoseconds(250));
    int slices = 0;
    port.on_slice(milliseconds(10), [&slices] { ++slices; });
    port.write(1, 0);
    EXPECT_EQ(port.now(), nanoseconds(250));
    (void)port.read(2);
    EXPECT_EQ(port.now(), nanoseconds(500));
    slices = 0;
    port.pass(milliseconds(100));
    EXPECT_EQ(port.now(), nanoseconds(500) + milliseconds(100));
    EXPECT_EQ(slices, 10);
}

TEST(VirtualPort, WaitsForAnInterruptWithoutTimeoutIfAllowed) {
    World w;
    VirtualPort port(w.kernel, w.card, w.card.id, w.card.interrupt, nanoseconds(250));
    port.write(0, 0);
    port.on_slice(milliseconds(10), [&w] {
        if (w.kernel.now() < milliseconds(30)) return;
        w.card.write(0, 100);
        w.kernel.settle();
    });
    EXPECT_TRUE(port.wait(never));
    EXPECT_GE(port.now(), milliseconds(30));
    EXPECT_LT(port.now(), milliseconds(50));
}

TEST(VirtualPort, DrainsANearlyFullBufferBeforeTheRunContinues) {
    class Filler final : public Device {
      public:
        explicit Filler(Kernel& kernel) : kernel_(kernel), id_(kernel.add(*this, Phase::observers, "filler")) {
            kernel.schedule(id_, microseconds(1));
        }
        void on_scheduled(Instant now) override {
            if (++filled >= 8) kernel_.break_run();
            max_filled = std::max(max_filled, filled);
            kernel_.schedule(id_, now + microseconds(1));
        }
        int filled = 0;
        int max_filled = 0;

      private:
        Kernel& kernel_;
        DeviceId id_;
    };
    Kernel kernel;
    FakePulses pulses{kernel, {}};
    PulseCard card{kernel, pulses};
    Filler filler(kernel);
    kernel.start();
    VirtualPort port(kernel, card, card.id, card.interrupt, nanoseconds(250));
    port.on_slice(milliseconds(50), [&filler] { filler.filled = 0; });
    port.pass(milliseconds(10));
    EXPECT_EQ(filler.max_filled, 8);
}

TEST(VirtualPort, ABrokenRunIsASliceMoreAndShiftsNoOther) {
    class BreaksOnce final : public Device {
      public:
        BreaksOnce(Kernel& kernel, Instant at) : kernel_(kernel) {
            kernel.schedule(kernel.add(*this, Phase::observers, "breaks once"), at);
        }
        void on_scheduled(Instant) override { kernel_.break_run(); }

      private:
        Kernel& kernel_;
    };
    Kernel kernel;
    FakePulses pulses{kernel, {}};
    PulseCard card{kernel, pulses};
    const BreaksOnce breaks(kernel, milliseconds(13));
    kernel.start();
    VirtualPort port(kernel, card, card.id, card.interrupt, nanoseconds(250));
    std::vector<Instant> slices;
    port.on_slice(milliseconds(10), [&] { slices.push_back(kernel.now()); });
    port.pass(milliseconds(40));
    EXPECT_EQ(slices, (std::vector<Instant>{milliseconds(0), milliseconds(10), milliseconds(13), milliseconds(20),
                                            milliseconds(30), milliseconds(40)}));
}

}  // namespace
}  // namespace motionrack::sim
