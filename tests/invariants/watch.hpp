// Invariant checks on a real machine or rack, enabled in every test that creates one.
#pragma once

#include <motionrack/operate/machine.hpp>
#include <motionrack/rack/rack.hpp>
#include <tests/invariants/invariants.hpp>
#include <utility>
#include <vector>

namespace motionrack::test {

/// Fails the current test with the rule and the instant.
void fail_test(const Finding& finding);

/// Checks a rack between two runs of its kernel.
class RackWatch {
  public:
    /// The rack must outlive it and be started before the first check.
    explicit RackWatch(rack::Rack& rack, Invariants::Report report = fail_test, const LimitFactors& known = {})
        : RackWatch(rack, milliseconds(50), std::move(report), known) {}
    /// Checks a rack driven by a program: motion is allowed at any time until a stop.
    void poll();
    Invariants& invariants() { return invariants_; }

  protected:
    /// `slice`: that of the driving program.
    RackWatch(rack::Rack& rack, Duration slice, Invariants::Report report, const LimitFactors& known = {});
    Sight sight();

    rack::Rack& rack_;
    Invariants invariants_;

  private:
    std::vector<sim::WireId> lasers_;
    std::int64_t sequence_ = 0;
};

/// Checks a machine in every slice. Create before Machine::run; must outlive it.
class MachineWatch : public RackWatch {
  public:
    explicit MachineWatch(operate::Machine& machine, Invariants::Report report = fail_test);

  private:
    void see(const operate::Status& status, bool by_writes);
};

}  // namespace motionrack::test
