// All intervals in which the corrected position was outside the field.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <motionrack/mark/overflow.hpp>

namespace motionrack::mark {
namespace {

using rtc5::Engine;
using rtc5::Op;

constexpr double counts_per_bit = 5184;

struct LogSink final : rtc5::Sink {
    explicit LogSink(OverflowLog& to) : log(to) {}
    void samples(const rtc5::Samples& b) override { log.block(b); }
    OverflowLog& log;
};

/// Starts jumps and marks near the field edges while the simulated belt moves the output.
void start_list(Engine& card) {
    EXPECT_TRUE(card.parts().encoders.simulate(3));
    EXPECT_TRUE(card.set_start_list(1));
    const auto put = [&](Op op, std::initializer_list<double> p = {}) {
        EXPECT_TRUE(card.put(*rtc5::list_command(op, p)));
    };
    put(Op::set_mark_speed, {20'000});
    put(Op::set_jump_speed, {60'000});
    put(Op::set_fly_x, {0.6});
    for (int i = 0; i < 40; ++i) {
        put(Op::jump_abs, {0, 540'000});
        put(Op::jump_abs, {520'000.0 - 9'000 * i, i % 3 == 0 ? 530'000.0 : -20'000});
        put(Op::mark_abs, {-460'000.0 - 9'000 * i, i % 2 == 0 ? -527'000.0 : 515'000});
    }
    put(Op::fly_return, {0, 0});
    put(Op::set_end_of_list);
    EXPECT_TRUE(card.execute_list(1));
}

TEST(OverflowLog, HasTheTicksAtWhichTheFlagsBecomeSet) {
    parts::ConveyorSettings settings;
    settings.profile = {{0, 0.6 * 1e6 / counts_per_bit}};
    const parts::Conveyor track = *parts::Conveyor::make(settings);
    OverflowLog log(counts_per_bit, track);
    LogSink sink(log);
    Engine card;
    start_list(card);
    ASSERT_TRUE(card.run_to_rest(1'000'000, &sink));
    log.finish(card.tick());

    // A second card with the same list, queried after each tick; reading clears bits 0 to 3 of the marking info.
    struct Seen {
        int bit;
        std::int64_t from, to;
        double beyond;
    };
    std::vector<Seen> seen;
    std::array<int, 4> open{-1, -1, -1, -1};
    Engine slow;
    start_list(slow);
    struct None final : rtc5::Sink {
        void samples(const rtc5::Samples&) override {}
    } none;
    for (std::int64_t tick = 0; tick <= card.tick(); ++tick) {
        std::uint32_t word = 0;
        if (tick < card.tick()) slow.run_until(tick + 1, &none), word = slow.parts().flags.take_marking_info();
        const rtc5::Point at = slow.output().corrected;
        const double beyond[4] = {-524288 - at.x, at.x - 524287, -524288 - at.y, at.y - 524287};
        for (std::size_t bit = 0; bit < 4; ++bit) {
            const bool set = (word >> bit & 1) != 0;
            if (set && open[bit] < 0)
                open[bit] = static_cast<int>(seen.size()), seen.push_back({static_cast<int>(bit), tick, 0, 0});
            if (!set && open[bit] >= 0) seen[static_cast<std::size_t>(open[bit])].to = tick, open[bit] = -1;
            if (set)
                seen[static_cast<std::size_t>(open[bit])].beyond =
                    std::max(seen[static_cast<std::size_t>(open[bit])].beyond, beyond[bit]);
        }
    }
    ASSERT_GT(seen.size(), 40u);
    std::sort(seen.begin(), seen.end(),
              [](const Seen& a, const Seen& b) { return a.to != b.to ? a.to < b.to : a.bit < b.bit; });
    ASSERT_EQ(log.all().size(), seen.size());
    static constexpr const char* names[4] = {"FLY_X_UNDERFLOW", "FLY_X_OVERFLOW", "FLY_Y_UNDERFLOW", "FLY_Y_OVERFLOW"};
    bool some_marking = false, some_dark = false;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const Overflow& o = log.all()[i];
        EXPECT_EQ(o.name, names[seen[i].bit]) << i;
        EXPECT_EQ(o.from_s, static_cast<double>(seen[i].from) * 1e-5) << i;
        EXPECT_EQ(o.to_s, static_cast<double>(seen[i].to) * 1e-5) << i;
        EXPECT_EQ(o.beyond_mm, seen[i].beyond / counts_per_bit) << i;
        EXPECT_NEAR(o.part.x, o.field.x - track.travel(o.from_s), 1e-9);
        (o.marking ? some_marking : some_dark) = true;
    }
    EXPECT_TRUE(some_marking && some_dark);
    EXPECT_EQ(log.lost(), 0u);
}

}  // namespace
}  // namespace motionrack::mark
