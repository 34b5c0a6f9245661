// A conveyor as a position function in virtual time: its travel in counts, with the instants at which a range is left.
//
//   Conveyor (travel as a function of time) ──► floor(travel * counts per unit) ──► encoder, part sensor
//
// The count is a closed form of time; an unwatched count costs no time.
#pragma once

#include <cstdint>
#include <motionrack/sim/edge_batcher.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/listeners.hpp>
#include <motionrack/sim/parts/conveyor.hpp>
#include <motionrack/sim/parts/range.hpp>
#include <motionrack/sim/position_function.hpp>
#include <string>

namespace motionrack::parts {

class ConveyorPosition final : public sim::DeferringDevice, public sim::PositionFunction {
  public:
    /// Adds the device `name` to the kernel before it starts. `track` must outlive the object; its counts per unit must
    /// not be 0.
    ConveyorPosition(sim::Kernel& kernel, const std::string& name, const Conveyor& track, double counts_per_unit);

    std::int64_t count(Instant t) const override;
    double rate(Instant t) const override;
    void watch(int slot, std::int64_t below, std::int64_t above) override;
    int add_listener(sim::PositionListener& listener) override;
    void set_edge_listener(sim::EdgeListener* listener) override;
    void deliver_edges() override { hand_over(kernel_.now()); }

    /// Records a change of the conveyor's motion; `velocity_before`: its velocity() until now. Edges up to now must
    /// have been delivered.
    void changed(double velocity_before);

    void on_scheduled(Instant now) override;
    void sync(Instant now) override { hand_over(now); }
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    struct State {
        sim::Listeners::Watches watches{};
        Instant handed{};
        std::int64_t handed_count = 0;  ///< after the last delivered edge
    };

    Instant leaves(const Range& range, Instant from) const;
    void schedule(Instant now);
    void hand_over(Instant now);

    sim::Kernel& kernel_;
    const Conveyor& track_;
    double per_unit_;
    sim::DeviceId id_{};
    State state_{};
    sim::Listeners listeners_;
    sim::EdgeListener* edges_ = nullptr;
    sim::EdgeBatcher row_;
};

}  // namespace motionrack::parts
