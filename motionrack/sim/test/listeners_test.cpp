// Common parts of position functions: ranges and intervals, notifications, edges in batches.
#include <gtest/gtest.h>

#include <motionrack/sim/edge_batcher.hpp>
#include <motionrack/sim/listeners.hpp>
#include <vector>

namespace motionrack::sim {
namespace {

TEST(Interval, ReportsASideAsLeftAtTheFirstPositionOfTheNextSide) {
    constexpr Interval cam{10, 20};
    for (const auto& [from, last, next] :
         {std::array<std::int64_t, 3>{5, 9, 10}, {10, 20, 21}, {20, 10, 9}, {30, 21, 20}}) {
        EXPECT_FALSE(cam.side_of(from).left(last)) << from;
        EXPECT_TRUE(cam.side_of(from).left(next)) << from;
        EXPECT_NE(cam.has(last), cam.has(next));
    }
}

struct ListenersEar final : PositionListener {
    void crossed(Instant) override { ++crossings; }
    void rate_changed(double from, double to, Instant) override { before = from, after = to; }
    int crossings = 0;
    double before = 0, after = 0;
};

TEST(Listeners, NotifiesOnceTheListenerWhoseRangeIsLeft) {
    Listeners listeners;
    Listeners::Watches watches{};
    ListenersEar first, second;
    watches[static_cast<std::size_t>(listeners.add(first))] = {-5, 5};
    watches[static_cast<std::size_t>(listeners.add(second))] = {unwatched_below, 9};
    EXPECT_EQ(Listeners::unwatched_range(watches), (Range{-5, 5}));
    listeners.notify_crossed(watches, 4, Instant{0});
    EXPECT_EQ(first.crossings, 0);
    listeners.notify_crossed(watches, 5, Instant{0});
    listeners.notify_crossed(watches, 6, Instant{0});
    EXPECT_EQ(first.crossings, 1);
    EXPECT_EQ(second.crossings, 0);
    EXPECT_EQ(Listeners::unwatched_range(watches), (Range{unwatched_below, 9}));
    listeners.notify_rate(3, -4, Instant{0});
    EXPECT_EQ(second.before, 3);
    EXPECT_EQ(second.after, -4);
}

struct Batches final : EdgeListener {
    void edges(const EdgeBatch& batch) override {
        sizes.push_back(batch.size);
        for (std::uint32_t i = 0; i < batch.size; ++i) {
            at.push_back(batch.origin + batch.tick * batch.at[i]);
            counts.push_back(batch.first_count + batch.step * static_cast<std::int64_t>(i));
        }
    }
    std::vector<std::uint32_t> sizes;
    std::vector<Instant> at;
    std::vector<std::int64_t> counts;
};

TEST(EdgeBatcher, ABatchEndsWhereItIsFullWhereTheDirectionTurnsAndWhereTimeDoesNotFit) {
    Batches heard;
    EdgeBatcher row;
    const std::int64_t full = EdgeBatch::capacity;
    std::vector<Instant> at;
    std::vector<std::int64_t> counts;
    const auto add = [&](std::int64_t tick, std::int64_t count, int step) {
        at.push_back(Instant{tick});
        counts.push_back(count);
        row.add(heard, at.back(), count, step);
    };
    for (std::int64_t i = 1; i <= full + 3; ++i) add(10 * i, i, 1);
    add(1'000'000, full + 2, -1);
    add(1'000'000, full + 1, -1);
    add(1'000'000 + 0xFFFF'FFFFLL, full, -1);
    add(1'000'000 + 0x1'0000'0000LL, full - 1, -1);
    row.hand_over(heard);
    row.hand_over(heard);
    EXPECT_EQ(heard.sizes, (std::vector<std::uint32_t>{static_cast<std::uint32_t>(full), 3, 3, 1}));
    EXPECT_EQ(heard.at, at);
    EXPECT_EQ(heard.counts, counts);
}

}  // namespace
}  // namespace motionrack::sim
