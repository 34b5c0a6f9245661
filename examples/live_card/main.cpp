// The function library on a real card: where its axes stand; and, if asked, a slow move of X.
#include <fmt/format.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <motionrack/cards/mcx314/driver/driver.hpp>
#include <motionrack/live/card_port.hpp>

using namespace motionrack;

namespace {

std::atomic<bool> stop{false};

int tell(const Error& error) {
    fmt::print(stderr, "{}\n", error.message);
    return 1;
}

/// 500 pulses a second, with a ramp; Ctrl-C decelerates.
Result<void> move_x(mcx314::Driver& card, long pulses) {
    card.initialise();
    MOTIONRACK_CHECK(card.SetMultiple(mcx314::axis_x, 1));
    MOTIONRACK_CHECK(card.TCurve_F(mcx314::axis_x, 50, 500, 20, pulses));
    const Result<void> done = card.wait_until_done(mcx314::axis_x, whole_seconds(60));
    if (!done) card.stop_all(mcx314::StopKind::slow);
    return done;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "example_live_card CARD [PULSES]\nCARD is {}\n", live::port_spec_form());
        return 1;
    }
    const auto spec = live::read_port_spec(argv[1]);
    if (!spec) return tell(spec.error());
    const auto port = live::CardPort::open(*spec, mcx314::card_map());
    if (!port) return tell(port.error());
    mcx314::Driver card(**port, **port);

    (*port)->set_stop_flag(&stop);
    std::signal(SIGINT, [](int) { stop = true; });
    const Result<void> moved = argc > 2 ? move_x(card, std::atol(argv[2])) : Result<void>{};
    for (int axis = 0; axis < 4; ++axis) fmt::print("{}\n", card.report(axis).text());
    if ((*port)->trouble()) return tell(*(*port)->trouble());
    return moved ? 0 : tell(moved.error());
}
