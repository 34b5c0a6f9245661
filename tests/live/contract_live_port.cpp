// Card of the contract tests: the live port of MOTIONRACK_LIVE_PORT.
//
// Real card: MOTIONRACK_LIVE_PORT=uio:/dev/uio0 MOTIONRACK_LIVE_MOTORS=unplugged contract_live. All four axes send
// pulses. Served card: live_server memory contract_live.
#include <gtest/gtest.h>

#include <cstdlib>
#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/cards/mcx314/test/contract_port.hpp>
#include <motionrack/live/card_port.hpp>
#include <optional>
#include <tests/live/mapped_file.hpp>
#include <tests/live/served_clock.hpp>
#include <tests/live/trap.hpp>

namespace motionrack::mcx314 {

namespace {

using namespace live_test;

constexpr std::size_t page = 4096;

std::string variable(const char* name) {
    const char* const value = std::getenv(name);
    return value ? value : "";
}

/// Global for the trap's signal handler.
Doorbell* served_bell = nullptr;

void ask_before(const Touch& access) {
    if (!access.writes) ask(*served_bell, Question::read, 0, access.offset % 16);
}
void report_after(const Touch& access) {
    if (access.writes) ask(*served_bell, Question::write, 0, access.offset % 16);
}

class LiveContractPort final : public ContractPort {
  public:
    LiveContractPort(const live::PortSpec& spec, const std::string& bell) {
        if (!bell.empty()) bell_.emplace(bell, page, false);
        auto opened = live::CardPort::open(spec, card_map(),
                                           bell_ ? std::make_unique<ServedClock>(bell_->as<Doorbell>()) : nullptr);
        if (!opened) {
            ADD_FAILURE() << opened.error().message;
            return;
        }
        port_ = std::move(*opened);
        if (!bell_ || spec.reach != live::AddressSpace::memory) return;
        served_bell = &bell_->as<Doorbell>();
        trap_.emplace(Trap::mapping_of(spec.path), page, ask_before, report_after);
    }
    ~LiveContractPort() override {
        if (port_ && port_->trouble()) ADD_FAILURE() << port_->trouble()->message;
    }

    bool opened() const { return port_ != nullptr; }
    RegisterPort& registers() override { return *port_; }
    Interrupt& interrupt() override { return *port_; }
    bool has_interrupt_line() const override { return port_->has_interrupt(); }

  private:
    std::optional<MappedFile> bell_;
    std::unique_ptr<live::CardPort> port_;
    std::optional<Trap> trap_;  // destroyed before the mapping
};

}  // namespace

std::unique_ptr<ContractPort> make_contract_port() {
    const std::string text = variable("MOTIONRACK_LIVE_PORT"), bell = variable("MOTIONRACK_LIVE_DOORBELL");
    if (text.empty()) {
        std::puts("MOTIONRACK_LIVE_PORT is not the address of a card.");
        return nullptr;
    }
    const bool real = text.find("motionrack-live-") == std::string::npos;
    if (real && variable("MOTIONRACK_LIVE_MOTORS") != "unplugged") {
        std::puts(
            "These tests send pulses on all four axes. Unplug the motors and say so: "
            "MOTIONRACK_LIVE_MOTORS=unplugged.");
        return nullptr;
    }
    const auto spec = live::read_port_spec(text);
    if (!spec) {
        ADD_FAILURE() << spec.error().message;
        return nullptr;
    }
    if (spec->reach == live::AddressSpace::memory && !bell.empty() && !Trap::possible()) {
        std::puts("Accesses to memory are noticed one by one on x86-64 only.");
        return nullptr;
    }
    auto port = std::make_unique<LiveContractPort>(*spec, bell);
    if (!port->opened()) return nullptr;
    return port;
}

}  // namespace motionrack::mcx314
