// Tests of the card on the wires of a rack: the same ticks as the engine alone, at their instants.
#include <gtest/gtest.h>

#include <motionrack/cards/rtc5/model/card.hpp>
#include <motionrack/sim/test/allocation_count.hpp>
#include <vector>

namespace motionrack::rtc5 {
namespace {

/// Records wire changes.
class Listener final : public sim::Device {
  public:
    Listener(sim::Kernel& kernel, std::initializer_list<const char*> wires) {
        const sim::DeviceId id = kernel.add(*this, sim::Phase::observers, "listener");
        int pin = 0;
        for (const char* name : wires) {
            const sim::WireId wire = kernel.find_wire(name);
            kernel.listen(wire, id, pin++);
            wires_.push_back(wire);
        }
        heard.reserve(100'000);
        id_ = id;
    }
    void want(sim::Kernel& kernel) {
        for (const sim::WireId wire : wires_) kernel.subscribe(wire, id_, true);
    }
    void on_scheduled(Instant) override {}
    void on_wire(int pin, int level, Instant now) override { heard.push_back({pin, level, now}); }

    struct Heard {
        int pin, level;
        Instant at;
        bool operator==(const Heard&) const = default;
    };
    std::vector<Heard> heard;

  private:
    std::vector<sim::WireId> wires_;
    sim::DeviceId id_{};
};

constexpr Settings small{64, 32, 16};

void load(Engine& card, std::initializer_list<Command> list) {
    ASSERT_TRUE(card.set_start_list(1));
    for (const Command& c : list) ASSERT_TRUE(card.put(c));
}

TEST(Rtc5Card, TheLaserWireChangesAtHalfMicroseconds) {
    sim::Kernel kernel;
    Card card(kernel, "scan", small);
    Listener listener(kernel, {"scan.laser_on", "scan.busy"});
    kernel.start();
    load(card.engine(), {*list_command(Op::set_laser_delays, {7, 3}), *list_command(Op::set_mark_speed, {1000}),
                         *list_command(Op::mark_abs, {100, 0}), *list_command(Op::set_end_of_list, {})});
    ASSERT_TRUE(card.engine().execute_list(1));
    kernel.run_until(milliseconds(1));
    // The command comes after the end of tick 0, so ticks 1 to 10 move.
    const std::vector<Listener::Heard> expected = {{1, 1, microseconds(10)},
                                                   {0, 1, microseconds(10) + nanoseconds(3'500)},
                                                   {1, 0, microseconds(110)},
                                                   {0, 0, microseconds(110) + nanoseconds(1'500)}};
    EXPECT_EQ(listener.heard, expected);
    EXPECT_EQ(kernel.level(kernel.find_wire("scan.xout")), 100);
}

TEST(Rtc5Card, DeliversOutputsTickByTickToSubscribers) {
    sim::Kernel kernel;
    Card card(kernel, "scan", small);
    Listener listener(kernel, {"scan.xout"});
    kernel.start();
    listener.want(kernel);
    load(card.engine(), {*list_command(Op::set_mark_speed, {1000}), *list_command(Op::mark_abs, {40, 0}),
                         *list_command(Op::set_end_of_list, {})});
    ASSERT_TRUE(card.engine().execute_list(1));
    kernel.run_until(milliseconds(1));
    const std::vector<Listener::Heard> expected = {
        {0, 10, microseconds(10)}, {0, 20, microseconds(20)}, {0, 30, microseconds(30)}, {0, 40, microseconds(40)}};
    EXPECT_EQ(listener.heard, expected);
    const std::uint64_t events = kernel.events();
    kernel.run_until(whole_seconds(1));
    EXPECT_LE(kernel.events(), events + 2) << "a card at rest does not act";
}

TEST(Rtc5Card, EncoderLinesCountFourfoldAndBothAtOnceAreAnError) {
    sim::Kernel kernel;
    Card card(kernel, "scan", small);
    kernel.start();
    const sim::WireId a = kernel.find_wire("scan.enc1_a"), b = kernel.find_wire("scan.enc1_b");
    for (int i = 0; i < 10; ++i) {
        kernel.force(i % 2 ? b : a, i / 2 % 2 == 0);
        kernel.run_until(kernel.now() + microseconds(3));
    }
    kernel.run_until(kernel.now() + microseconds(20));
    EXPECT_EQ(card.engine().encoder(1), 10);
    kernel.force(a, 0);
    kernel.force(b, 0);
    kernel.run_until(kernel.now() + microseconds(20));
    EXPECT_EQ(card.engine().encoder(1), 10);
    EXPECT_EQ(card.engine().parts().flags.take_marking_info(), marking_bit("ENCODER_Y_SEQUENCE"));
}

TEST(Rtc5Card, AWordOnTheMcbspIsReadInTheNextTick) {
    sim::Kernel kernel;
    Card card(kernel, "scan", small);
    kernel.start();
    ASSERT_TRUE(card.engine().parts().fly.set_mcbsp_in(1, 1));
    kernel.force(kernel.find_wire("scan.mcbsp"), -70);
    kernel.run_until(microseconds(10));
    EXPECT_EQ(card.engine().output().a[0], -70);
    EXPECT_EQ(card.engine().parts().mcbsp.read(1), -70);
}

TEST(Rtc5Card, StartAndStopLinesWorkAndALostStartIsReported) {
    sim::Kernel kernel;
    Card card(kernel, "scan", small);
    kernel.start();
    load(card.engine(), {*list_command(Op::long_delay, {1000}), *list_command(Op::set_end_of_list, {})});
    card.engine().set_control_mode(control_ext_start);
    const auto pulse = [&](const char* wire) {
        kernel.force(kernel.find_wire(wire), 0);
        kernel.run_until(kernel.now() + microseconds(50));
        kernel.force(kernel.find_wire(wire), 1);
        kernel.run_until(kernel.now() + microseconds(50));
    };
    pulse("scan.start_n");
    EXPECT_TRUE(card.engine().busy());
    EXPECT_EQ(kernel.level(kernel.find_wire("scan.busy")), 1);
    pulse("scan.start_n");
    pulse("scan.stop_n");
    EXPECT_FALSE(card.engine().busy());
    const auto conditions = kernel.conditions();
    ASSERT_EQ(conditions.size(), 2u);
    EXPECT_EQ(describe(conditions[0], "scan"),
              "card scan: at 0.00011 s TRIGGER_ERROR: a start came while a list was running. The list continues");
    EXPECT_NE(describe(conditions[1], "scan").find("an external start was lost"), std::string::npos);
}

TEST(Rtc5Card, ARestoredSnapshotContinuesIdenticallyAndRunsDoNotAllocate) {
    sim::Kernel kernel;
    Card card(kernel, "scan", small);
    Listener listener(kernel, {"scan.xout", "scan.laser_on"});
    kernel.start();
    listener.want(kernel);
    ASSERT_TRUE(card.engine().parts().encoders.simulate(1));
    load(card.engine(), {*list_command(Op::set_fly_x, {1}), *list_command(Op::mark_abs, {5000, 100}),
                         *list_command(Op::jump_abs, {0, 0}), *list_command(Op::mark_abs, {300, 2000}),
                         *list_command(Op::set_end_of_list, {})});
    ASSERT_TRUE(card.engine().execute_list(1));
    kernel.run_until(microseconds(333));
    const sim::Snapshot snapshot = kernel.snapshot();
    listener.heard.clear();
    const std::uint64_t before = sim::allocations();
    kernel.run_until(milliseconds(20));
    EXPECT_EQ(sim::allocations(), before);
    const auto first = listener.heard;
    const std::uint64_t hash = kernel.state_hash();
    ASSERT_TRUE(card.engine().goto_xy(77, 77));
    kernel.run_until(milliseconds(30));
    kernel.restore(snapshot);
    listener.heard.clear();
    kernel.run_until(milliseconds(20));
    EXPECT_EQ(listener.heard, first);
    EXPECT_EQ(kernel.state_hash(), hash);
    EXPECT_GT(first.size(), 1000u);
}

/// Returns the state hash of a card whose list 1 has these commands from position 0 on.
std::uint64_t hash_of(std::initializer_list<Command> list) {
    sim::Kernel kernel;
    Card card(kernel, "scan", small);
    kernel.start();
    load(card.engine(), list);
    EXPECT_TRUE(card.engine().set_start_list(1));
    return kernel.state_hash();
}

TEST(Rtc5Card, TheStateHashDistinguishesListsByTheirContentsOnly) {
    const Command a = *list_command(Op::mark_abs, {5000, 100}), b = *list_command(Op::mark_abs, {5000, 101}),
                  rel = *list_command(Op::mark_rel, {5000, 100}), nop = *list_command(Op::list_nop, {});
    const std::vector<std::uint64_t> hashes = {hash_of({}),     hash_of({a}),      hash_of({b}),
                                               hash_of({rel}),  hash_of({a, b}),   hash_of({b, a}),
                                               hash_of({a, a}), hash_of({nop, a}), hash_of({nop, nop})};
    for (std::size_t i = 0; i < hashes.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) EXPECT_NE(hashes[i], hashes[k]) << i << ' ' << k;

    sim::Kernel kernel;
    Card card(kernel, "scan", small);
    kernel.start();
    load(card.engine(), {b, nop});
    const sim::Snapshot other = kernel.snapshot();
    load(card.engine(), {a, b});
    ASSERT_TRUE(card.engine().set_start_list(1));
    EXPECT_EQ(kernel.state_hash(), hashes[4]) << "what was overwritten is not in it";
    kernel.restore(other);
    ASSERT_TRUE(card.engine().set_start_list(1));
    EXPECT_EQ(kernel.state_hash(), hash_of({b, nop}));
}

TEST(Rtc5Card, TheStateHashDoesNotReadTheWholeListMemory) {
    sim::Kernel kernel;
    Card card(kernel, "scan");
    kernel.start();
    std::size_t held = 0, hashed = 0;
    for (std::size_t i = 0; i < kernel.device_count(); ++i) {
        sim::Device& device = kernel.device(static_cast<sim::DeviceId>(i));
        held += device.state().size();
        hashed += device.hashed_state().size();
    }
    EXPECT_GT(held, sizeof(Command) * max_list_memory) << "a snapshot holds all";
    EXPECT_LT(hashed, 16'384u);
}

}  // namespace
}  // namespace motionrack::rtc5
