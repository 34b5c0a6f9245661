// The invariants over a real machine or rack, on in every run of the tests that make one.
#pragma once

#include <motionrack/operate/machine.hpp>
#include <motionrack/rack/rack.hpp>
#include <tests/invariants/invariants.hpp>
#include <utility>
#include <vector>

namespace motionrack::test {

/// Fails the test that runs, with the rule and the instant.
void fail_test(const Finding& finding);

/// Looks at a rack between two runs of its kernel.
class RackWatch {
  public:
    /// The rack must outlive it, and be started when it is looked at first.
    explicit RackWatch(rack::Rack& rack, Invariants::Report report = fail_test)
        : RackWatch(rack, milliseconds(50), std::move(report)) {}
    /// A program drives it: it may move at any time, until it is stopped.
    void look();
    Invariants& invariants() { return invariants_; }

  protected:
    /// `slice`: of what drives it.
    RackWatch(rack::Rack& rack, Duration slice, Invariants::Report report);
    Sight sight();

    rack::Rack& rack_;
    Invariants invariants_;

  private:
    std::vector<sim::WireId> lasers_;
    std::int64_t sequence_ = 0;
};

/// Looks at a machine in every slice. To be made before Machine::run, and to outlive it.
class MachineWatch : public RackWatch {
  public:
    explicit MachineWatch(operate::Machine& machine, Invariants::Report report = fail_test);

  private:
    void see(const operate::Status& status);
};

}  // namespace motionrack::test
