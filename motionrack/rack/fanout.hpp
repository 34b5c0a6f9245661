// Fans one listener slot for edges or wires out to several listeners.
//
//   part ──edges──► EdgeFanout ──┬──► waves (VCD)          kernel ──wires──► WireFanout ──┬──► waves
//                                └──► recording                                           └──► recording
#pragma once

#include <algorithm>
#include <functional>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/position_function.hpp>
#include <utility>
#include <vector>

namespace motionrack::rack {

class EdgeFanout final : public sim::EdgeListener {
  public:
    /// `attach`: sets the single listener, or removes it (nullptr).
    explicit EdgeFanout(std::function<void(sim::EdgeListener*)> attach) : attach_(std::move(attach)) {}

    /// Call between runs. Removing a listener that was not added has no effect.
    void add(sim::EdgeListener& listener) {
        listeners_.push_back(&listener);
        if (listeners_.size() == 1) attach_(this);
    }
    void remove(sim::EdgeListener& listener) {
        if (std::erase(listeners_, &listener) > 0 && listeners_.empty()) attach_(nullptr);
    }
    void edges(const sim::EdgeBatch& batch) override {
        for (sim::EdgeListener* listener : listeners_) listener->edges(batch);
    }

  private:
    std::function<void(sim::EdgeListener*)> attach_;
    std::vector<sim::EdgeListener*> listeners_;
};

class WireFanout final : public sim::Kernel::WireObserver {
  public:
    explicit WireFanout(sim::Kernel& kernel) : kernel_(kernel) {}

    /// Call between runs.
    void add(sim::Kernel::WireObserver& observer) {
        observers_.push_back(&observer);
        kernel_.observe_wires(this);
    }
    void remove(sim::Kernel::WireObserver& observer) {
        observers_.erase(std::remove(observers_.begin(), observers_.end(), &observer), observers_.end());
        if (observers_.empty()) kernel_.observe_wires(nullptr);
    }
    void wire_changed(sim::WireId wire, int level, Instant now) override {
        for (sim::Kernel::WireObserver* observer : observers_) observer->wire_changed(wire, level, now);
    }

  private:
    sim::Kernel& kernel_;
    std::vector<sim::Kernel::WireObserver*> observers_;
};

}  // namespace motionrack::rack
