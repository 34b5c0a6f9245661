// Tests that a start which waits for its count does not depend on earlier states of the card: after a rewind and after
// a reset the card behaves like one without that history.
#include <algorithm>
#include <motionrack/cards/rtc5/test/rig.hpp>

namespace motionrack::rtc5 {
namespace {

/// Inputs whose encoder counts are constant and jump to another value at given ticks.
class Jumps final : public Inputs {
  public:
    struct Jump {
        std::int64_t tick;
        std::int32_t count;
    };
    explicit Jumps(std::vector<Jump> all) : all_(std::move(all)) {}
    void counts(int, std::int64_t first, std::span<std::int32_t> out) override {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = at(first + static_cast<std::int64_t>(i));
    }

  private:
    std::int32_t at(std::int64_t tick) const {
        std::int32_t count = 0;
        for (const Jump& jump : all_)
            if (jump.tick <= tick) count = jump.count;
        return count;
    }
    std::vector<Jump> all_;
};

/// A card whose list begins 50 counts after an external start.
struct Station {
    explicit Station(std::vector<Jumps::Jump> jumps) : inputs(std::move(jumps)) {
        rig.card.set_inputs(&inputs);
        set_up();
    }
    void set_up() {
        rig.card.set_control_mode(control_ext_start);
        ASSERT_TRUE(rig.card.set_ext_start_delay(50, 0));
        rig.begin();
        rig.put(Op::long_delay, {10'000});
        rig.put(Op::set_end_of_list);
    }
    /// Returns the tick in which the list begins; -1: not within `ticks`.
    std::int64_t begins_within(std::int64_t ticks) {
        Beginning heard;
        rig.card.set_listener(&heard);
        rig.run(ticks);
        rig.card.set_listener(nullptr);
        return heard.tick;
    }

    struct Beginning final : ListListener {
        void started(std::int64_t at, StartFate) override { tick = at; }
        void ended(std::int64_t) override {}
        std::int64_t tick = -1;
    };
    Rig rig;
    Jumps inputs;
};

TEST(Rtc5Starts, APendingStartIsDueAtItsCountAfterARewind) {
    // The encoder has 60 counts for ten ticks only; a query at a later time, or from another position, must not use
    // them.
    const std::vector<Jumps::Jump> jumps = {{20, 60}, {30, 0}, {700, 60}};
    Station rewound(jumps), fresh(jumps);
    rewound.rig.run(10);
    const State before = rewound.rig.card.state();
    rewound.rig.run(30);
    rewound.rig.card.parts().starts.trigger();
    ASSERT_EQ(rewound.begins_within(100), -1) << "the belt stands";
    rewound.rig.card.mutable_state() = before;
    fresh.rig.run(10);
    for (Station* station : {&rewound, &fresh}) {
        station->rig.card.parts().starts.trigger();
        EXPECT_EQ(station->begins_within(100), 20);
    }
}

TEST(Rtc5Starts, APendingStartIsDueAtItsCountAfterARestore) {
    const std::vector<Jumps::Jump> jumps = {{100, 30}};
    Station station(jumps);
    station.rig.run(10);
    station.rig.card.parts().starts.trigger();
    station.rig.run(10);
    State further = station.rig.card.state();
    further.encoders.counters[0].travel += 20;  // as after ten ticks of the simulated encoder
    ASSERT_EQ(station.begins_within(200), -1) << "20 counts are missing";
    station.rig.card.mutable_state() = further;
    EXPECT_EQ(station.begins_within(200), 100);
}

TEST(Rtc5Starts, APendingStartIsDueAtItsCountAfterReloadingTheProgram) {
    const std::vector<Jumps::Jump> jumps = {{50, -100}, {200, 0}};
    Station reset(jumps), fresh(jumps);
    reset.rig.card.parts().starts.trigger();
    ASSERT_EQ(reset.begins_within(100), -1) << "the belt has gone back";
    fresh.rig.run(100);
    for (Station* station : {&reset, &fresh}) {
        station->rig.card.load_program_file();
        station->set_up();
        station->rig.card.parts().starts.trigger();
        EXPECT_EQ(station->begins_within(300), 200) << "100 counts forward, of which 50 were wanted";
    }
}

}  // namespace
}  // namespace motionrack::rtc5
