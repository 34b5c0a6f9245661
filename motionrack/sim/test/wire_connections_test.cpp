// Connected wires.
#include <gtest/gtest.h>

#include <motionrack/sim/parts/axis_mechanics.hpp>
#include <motionrack/sim/test/fake_pulses.hpp>
#include <motionrack/sim/wire_connections.hpp>

namespace motionrack::sim {
namespace {

class JunctionListener final : public Device {
  public:
    explicit JunctionListener(Kernel& kernel) : id(kernel.add(*this, Phase::cards, "ear")) {}
    void on_scheduled(Instant) override {}
    void on_wire(int pin, int level, Instant now) override { heard.push_back({pin, level, now}); }
    struct Change {
        int pin = 0;
        int level = 0;
        Instant at{};
        friend bool operator==(const Change&, const Change&) = default;
    };
    DeviceId id;
    std::vector<Change> heard;
};

TEST(WireConnections, CopyALevelToManyWiresAtTheSameInstantAndInvertItIfRequested) {
    Kernel kernel;
    JunctionListener listener(kernel);
    WireConnections junctions(kernel);
    const WireId from = kernel.add_wire("from", 1), same = kernel.add_wire("same", 0),
                 other = kernel.add_wire("other", 0);
    kernel.listen(same, listener.id, 1);
    kernel.listen(other, listener.id, 2);
    junctions.join(from, same);
    junctions.join(from, other, true);
    kernel.start();
    kernel.run_until(Instant{10});
    EXPECT_EQ(kernel.level(same), 1);
    EXPECT_EQ(kernel.level(other), 0);
    kernel.set_wire(from, 0);
    kernel.settle();
    EXPECT_EQ(listener.heard,
              (std::vector<JunctionListener::Change>{{1, 1, Instant{0}}, {1, 0, Instant{10}}, {2, 1, Instant{10}}}));
}

TEST(WireConnections, ALazyWireStaysLazyUntilAConnectedWireHasASubscriber) {
    Kernel kernel;
    FakePulses pulses(kernel, {{Instant{0}, microseconds(10), +1}});
    parts::AxisMechanicsSettings s;
    s.motor.start_stop_hz = 200'000;
    s.encoder.counts_per_rev = 3200;
    parts::AxisMechanics machine(kernel, "X", s);
    machine.connect(pulses);
    JunctionListener listener(kernel);
    WireConnections junctions(kernel);
    const WireId z = kernel.add_wire("card.xin2", 0), unused = kernel.add_wire("card.yin2", 0);
    kernel.listen(z, listener.id, 0);
    junctions.join(machine.index_wire(), z);
    junctions.join(machine.index_wire(), unused);
    kernel.start();
    kernel.run_until(milliseconds(64));  // two revolutions
    EXPECT_EQ(kernel.level(z), 1);
    EXPECT_LE(kernel.events(), 2u);
    kernel.run_until(milliseconds(65));
    EXPECT_EQ(kernel.level(z), 0);
    kernel.subscribe(z, listener.id, true);
    kernel.run_until(milliseconds(100));
    EXPECT_EQ(listener.heard, (std::vector<JunctionListener::Change>{{0, 1, milliseconds(96)},
                                                                     {0, 0, milliseconds(96) + microseconds(10)}}));
    kernel.subscribe(z, listener.id, false);
    const std::uint64_t events = kernel.events();
    kernel.run_until(milliseconds(1000));
    EXPECT_EQ(kernel.events(), events);
    EXPECT_EQ(listener.heard.size(), 2u);
}

}  // namespace
}  // namespace motionrack::sim
