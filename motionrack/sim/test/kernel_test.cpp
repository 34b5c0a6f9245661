// The kernel: order of events, wires, conditions, snapshots, and runs without allocation.
#include <gtest/gtest.h>

#include <functional>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/test/allocation_count.hpp>

namespace motionrack::sim {
namespace {

/// A device whose callbacks are functions that a test sets.
class Puppet final : public DeferringDevice {
  public:
    void on_scheduled(Instant now) override {
        if (on_act) on_act(now);
    }
    void on_wire(int pin, int level, Instant now) override {
        if (on_wire_) on_wire_(pin, level, now);
    }
    int level_at(int, Instant now) const override { return on_level ? on_level(now) : 0; }
    void wanted_changed(int, bool wanted, Instant) override { wants.push_back(wanted); }
    void sync(Instant) override { ++syncs; }
    std::span<std::byte> state() override { return bytes_of(value); }

    std::function<void(Instant)> on_act;
    std::function<void(int, int, Instant)> on_wire_;
    std::function<int(Instant)> on_level;
    std::vector<bool> wants;
    std::int64_t value = 0;
    int syncs = 0;
};

class Scribe final : public Kernel::WireObserver {
  public:
    void wire_changed(WireId wire, int level, Instant now) override {
        text += std::to_string(static_cast<int>(wire)) + "=" + std::to_string(level) + "@" +
                std::to_string(now.count()) + " ";
    }
    std::string text;
};

// ---- Order

TEST(Kernel, RunsEventsByInstantThenPhaseThenOrderOfRequest) {
    Kernel kernel;
    std::array<Puppet, 5> puppets;
    const Phase phases[5] = {Phase::observers, Phase::parts, Phase::cards, Phase::cards, Phase::wires};
    std::string order;
    std::array<DeviceId, 5> ids{};
    for (std::size_t i = 0; i < 5; ++i) {
        ids[i] = kernel.add(puppets[i], phases[i], "p");
        puppets[i].on_act = [&order, i](Instant now) {
            order += static_cast<char>('a' + i) + std::to_string(now.count()) + " ";
        };
    }
    kernel.start();
    for (const std::size_t i : {0u, 1u, 3u, 2u}) kernel.schedule(ids[i], Instant{7});
    kernel.schedule(ids[4], Instant{9});
    EXPECT_EQ(kernel.run_until(Instant{8}), RunEnd::reached);
    EXPECT_EQ(order, "d7 c7 b7 a7 ");
    EXPECT_EQ(kernel.now(), Instant{8});
    kernel.run_until(Instant{9});
    EXPECT_EQ(order, "d7 c7 b7 a7 e9 ");
    EXPECT_EQ(kernel.events(), 5u);
}

TEST(Kernel, ALaterRequestReplacesTheEarlierOneAndThePastBecomesNow) {
    Kernel kernel;
    Puppet p;
    const DeviceId id = kernel.add(p, Phase::cards, "p");
    std::vector<Instant> acts;
    p.on_act = [&](Instant now) {
        acts.push_back(now);
        if (acts.size() == 1) kernel.schedule(id, Instant{5});  // already past: runs at once
    };
    kernel.start();
    kernel.schedule(id, Instant{10});
    kernel.schedule(id, Instant{20});
    kernel.run_until(Instant{100});
    EXPECT_EQ(acts, (std::vector<Instant>{Instant{20}, Instant{20}}));
    kernel.schedule(id, Instant{150});
    kernel.schedule(id, never);
    kernel.run_until(Instant{200});
    EXPECT_EQ(acts.size(), 2u);
}

TEST(Kernel, AnInterruptedRunEndsAfterTheEventWithAllDevicesSyncedAndContinuesAfterwards) {
    Kernel kernel;
    Puppet p;
    const DeviceId id = kernel.add(p, Phase::cards, "p");
    p.on_act = [&](Instant now) {
        kernel.break_run();
        kernel.schedule(id, now + Duration{10});
    };
    kernel.start();
    kernel.schedule(id, Instant{10});
    EXPECT_EQ(kernel.run_until(Instant{25}), RunEnd::broken);
    EXPECT_EQ(kernel.now(), Instant{10});
    EXPECT_EQ(p.syncs, 1);
    EXPECT_EQ(kernel.run_until(Instant{25}), RunEnd::broken);
    EXPECT_EQ(kernel.run_until(Instant{25}), RunEnd::reached);
    EXPECT_EQ(kernel.now(), Instant{25});
}

// ---- Wires

TEST(Kernel, WireChangesAreDeliveredFirstInFirstOutAtTheirInstant) {
    Kernel kernel;
    Puppet driver, listener;
    const DeviceId d = kernel.add(driver, Phase::cards, "driver");
    const DeviceId l = kernel.add(listener, Phase::cards, "listener");
    const WireId a = kernel.add_wire("a", 0), b = kernel.add_wire("b", 0), echo = kernel.add_wire("echo", 0);
    kernel.listen(a, l, 1);
    kernel.listen(b, l, 2);
    kernel.listen(echo, l, 3);
    std::string heard;
    listener.on_wire_ = [&](int pin, int level, Instant now) {
        heard += std::to_string(pin) + ":" + std::to_string(level) + "@" + std::to_string(now.count()) + " ";
        if (pin == 1) kernel.set_wire(echo, level);
    };
    driver.on_act = [&](Instant) {
        kernel.set_wire(a, 1);
        kernel.set_wire(b, 1);
        kernel.set_wire(b, 1);  // no change
        kernel.set_wire(a, 0);
    };
    kernel.start();
    kernel.schedule(d, Instant{5});
    kernel.run_until(Instant{6});
    EXPECT_EQ(heard, "1:1@5 2:1@5 1:0@5 3:1@5 3:0@5 ");
}

TEST(Kernel, WireLevelsSetBeforeTheStartAreInitialLevels) {
    Kernel kernel;
    Scribe scribe;
    const WireId a = kernel.add_wire("a", 0);
    kernel.observe_wires(&scribe);
    kernel.set_wire(a, 1);
    kernel.start();
    kernel.run_until(Instant{1});
    EXPECT_EQ(kernel.level(a), 1);
    EXPECT_EQ(scribe.text, "");
}

TEST(Kernel, AForcedWireKeepsItsLevelUntilItIsReleasedToItsDriver) {
    Kernel kernel;
    Scribe scribe;
    const WireId a = kernel.add_wire("a", 0);
    kernel.observe_wires(&scribe);
    kernel.start();
    kernel.force(a, 1);
    kernel.set_wire(a, 1);
    kernel.set_wire(a, 0);
    kernel.settle();
    EXPECT_EQ(kernel.level(a), 1);
    kernel.set_wire(a, 7);
    kernel.release(a);
    kernel.settle();
    EXPECT_EQ(kernel.level(a), 7);
    EXPECT_EQ(scribe.text, "0=1@0 0=7@0 ");
}

struct LazyWorld {
    LazyWorld() {
        owner_id = kernel.add(owner, Phase::parts, "owner");
        listener_id = kernel.add(listener, Phase::cards, "ear");
        wire = kernel.add_wire("z", 0);
        kernel.listen(wire, listener_id, 0);
        kernel.drive_lazily(wire, owner_id, 0);
        owner.on_level = [](Instant now) { return static_cast<int>(now.count() / 10 % 2); };
        listener.on_wire_ = [this](int, int level, Instant) { heard.push_back(level); };
        kernel.start();
    }
    Kernel kernel;
    Puppet owner, listener;
    DeviceId owner_id{}, listener_id{};
    WireId wire{};
    std::vector<int> heard;
};

TEST(Kernel, ReadsALazyWireFromItsOwnerWithoutSubscribers) {
    LazyWorld w;
    EXPECT_TRUE(w.kernel.lazy(w.wire));
    EXPECT_FALSE(w.kernel.wanted(w.wire));
    w.kernel.run_until(Instant{15});
    EXPECT_EQ(w.kernel.level(w.wire), 1);
    w.kernel.run_until(Instant{25});
    EXPECT_EQ(w.kernel.level(w.wire), 0);
    EXPECT_EQ(w.kernel.events(), 0u);
    w.kernel.run_until(Instant{35});
    w.kernel.subscribe(w.wire, w.listener_id, true);
    EXPECT_EQ(w.kernel.level(w.wire), 1);
    w.kernel.subscribe(w.wire, w.listener_id, true);
    w.kernel.set_wire(w.wire, 0);
    w.kernel.settle();
    EXPECT_EQ(w.heard, std::vector<int>{0});
    w.kernel.subscribe(w.wire, w.listener_id, false);
    EXPECT_EQ(w.owner.wants, (std::vector<bool>{true, false}));
}

TEST(Kernel, ALazyWireThatWasForcedReturnsToTheLevelOfItsOwner) {
    LazyWorld w;
    w.kernel.run_until(Instant{15});
    w.kernel.force(w.wire, 0);
    w.kernel.settle();
    EXPECT_EQ(w.kernel.level(w.wire), 0);
    w.kernel.subscribe(w.wire, w.listener_id, true);  // subscribes while the wire is forced
    EXPECT_EQ(w.kernel.level(w.wire), 0);
    w.kernel.release(w.wire);
    w.kernel.settle();
    EXPECT_EQ(w.kernel.level(w.wire), 1);
    EXPECT_EQ(w.heard, std::vector<int>{1});
    w.kernel.subscribe(w.wire, w.listener_id, false);
    w.kernel.force(w.wire, 0);
    w.kernel.run_until(Instant{25});
    w.kernel.release(w.wire);
    EXPECT_EQ(w.kernel.level(w.wire), 0);
}

TEST(Kernel, FindsWiresByNameOrReportsThatNoneExists) {
    Kernel kernel;
    const WireId a = kernel.add_wire("motion.xlmtp", 1);
    EXPECT_EQ(kernel.find_wire("motion.xlmtp"), a);
    EXPECT_EQ(kernel.find_wire("motion.xlmtm"), WireId::none);
    EXPECT_EQ(kernel.wire_name(a), "motion.xlmtp");
}

TEST(Kernel, AnInverterThatDrivesItselfIsReportedAndNotAnEndlessLoop) {
    Kernel kernel;
    Puppet p;
    const DeviceId id = kernel.add(p, Phase::wires, "p");
    const WireId a = kernel.add_wire("a", 0);
    kernel.listen(a, id, 0);
    int heard = 0;
    p.on_wire_ = [&](int, int level, Instant) {
        heard = level;
        kernel.set_wire(a, 1 - level);
    };
    kernel.start();
    kernel.force(a, 1);
    kernel.settle();
    EXPECT_TRUE(kernel.conditions().empty());
    kernel.release(a);
    kernel.settle();
    ASSERT_EQ(kernel.conditions().size(), 1u);
    EXPECT_EQ(kernel.conditions()[0].device, no_device);
    EXPECT_EQ(kernel.conditions()[0].code, wires_never_settle);
    EXPECT_EQ(kernel.conditions()[0].a, static_cast<std::int64_t>(Kernel::index(a)));
    EXPECT_EQ(kernel.level(a), heard) << "nobody believes in another level than there is";
    kernel.force(a, 1 - heard);
    kernel.run_until(Instant{10});
    EXPECT_EQ(kernel.level(a), heard) << "the world goes on";
}

// ---- Conditions

TEST(Kernel, KeepsTheLatestConditionsAndReportsTheNumberOfDroppedOnes) {
    Kernel kernel;
    Puppet p;
    const DeviceId id = kernel.add(p, Phase::cards, "p");
    kernel.start();
    const auto max_conditions = static_cast<std::int64_t>(Kernel::condition_capacity);
    for (std::int64_t i = 0; i < max_conditions; ++i) kernel.report(id, 3, i, -i);
    EXPECT_EQ(kernel.dropped_conditions(), 0u);
    EXPECT_EQ(kernel.conditions().front().a, 0);
    for (std::int64_t i = max_conditions; i < max_conditions + 10; ++i) kernel.report(id, 3, i, -i);
    EXPECT_EQ(kernel.dropped_conditions(), 10u);
    const std::vector<Condition> all = kernel.conditions();
    ASSERT_EQ(all.size(), Kernel::condition_capacity);
    EXPECT_EQ(all.front().a, 10);
    EXPECT_EQ(all.back().a, max_conditions + 9);
    EXPECT_EQ(all.back().b, -max_conditions - 9);
    EXPECT_EQ(all.back().device, id);
    EXPECT_EQ(all.back().code, 3);
}

// ---- Snapshots

/// Two devices that drive each other's wires and report conditions, by a pseudo-random rule.
struct Clockwork {
    Clockwork() {
        for (std::size_t i = 0; i < 2; ++i) {
            ids[i] = kernel.add(puppets[i], i == 0 ? Phase::cards : Phase::parts, "p");
            wires[i] = kernel.add_wire(i == 0 ? "a" : "b", 0);
            puppets[i].value = static_cast<std::int64_t>(i) + 1;
        }
        for (std::size_t i = 0; i < 2; ++i) {
            kernel.listen(wires[1 - i], ids[i], 0);
            puppets[i].on_wire_ = [this, i](int, int level, Instant) { puppets[i].value += 3 * level + 1; };
            puppets[i].on_act = [this, i](Instant now) {
                std::int64_t& v = puppets[i].value;
                v = (v * 1'103'515'245 + 12'345) % 2'147'483'648;
                kernel.set_wire(wires[i], static_cast<int>(v >> 10 & 1));
                if (v % 7 == 0) kernel.report(ids[i], 1, v);
                kernel.schedule(ids[i], now + Duration{v % 1000});
            };
        }
        kernel.start();
        for (const DeviceId id : ids) kernel.schedule(id, Instant{1});
    }
    Kernel kernel;
    std::array<Puppet, 2> puppets;
    std::array<DeviceId, 2> ids{};
    std::array<WireId, 2> wires{};
};

TEST(Kernel, ARunFromASnapshotEqualsTheUninterruptedRun) {
    Clockwork whole;
    whole.kernel.run_until(Instant{1'000'000});
    Clockwork cut;
    cut.kernel.run_until(Instant{333'333});
    const Snapshot snapshot = cut.kernel.snapshot();
    cut.kernel.run_until(Instant{777'777});
    EXPECT_NE(cut.kernel.state_hash(), whole.kernel.state_hash());
    cut.kernel.restore(snapshot);
    EXPECT_EQ(cut.kernel.now(), Instant{333'333});
    cut.kernel.run_until(Instant{1'000'000});
    EXPECT_EQ(cut.kernel.state_hash(), whole.kernel.state_hash());
    EXPECT_EQ(cut.kernel.trace_hash(), whole.kernel.trace_hash());
    EXPECT_EQ(cut.kernel.events(), whole.kernel.events());
    ASSERT_EQ(cut.kernel.conditions().size(), whole.kernel.conditions().size());
    EXPECT_EQ(cut.kernel.conditions().back().a, whole.kernel.conditions().back().a);
}

TEST(Kernel, ASnapshotRestoredOverAPendingWireChangeDiscardsIt) {
    Kernel kernel;
    Scribe scribe;
    const WireId a = kernel.add_wire("a", 0);
    kernel.observe_wires(&scribe);
    kernel.start();
    const Snapshot snapshot = kernel.snapshot();
    kernel.set_wire(a, 1);
    kernel.restore(snapshot);
    kernel.settle();
    EXPECT_EQ(scribe.text, "");
    EXPECT_EQ(kernel.level(a), 0);
}

TEST(Kernel, ASnapshotHasTheWireChangesThatHaveNotReachedTheirListeners) {
    struct World {
        World() {
            kernel.listen(a, kernel.add(listener, Phase::cards, "ear"), 0);
            listener.on_wire_ = [this](int, int level, Instant) { listener.value = 10 * listener.value + level + 1; };
            kernel.start();
        }
        Kernel kernel;
        Puppet listener;
        WireId a = kernel.add_wire("a", 0);
    } first, copy;
    first.kernel.set_wire(first.a, 1);
    first.kernel.set_wire(first.a, 0);
    const std::uint64_t before = first.kernel.state_hash();
    copy.kernel.restore(first.kernel.snapshot());
    EXPECT_EQ(copy.kernel.state_hash(), before);
    EXPECT_EQ(first.kernel.state_hash(), before) << "a snapshot only looks";
    for (World* one : {&first, &copy}) one->kernel.run_until(Instant{5});
    EXPECT_EQ(first.listener.value, 21);
    EXPECT_EQ(copy.listener.value, 21);
    EXPECT_EQ(copy.kernel.state_hash(), first.kernel.state_hash());
}

TEST(Kernel, TheTraceHashDistinguishesEventTracesWithEqualEnds) {
    auto hash = [](Instant when, int times) {
        Kernel kernel;
        const WireId a = kernel.add_wire("a", 0);
        kernel.start();
        kernel.run_until(when);
        for (int i = 0; i < 2 * times; ++i) kernel.set_wire(a, (i + 1) % 2);
        kernel.settle();
        return kernel.trace_hash();
    };
    EXPECT_EQ(hash(Instant{5}, 1), hash(Instant{5}, 1));
    EXPECT_NE(hash(Instant{5}, 1), hash(Instant{6}, 1));
    EXPECT_NE(hash(Instant{5}, 1), hash(Instant{5}, 2));
}

TEST(Kernel, ARunAllocatesNothing) {
    Clockwork w;
    const std::uint64_t before = allocations();
    w.kernel.run_until(Instant{5'000'000});
    EXPECT_EQ(allocations(), before);
    EXPECT_GT(w.kernel.events(), 1000u);
    EXPECT_FALSE(w.kernel.conditions().empty());
    EXPECT_GT(allocations(), before);  // allocations() does count
}

}  // namespace
}  // namespace motionrack::sim
