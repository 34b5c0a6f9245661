// A virtual IOFLEX02 on a bench: four motors, each with an encoder of 4000 counts and an index a turn, wired to the
// card.
//
//   Flex2Pos ──► VirtualPort ──► Bus ──► Card ◄── a b z ── LineEncoder ◄── DcMotor
#pragma once

#include <array>
#include <memory>
#include <motionrack/cards/ioflex02/driver/encoder_check.hpp>
#include <motionrack/cards/ioflex02/driver/flex2pos.hpp>
#include <motionrack/cards/ioflex02/driver/speed.hpp>
#include <motionrack/cards/ioflex02/driver/units.hpp>
#include <motionrack/cards/ioflex02/model/bus.hpp>
#include <motionrack/sim/parts/dc_motor.hpp>
#include <motionrack/sim/parts/line_encoder.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <motionrack/sim/wire_connections.hpp>
#include <string_view>

namespace howto {

using namespace motionrack;
using namespace motionrack::ioflex02;

class Bench {
  public:
    Bench();
    Flex2Pos& flex() { return flex_; }
    /// Sets the speed of the motor of that axis, counts/s, reached with its lag of 10 ms.
    void turn(int axis, double counts_s);
    /// The calibration input of an axis.
    void cal(int axis, bool level);
    /// One of LineEncoder's faults.
    void fault(int axis, std::string_view name, double value);
    void run(Duration time) { port_.pass(time); }

  private:
    sim::Kernel kernel_;
    Card card_{kernel_, "p1", {.preloaded = true}};
    ioflex02::Bus bus_{kernel_, "bus"};
    sim::WireConnections junctions_{kernel_};
    sim::VirtualPort port_;
    Flex2Pos flex_;
    std::array<std::unique_ptr<parts::DcMotor>, axis_count> motors_;
    std::array<std::unique_ptr<parts::LineEncoder>, axis_count> encoders_;
};

// The pages: each prints what its page shows.
motionrack::Result<void> calibrate();
motionrack::Result<void> speed();
motionrack::Result<void> broken_line();
motionrack::Result<void> lathe();

}  // namespace howto
