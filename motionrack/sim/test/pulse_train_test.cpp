// A divided clock in closed form against one that is counted clock by clock.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <motionrack/sim/blocks/pulse_train.hpp>
#include <motionrack/sim/kernel.hpp>
#include <vector>

namespace motionrack::sim {
namespace {

constexpr Duration clock = Duration{6};

/// A device with only a pulse train.
class Divider final : public DeferringDevice, private PulseTrain::Owner {
  public:
    explicit Divider(Kernel& k) : train(state_, clock), kernel(k), id(k.add(*this, Phase::cards, "divider")) {
        train.set_owner(this);
    }
    void on_scheduled(Instant now) override {
        train.act(now);
        train_watched();
    }
    void sync(Instant now) override { train.hand_over(now); }
    void set(std::int64_t divisor, int direction) {
        if (divisor == 0)
            train.stop(kernel.now());
        else
            train.run(divisor, direction, kernel.now());
        train_watched();
    }
    void train_watched() override { kernel.schedule(id, train.next(kernel.now())); }
    Instant train_now() const override { return kernel.now(); }

  private:
    PulseTrainState state_;

  public:
    PulseTrain train;
    Kernel& kernel;
    DeviceId id;
};

struct RecordingListener final : PositionListener, EdgeListener {
    void crossed(Instant now) override { crossings.push_back(now); }
    void rate_changed(double, double after, Instant) override { rate = after; }
    void edges(const EdgeBatch& batch) override {
        for (std::uint32_t i = 0; i < batch.size; ++i) edge_at.push_back(batch.origin + batch.tick * batch.at[i]);
        last = batch.first_count + batch.step * (static_cast<std::int64_t>(batch.size) - 1);
    }
    std::vector<Instant> crossings, edge_at;
    std::int64_t last = 0;
    double rate = 0;
};

RC_GTEST_PROP(PulseTrain, CountsLevelsEdgesAndCrossingsAreThoseOfACountedClock, ()) {
    Kernel kernel;
    Divider divider(kernel);
    RecordingListener listener;
    const int slot = divider.train.add_listener(listener);
    divider.train.set_edge_listener(&listener);
    kernel.start();
    std::int64_t count = 0, left = 0, reload = 0, high_left = 0, above = unwatched_above;
    int direction = 1;
    bool running = false;
    std::vector<Instant> edges, crossings;
    std::int64_t at = 0;
    std::size_t rises = 0;
    bool high = false;
    for (int setting = 0; setting < 12; ++setting) {
        const auto divisor = *rc::gen::weightedOneOf<std::int64_t>(
            {{1, rc::gen::just<std::int64_t>(0)}, {4, rc::gen::inRange<std::int64_t>(1, 9)}});
        const int turn = *rc::gen::element(1, 1, -1);
        divider.set(divisor, turn);
        if (divisor == 0) {
            running = false;
        } else if (!running || turn != direction) {
            running = true;
            left = divisor * 6;
            high_left = std::min(high_left, divisor * 3);
            direction = turn;
        }
        reload = divisor * 6;
        above = count + *rc::gen::inRange(1, 6);
        divider.train.watch(slot, unwatched_below, above);
        for (int ticks = *rc::gen::inRange(1, 90); ticks > 0; --ticks) {
            ++at;
            high_left = std::max<std::int64_t>(0, high_left - 1);
            if (running && --left == 0) {
                count += direction;
                left = reload;
                high_left = reload / 2;
                edges.push_back(Instant{at});
                if (count >= above && above != unwatched_above)
                    crossings.push_back(Instant{at}), above = unwatched_above;
            }
            kernel.run_until(Instant{at});
            RC_ASSERT(divider.train.count(Instant{at}) == count);
            RC_ASSERT(divider.train.level(Instant{at}) == (high_left > 0));
            rises += high_left > 0 && !high;
            high = high_left > 0;
        }
    }
    RC_ASSERT(listener.edge_at == edges);
    RC_ASSERT(rises == edges.size());
    RC_ASSERT(listener.crossings == crossings);
    RC_ASSERT(edges.empty() || listener.last == count);
}

TEST(PulseTrain, ReportsItsRateAndTheNextEdgeOfItsLine) {
    Kernel kernel;
    Divider divider(kernel);
    RecordingListener listener;
    divider.train.add_listener(listener);
    kernel.start();
    EXPECT_EQ(divider.train.next_edge(Instant{0}), never);
    divider.set(10, -1);
    EXPECT_DOUBLE_EQ(listener.rate, -1e10 / 60);
    EXPECT_EQ(divider.train.next_edge(Instant{0}), Instant{60});
    EXPECT_EQ(divider.train.next_edge(Instant{60}), Instant{90});
    EXPECT_EQ(divider.train.next_edge(Instant{90}), Instant{120});
    divider.set(0, 1);
    EXPECT_EQ(listener.rate, 0);
}

TEST(PulseTrain, ThatStopsInAPulseEndsIt) {
    Kernel kernel;
    Divider divider(kernel);
    kernel.start();
    divider.set(10, 1);
    kernel.run_until(Instant{60});
    divider.set(0, 1);
    EXPECT_EQ(divider.train.level(Instant{60}), 1) << "the pulse of the last period's end";
    EXPECT_EQ(divider.train.next_edge(Instant{60}), Instant{90});
    EXPECT_EQ(divider.train.next_edge(Instant{90}), never);
    kernel.run_until(Instant{70});
    divider.set(1, -1);
    EXPECT_EQ(divider.train.next_edge(Instant{70}), Instant{73}) << "low before the next pulse rises";
    EXPECT_EQ(divider.train.next_edge(Instant{73}), Instant{76});
}

}  // namespace
}  // namespace motionrack::sim
