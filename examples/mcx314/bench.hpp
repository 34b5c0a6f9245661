// A virtual MCX314 on a bench, alone: its function library, and a pen on every axis. A pulse is 0.01 mm.
//
//   Driver ──► VirtualPort ──► Chip ──pulses──► pens ──► SVG
#pragma once

#include <array>
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/driver/driver.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <string>
#include <vector>

namespace howto {

using namespace motionrack;
using mcx314::axis_x, mcx314::axis_y, mcx314::axis_z;

inline constexpr double mm_per_pulse = 0.01;

class Bench {
  public:
    Bench();
    mcx314::Driver& card() { return driver_; }

    /// Speed of the axes in the mask over time.
    std::string speeds(const std::string& title, unsigned axes);
    /// The path of X and Y.
    std::string path(const std::string& title);

  private:
    /// Writes down how fast an axis is, step by step, and each of its pulses.
    struct Pen final : sim::PositionListener, sim::EdgeListener {
        void crossed(Instant) override {}
        void rate_changed(double before, double rate, Instant now) override;
        void edges(const sim::EdgeBatch& batch) override;
        std::vector<double> seconds;
        std::vector<float> mm_s;
        std::vector<std::pair<Instant, std::int64_t>> pulses;  ///< when, and the count after it
    };

    sim::Kernel kernel_;
    mcx314::Chip chip_{kernel_, "c"};
    sim::VirtualPort port_;
    mcx314::Driver driver_;
    std::array<Pen, 4> pens_;
};

/// One page's program.
struct Page {
    const char* name;
    Result<void> (*run)(mcx314::Driver& card);
    std::string (*picture)(Bench& bench);
};

Result<void> trapezoid(mcx314::Driver& card);
Result<void> s_curve(mcx314::Driver& card);
Result<void> asymmetric(mcx314::Driver& card);
Result<void> line(mcx314::Driver& card);
Result<void> arc(mcx314::Driver& card);
Result<void> contour(mcx314::Driver& card);
Result<void> bit_pattern(mcx314::Driver& card);

}  // namespace howto
