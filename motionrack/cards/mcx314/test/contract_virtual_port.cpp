// The contract tests' card here: a virtual chip of its own for each test.
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/test/contract_port.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/virtual_port.hpp>

namespace motionrack::mcx314 {

namespace {

class VirtualContractPort final : public ContractPort {
  public:
    VirtualContractPort()
        : chip_(kernel_, "c"), port_(kernel_, chip_, chip_.id(), chip_.interrupt_wire(), nanoseconds(500)) {
        kernel_.start();
    }
    RegisterPort& registers() override { return port_; }
    Interrupt& interrupt() override { return port_; }

  private:
    sim::Kernel kernel_;
    Chip chip_;
    sim::VirtualPort port_;
};

}  // namespace

std::unique_ptr<ContractPort> make_contract_port() {
    return std::make_unique<VirtualContractPort>();
}

}  // namespace motionrack::mcx314
