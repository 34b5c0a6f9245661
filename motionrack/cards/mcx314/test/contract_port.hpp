// Interface of the contract tests: a program that links contract_test.cpp provides the card through it.
#pragma once

#include <memory>
#include <motionrack/base/port.hpp>

namespace motionrack::mcx314 {

/// A card without connections: switches, alarm and emergency stop inactive. No other program moves it.
class ContractPort {
  public:
    virtual ~ContractPort() = default;
    virtual RegisterPort& registers() = 0;
    virtual Interrupt& interrupt() = 0;
    /// Returns false if this program does not receive the card's interrupts: waits then only let time pass.
    virtual bool has_interrupt_line() const { return true; }
};

/// Makes a card for one test, which begins with a reset. nullptr: no card is available, and the tests are skipped.
std::unique_ptr<ContractPort> make_contract_port();

}  // namespace motionrack::mcx314
