// The function library on a user-defined port, which prints the register accesses; built against the installed package.
#include <cstdio>
#include <motionrack/cards/mcx314/driver/driver.hpp>

using namespace motionrack;

class Printer final : public RegisterPort, public Interrupt {
  public:
    void write(std::uint32_t offset, std::uint16_t value) override { std::printf("write %02x %04x\n", offset, value); }
    std::uint16_t read(std::uint32_t) override { return 0; }
    bool wait(Duration timeout) override { return pass(timeout), false; }
    void pass(Duration duration) override { now_ += duration; }
    Instant now() const override { return now_; }

  private:
    Instant now_{};
};

int main() {
    Printer port;
    mcx314::Driver card(port, port);
    if (!card.LPS(mcx314::axis_x, 0x12345678)) return 1;
    return card.LPS(mcx314::axis_x, 1LL << 40) ? 1 : 0;
}
