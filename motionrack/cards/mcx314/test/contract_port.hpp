// The seam of the contract tests: whoever links contract_test.cpp says what card it runs against.
#pragma once

#include <memory>
#include <motionrack/base/port.hpp>

namespace motionrack::mcx314 {

/// A card that nothing is wired to: switches, alarm and emergency stop at rest, nothing moved by others.
class ContractPort {
  public:
    virtual ~ContractPort() = default;
    virtual RegisterPort& registers() = 0;
    virtual Interrupt& interrupt() = 0;
    /// False if its interrupts do not reach this program: waits then only let time pass.
    virtual bool has_interrupt_line() const { return true; }
};

/// A card for one test; the test begins with a reset. nullptr: there is none, the tests are skipped.
std::unique_ptr<ContractPort> make_contract_port();

}  // namespace motionrack::mcx314
