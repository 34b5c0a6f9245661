// Interface of the contract tests: the program that links contract_test.cpp provides the card.
#pragma once

#include <memory>
#include <motionrack/base/port.hpp>

namespace motionrack::mcx314 {

/// A card without connections: switches, alarm and emergency stop inactive, no motion by other programs.
class ContractPort {
  public:
    virtual ~ContractPort() = default;
    virtual RegisterPort& registers() = 0;
    virtual Interrupt& interrupt() = 0;
    /// False if this program does not receive its interrupts: waits then only let time pass.
    virtual bool has_interrupt_line() const { return true; }
};

/// A card for one test; the test begins with a reset. nullptr: not available, the tests are skipped.
std::unique_ptr<ContractPort> make_contract_port();

}  // namespace motionrack::mcx314
