// A virtual DataBoard 4002 on a bench with a servo motor behind it, and a pen that writes down where the motor is. A
// count is 0.01 mm; a volt is 10,000 counts a second, 100 mm/s.
//
//   Driver ──► VirtualBytePort ──► Bus ──► Card ──vout──► DcMotor ──counts──► Card
//                                                            └──► pen ──► SVG
#pragma once

#include <motionrack/cards/databoard4002/driver/driver.hpp>
#include <motionrack/cards/databoard4002/driver/slope.hpp>
#include <motionrack/cards/databoard4002/model/bus.hpp>
#include <motionrack/sim/parts/dc_motor.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <motionrack/sim/wire_connections.hpp>
#include <motionrack/trace/svg.hpp>
#include <string>
#include <vector>

namespace howto {

using namespace motionrack;
using databoard4002::design_slope, databoard4002::motion_of, databoard4002::max_rate;
using databoard4002::SlopeDemand, databoard4002::SlopeMotion, databoard4002::SlopeTable, databoard4002::SpeedScale;

inline constexpr double counts_per_mm = 100;

/// What the pen has written, a line every millisecond.
struct Record {
    std::vector<double> seconds;
    std::vector<float> mm;
    std::vector<float> mm_s;
};

class Bench {
  public:
    /// `load`: the load's inertia in units of the motor's own. `pass`: how often the card's firmware looks.
    explicit Bench(double load = 0, Duration pass = milliseconds(1));
    databoard4002::Driver& card() { return driver_; }
    /// Time passes.
    void run(Duration time) { port_.pass(time); }
    /// Turns the motor by hand.
    void push(double counts) { motor_.fault("motor.push", counts, kernel_.now()); }
    /// Puts the pen down: what it has written begins here, with 0 s.
    void record();
    const Record& recorded() const { return record_; }

  private:
    void write_down();

    sim::Kernel kernel_;
    parts::DcMotor motor_;
    databoard4002::Card card_;
    databoard4002::Bus bus_{kernel_, "bus"};
    sim::WireConnections junctions_{kernel_};
    sim::VirtualBytePort port_;
    databoard4002::Driver driver_;
    Record record_;
    Instant from_{};
};

// The pages: each prints what its page shows and returns its picture.
Result<std::string> slope();
Result<std::string> lock();
/// Of what examples/10_databoard_c has written.
Result<std::string> old_host(const std::string& csv);
/// Of what examples/servo_rig has written.
Result<std::string> closed_loop(const std::string& csv);

}  // namespace howto
