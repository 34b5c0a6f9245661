// Position functions between cards and parts: a constant one and an inverted one.
//
//   open step input   ──► FixedPosition ──► AxisMechanics
//   encoder ──► InvertedPosition (tracks A and B crossed over: count -> -count) ──► card
#pragma once

#include <memory>
#include <motionrack/sim/position_function.hpp>
#include <vector>

namespace motionrack::rack {

/// Constant position 0.
class FixedPosition final : public sim::PositionFunction {
  public:
    std::int64_t count(Instant) const override { return 0; }
    double rate(Instant) const override { return 0; }
    void watch(int, std::int64_t, std::int64_t) override {}
    int add_listener(sim::PositionListener&) override { return listeners_++; }
    void set_edge_listener(sim::EdgeListener*) override {}
    void deliver_edges() override {}

  private:
    int listeners_ = 0;
};

/// `of` with all counts and rates negated. Counts describe the same lines with A and B exchanged: phase 1 (A) becomes
/// phase 3 (B). Takes listener slots of `of`.
class InvertedPosition final : public sim::PositionFunction, private sim::EdgeListener {
  public:
    explicit InvertedPosition(sim::PositionFunction& of) : of_(of) {}

    std::int64_t count(Instant t) const override { return -of_.count(t); }
    double rate(Instant t) const override { return -of_.rate(t); }
    void watch(int slot, std::int64_t below, std::int64_t above) override;
    int add_listener(sim::PositionListener& listener) override;
    void set_edge_listener(sim::EdgeListener* listener) override;
    void deliver_edges() override { of_.deliver_edges(); }

  private:
    class Observer final : public sim::PositionListener {
      public:
        explicit Observer(sim::PositionListener& to) : to_(to) {}
        void crossed(Instant now) override { to_.crossed(now); }
        void rate_changed(double before, double rate, Instant now) override { to_.rate_changed(-before, -rate, now); }

      private:
        sim::PositionListener& to_;
    };
    void edges(const sim::EdgeBatch& batch) override;

    sim::PositionFunction& of_;
    std::vector<std::unique_ptr<Observer>> listeners_;
    sim::EdgeListener* edge_listener_ = nullptr;
    sim::EdgeBatch mirrored_{};
};

}  // namespace motionrack::rack
