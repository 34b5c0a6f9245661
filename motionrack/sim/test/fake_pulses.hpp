// A substitute for a card: pulses of constant rate, law after law, as a PositionFunction.
#pragma once

#include <algorithm>
#include <array>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/position_function.hpp>
#include <string>
#include <vector>

namespace motionrack::sim {

/// Pulses from `at` on, one every `period`, the first at `at` + `period`. `direction`: +1, -1, or 0 for standstill.
struct PulseLaw {
    Instant at{};
    Duration period{1};
    std::int64_t direction = 0;
};

class FakePulses final : public DeferringDevice, public PositionFunction {
  public:
    FakePulses(Kernel& kernel, std::vector<PulseLaw> laws, const std::string& name = "pulses")
        : kernel_(kernel), laws_(std::move(laws)), id_(kernel.add(*this, Phase::cards, name)) {
        reschedule();
    }

    // ---- PositionFunction
    std::int64_t count(Instant t) const override { return state_.base + state_.law.direction * steps(t); }
    double rate(Instant) const override { return rate_of(state_.law); }
    void watch(int slot, std::int64_t below, std::int64_t above) override {
        state_.watches[static_cast<std::size_t>(slot)] = {below, above};
        ++watch_calls;
        reschedule();
    }
    int add_listener(PositionListener& listener) override {
        MOTIONRACK_ASSERT(listeners_.size() < max_listeners);
        listeners_.push_back(&listener);
        return static_cast<int>(listeners_.size()) - 1;
    }
    void set_edge_listener(EdgeListener* listener) override {
        edge_listener_ = listener;
        state_.edges_made = steps(kernel_.now());
    }

    void deliver_edges() override { make_edges(kernel_.now()); }

    // ---- Device
    void on_scheduled(Instant now) override {
        if (state_.next_law < laws_.size() && laws_[state_.next_law].at <= now)
            change_law(laws_[state_.next_law++], now);
        for (std::size_t i = 0; i < listeners_.size(); ++i) {
            const std::int64_t c = count(now);
            if (c > state_.watches[i].below && c < state_.watches[i].above) continue;
            state_.watches[i] = {};
            listeners_[i]->crossed(now);
        }
        reschedule();
    }
    void sync(Instant now) override { make_edges(now); }
    std::span<std::byte> state() override { return bytes_of(state_); }

    /// Replaces the current law; call it between runs of the kernel.
    void drive(Duration period, std::int64_t direction) {
        change_law({kernel_.now(), period, direction}, kernel_.now());
        reschedule();
    }
    static double rate_of(const PulseLaw& law) {
        return static_cast<double>(law.direction) * 1e10 / static_cast<double>(law.period.count());
    }

    int watch_calls = 0;

  private:
    struct Bounds {
        std::int64_t below = unwatched_below;
        std::int64_t above = unwatched_above;
    };
    struct State {
        std::int64_t base = 0;
        PulseLaw law{};
        std::uint64_t next_law = 0;
        std::int64_t edges_made = 0;
        std::array<Bounds, max_listeners> watches{};
    };

    std::int64_t steps(Instant t) const {
        return state_.law.direction == 0 ? 0 : (t - state_.law.at) / state_.law.period;
    }

    void change_law(const PulseLaw& law, Instant now) {
        make_edges(now);
        const double before = rate_of(state_.law);
        state_.base = count(now);
        state_.law = {now, law.period, law.direction};
        state_.edges_made = 0;
        for (PositionListener* listener : listeners_) listener->rate_changed(before, rate_of(state_.law), now);
    }

    void make_edges(Instant now) {
        const std::int64_t until = steps(now);
        if (!edge_listener_) state_.edges_made = until;
        while (state_.edges_made < until) {
            batch_.origin = state_.law.at;
            batch_.tick = state_.law.period;
            batch_.step = static_cast<int>(state_.law.direction);
            batch_.first_count = state_.base + batch_.step * (state_.edges_made + 1);
            batch_.size = 0;
            while (state_.edges_made < until && batch_.size < EdgeBatch::capacity)
                batch_.at[batch_.size++] = static_cast<std::uint32_t>(++state_.edges_made);
            edge_listener_->edges(batch_);
        }
    }

    void reschedule() {
        const Instant now = kernel_.now();
        const std::int64_t c = count(now);
        Instant next = state_.next_law < laws_.size() ? std::max(laws_[state_.next_law].at, now) : never;
        for (std::size_t i = 0; i < listeners_.size(); ++i) {
            const Bounds& w = state_.watches[i];
            if (c <= w.below || c >= w.above) {
                next = std::min(next, now + Duration{1});
                continue;
            }
            const std::int64_t bound = state_.law.direction > 0 ? w.above : w.below;
            if (state_.law.direction == 0 || bound == unwatched_above || bound == unwatched_below) continue;
            const std::int64_t n = (bound - state_.base) * state_.law.direction;
            if (n < 1'000'000'000'000) next = std::min(next, state_.law.at + state_.law.period * n);
        }
        kernel_.schedule(id_, next);
    }

    Kernel& kernel_;
    std::vector<PulseLaw> laws_;
    DeviceId id_;
    State state_{};
    std::vector<PositionListener*> listeners_;
    EdgeListener* edge_listener_ = nullptr;
    EdgeBatch batch_{};
};

}  // namespace motionrack::sim
