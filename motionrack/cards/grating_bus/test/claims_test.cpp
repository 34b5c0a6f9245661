// The four claims of CN104360639A, each demonstrated from outside: by lines, states, registers and frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/cards/grating_bus/driver/grating_card.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <set>

#include "rig.hpp"

namespace motionrack::grating_bus {
namespace {

constexpr Duration cycle = microseconds(200);  // the source's period

/// Changes of chosen wires, in order.
class WireLog final : public sim::Kernel::WireObserver {
  public:
    struct Change {
        Instant at;
        std::string wire;
        int level;
        friend bool operator==(const Change&, const Change&) = default;
    };
    explicit WireLog(Crate& crate) : crate_(crate) {
        crate.watch_wires();
        crate.kernel.observe_wires(this);
    }
    void wire_changed(sim::WireId wire, int level, Instant now) override {
        const std::string& name = crate_.kernel.wire_name(wire);
        if (!changes.empty() && changes.back().wire == name && changes.back().at == now)
            changes.back().level = level;
        else
            changes.push_back({now, name, level});
    }
    /// Returns the levels of a wire since `from`, with the instants of their changes.
    std::vector<std::pair<Duration, int>> of(const std::string& wire, Instant from) const {
        std::vector<std::pair<Duration, int>> out;
        for (const Change& change : changes)
            if (change.wire == wire && change.at >= from) out.emplace_back(change.at - from, change.level);
        return out;
    }
    std::vector<Change> changes;

  private:
    Crate& crate_;
};

using Levels = std::vector<std::pair<Duration, int>>;
constexpr Duration ns(std::int64_t n) {
    return nanoseconds(n);
}

std::vector<CardSettings> three_cards() {
    std::vector<CardSettings> out = crew(2, 2);
    for (CardSettings& s : out) s.addresses = {5, 2};
    return out;
}

TEST(GratingBusClaims, Claim1OneCardGivesClockAndAddressAndTheOthersReadTheSameDataWithIt) {
    Crate crate(three_cards(), 6);
    crate.run(cycle - ns(100));
    WireLog log(crate);
    crate.run(ns(600));
    // One card outputs the clock, from which hold, READ and address follow; the address comes when READ is low.
    EXPECT_EQ(log.of("bus.clk", cycle), (Levels{{ns(0), 1}}));
    EXPECT_EQ(log.of("bus.hold", cycle), (Levels{{ns(0), 1}, {ns(230), 0}}));
    EXPECT_EQ(log.of("bus.read_n", cycle), (Levels{{ns(20), 0}, {ns(80), 1}, {ns(130), 0}, {ns(190), 1}}));
    EXPECT_EQ(log.of("bus.addr", cycle), (Levels{{ns(20), 5}, {ns(130), 2}, {ns(230), 0x7F}}));
    // The other cards begin at the rising edge of the clock, and take address and data from the bus together with the
    // first.
    EXPECT_EQ(log.of("c1.state", cycle), log.of("c0.state", cycle));
    EXPECT_EQ(log.of("c2.state", cycle), log.of("c0.state", cycle));
    for (const std::size_t card : {0, 1, 2}) {
        const Frame& frame = crate.heard(card).back().frame;
        EXPECT_EQ(frame.instant(), cycle);
        EXPECT_EQ(frame.addresses[0], 5);
        EXPECT_EQ(frame.addresses[1], 2);
        EXPECT_EQ(frame.counts[0], static_cast<std::uint32_t>(crate.truth(5, cycle)));
        EXPECT_EQ(frame.counts[1], static_cast<std::uint32_t>(crate.truth(2, cycle)));
    }
    EXPECT_EQ(crate.bus.lines().all_conflicts(), 0u);
    // Without READ the host gives no address; without the clock's edge a slave takes no frame.
    crate.kernel.force(crate.kernel.find_wire("bus.read_n"), 1);
    crate.kernel.settle();
    const Instant stuck = crate.kernel.now();
    crate.run(cycle);
    EXPECT_TRUE(log.of("bus.addr", stuck).empty());
    crate.kernel.release(crate.kernel.find_wire("bus.read_n"));
    crate.kernel.force(crate.kernel.find_wire("bus.clk"), 0);
    crate.kernel.settle();
    const Instant silent = crate.kernel.now();
    crate.run(cycle);
    EXPECT_TRUE(log.of("c1.state", silent).empty());
}

TEST(GratingBusClaims, Claim2TheCardHasProcessorLogicShiftersAndConnector) {
    std::vector<CardSettings> settings = three_cards();
    Crate crate(settings, 6, {}, false);
    // The logic collects frames without the processor, which reads them through the memory interface.
    crate.run(3 * cycle + microseconds(1));
    sim::VirtualPort port(crate.kernel, *crate.cards[0], crate.cards[0]->id(), crate.cards[0]->interrupt_wire(),
                          nanoseconds(40));
    GratingCard processor(port, port);
    const auto info = processor.open();
    ASSERT_TRUE(info) << info.error().message;
    EXPECT_TRUE(info->host);
    const auto reading = processor.read();
    ASSERT_TRUE(reading) << reading.error().message;
    EXPECT_EQ(reading->frame.sequence, 3u);
    EXPECT_EQ(reading->counts()[0], crate.truth(5, 3 * cycle));
    // The direction of the shifters between logic and connector determines the card's role.
    EXPECT_EQ(crate.cards[0]->peek(offset("ROLE")) & 7, 7) << "host: clock and address outwards";
    EXPECT_EQ(crate.cards[1]->peek(offset("ROLE")) & 7, 0) << "slave: inwards";
    settings[1].clock_shifter = Shifter::out;
    Crate wrong(settings, 6);
    wrong.run(cycle);
    EXPECT_NE(wrong.status(1) & field("STATUS", "DIRECTION").mask, 0);
    // They shift 5 V on the connector side to 3.3 V on the logic side, at pins of P2 named by the source.
    EXPECT_EQ(map::signal_levels[0].supply_v, 5.0);
    EXPECT_EQ(map::signal_levels[1].supply_v, 3.3);
    EXPECT_EQ(std::size(map::connector_pins), 8u) << "the clock's and seven of the address";
}

TEST(GratingBusClaims, Claim3TheLogicIsAStateMachineOfThirteenStates) {
    Crate crate(crew(0, 3), 3);
    crate.run(cycle - ns(100));
    WireLog log(crate);
    crate.run(ns(800));
    std::vector<int> walked;
    for (const auto& [at, state] : log.of("c0.state", cycle)) walked.push_back(state);
    EXPECT_EQ(walked, (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 5, 6, 7, 8, 9, 10, 5, 11, 12, 0}));
    EXPECT_EQ(std::set<int>(walked.begin(), walked.end()).size(), 13u);
    const auto entered = [&](int state) {
        for (const auto& [at, entered_state] : log.of("c0.state", cycle))
            if (entered_state == state) return at;
        return Duration{-1};
    };
    EXPECT_EQ(entered(1), ns(0)) << "with the pulse of 200 us";
    EXPECT_EQ(log.of("bus.addr", cycle).front(), (std::pair<Duration, int>{entered(2), 0})) << "S2: the address";
    EXPECT_EQ(log.of("bus.addr", cycle)[1], (std::pair<Duration, int>{entered(8), 1})) << "S8: another one";
    EXPECT_EQ(log.of("c0.frame_done", cycle), (Levels{{entered(12), 1}, {entered(12) + ns(10), 0}}))
        << "S12: the pulse that reading is complete";
    EXPECT_EQ(crate.heard(0).back().at, cycle + entered(12));
    // One scale needs no S6 to S10; without a pulse the card stays in S0.
    Crate one(crew(0, 1), 1);
    one.run(cycle - ns(100));
    WireLog log_of_one(one);
    one.run(ns(600));
    walked.clear();
    for (const auto& [at, state] : log_of_one.of("c0.state", cycle)) walked.push_back(state);
    EXPECT_EQ(walked, (std::vector<int>{1, 2, 3, 4, 5, 11, 12, 0}));
    one.run(cycle - microseconds(1));
    EXPECT_EQ(one.kernel.level(one.kernel.find_wire("c0.state")), 0);
}

TEST(GratingBusClaims, Claim4T1Is20NsT2Is30NsAndT3Is30Ns) {
    Crate crate(crew(1, 2), 2);
    crate.run(cycle - ns(100));
    WireLog log(crate);
    crate.run(ns(600));
    for (const char* wire : {"c0.state", "c1.state"}) {
        const Levels states = log.of(wire, cycle);
        std::vector<std::pair<int, Duration>> lasted;
        for (std::size_t i = 0; i + 1 < states.size(); ++i)
            lasted.emplace_back(states[i].second, states[i + 1].first - states[i].first);
        const std::vector<std::pair<int, Duration>> expected = {
            {1, ns(20)}, {2, ns(30)}, {3, ns(30)},  {4, ns(10)}, {5, ns(10)},  {6, ns(10)}, {7, ns(20)},
            {8, ns(30)}, {9, ns(30)}, {10, ns(10)}, {5, ns(10)}, {11, ns(10)}, {12, ns(10)}};
        EXPECT_EQ(lasted, expected) << wire;
    }
    EXPECT_EQ(crate.cards[1]->peek(offset("T1")), 200);
    EXPECT_EQ(crate.cards[1]->peek(offset("T2")), 300);
    EXPECT_EQ(crate.cards[1]->peek(offset("T3")), 300);
}

}  // namespace
}  // namespace motionrack::grating_bus
