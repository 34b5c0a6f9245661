// Reports of the card's conditions to the kernel.
#pragma once

#include <motionrack/cards/databoard4002/model/conditions.hpp>
#include <motionrack/sim/kernel.hpp>

namespace motionrack::databoard4002 {

class ConditionReporter {
  public:
    ConditionReporter(sim::Kernel& kernel, sim::DeviceId card) : kernel_(kernel), card_(card) {}

    void report(CardCondition code, std::int64_t a = 0, std::int64_t b = 0) const {
        kernel_.report(card_, static_cast<std::uint16_t>(code), a, b);
    }

  private:
    sim::Kernel& kernel_;
    sim::DeviceId card_;
};

}  // namespace motionrack::databoard4002
