// Provides a new virtual chip for each contract test. MOTIONRACK_VARIANT=mcx314as in the environment selects that
// variant, which must do everything that the original does.
#include <cstdlib>
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/test/contract_port.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <string_view>

namespace motionrack::mcx314 {

namespace {

class VirtualContractPort final : public ContractPort {
  public:
    VirtualContractPort()
        : chip_(kernel_, "c", {variant()}),
          port_(kernel_, chip_, chip_.id(), chip_.interrupt_wire(), nanoseconds(500)) {
        kernel_.start();
    }
    RegisterPort& registers() override { return port_; }
    Interrupt& interrupt() override { return port_; }

  private:
    static Variant variant() {
        const char* name = std::getenv("MOTIONRACK_VARIANT");
        return name && std::string_view(name) == "mcx314as" ? Variant::mcx314as : Variant::mcx314;
    }
    sim::Kernel kernel_;
    Chip chip_;
    sim::VirtualPort port_;
};

}  // namespace

std::unique_ptr<ContractPort> make_contract_port() {
    return std::make_unique<VirtualContractPort>();
}

}  // namespace motionrack::mcx314
