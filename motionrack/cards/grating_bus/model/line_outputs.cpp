// Sets the levels of the bus lines by state, and drives the lines.
#include <motionrack/cards/grating_bus/model/line_outputs.hpp>

namespace motionrack::grating_bus {

void LineOutputs::enter(State state) {
    switch (state) {
        case State::S0:
            state_.hold = 0;
            state_.addr = rest_of(Line::addr);
            break;
        case State::S1:
            state_.hold = 1;
            break;
        case State::S2:
        case State::S8:
            state_.read_n = 0;
            break;
        case State::S4:
        case State::S10:
            state_.read_n = 1;
            break;
        default:
            break;
    }
}

void LineOutputs::take(const Outputs& outputs) {
    state_.hold = outputs.hold, state_.read_n = outputs.read_n, state_.addr = outputs.addr;
}

void LineOutputs::drive(Lines& lines, int driver, bool off) const {
    const bool silent = off || quiet();
    const auto put = [&](Line line, bool out, std::uint32_t value) {
        if (out && !silent)
            lines.drive(line, driver, value);
        else
            lines.leave(line, driver);
    };
    const bool host = settings_.role == CardRole::host;  // a slave's logic does not drive these pins
    put(Line::clk, settings_.clock_out(), host ? state_.clk : 0);
    put(Line::hold, settings_.clock_out(), host ? state_.hold : 0);
    put(Line::read_n, settings_.clock_out(), host ? state_.read_n : 1);
    put(Line::addr, settings_.address_out(), host ? state_.addr : rest_of(Line::addr));
}

}  // namespace motionrack::grating_bus
