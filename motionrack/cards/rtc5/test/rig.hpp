// A card for tests: short functions that load and run lists, and the samples of the card.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <motionrack/cards/rtc5/model/engine.hpp>
#include <vector>

namespace motionrack::rtc5 {

struct Rig final : Sink {
    Rig() : card(Settings{4096, 1000, 1000}) {}

    Engine card;
    std::vector<std::int32_t> x, y;
    std::vector<int> laser;

    void samples(const Samples& b) override {
        x.insert(x.end(), b.x.begin(), b.x.end());
        y.insert(y.end(), b.y.begin(), b.y.end());
        laser.insert(laser.end(), b.laser.begin(), b.laser.end());
    }
    void put(Op op, std::initializer_list<double> p = {}) {
        const auto made = list_command(op, p);
        ASSERT_TRUE(made) << made.error().message;
        const auto done = card.put(*made);
        ASSERT_TRUE(done) << done.error().message;
    }
    /// Ends the loaded list, runs it, and returns the number of ticks that it took.
    std::int64_t go(std::int64_t ticks = 1'000'000) {
        put(Op::set_end_of_list);
        EXPECT_TRUE(card.execute_list(1));
        const std::int64_t begin = card.tick();
        EXPECT_TRUE(card.run_to_rest(ticks, this));
        return card.tick() - begin;
    }
    void begin(int list = 1) { ASSERT_TRUE(card.set_start_list(list)); }
    void run(std::int64_t ticks) { card.run_until(card.tick() + ticks, this); }
    std::int32_t last_x() const { return card.output().a[0]; }
    std::int32_t last_y() const { return card.output().a[1]; }
};

}  // namespace motionrack::rtc5
