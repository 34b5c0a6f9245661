// Hands the axes of an operated machine from one driver to another: program executor, single-axis motion, service.
//
//   executor with the axis group ◄──take_group── single axes: jogs, set positions; homing, service, ended writes
//              └──────────────take_axis, release──────►┘
//
// Setting up a card for another driver takes virtual time; the machine's slices continue meanwhile.
#pragma once

#include <functional>
#include <motionrack/base/result.hpp>
#include <motionrack/control/axis.hpp>
#include <motionrack/control/no_axes.hpp>
#include <motionrack/operate/program_run.hpp>
#include <motionrack/rack/rack.hpp>

namespace motionrack::operate {

/// Returns the rack's time and interrupt line for waits.
inline Interrupt& host_of(rack::Rack& rack) {
    return rack.cards().front()->host();
}

/// Used only by the motion thread.
class AxisHandover {
  public:
    /// Both must outlive this.
    AxisHandover(rack::Rack& rack, ProgramRun& programs) : rack_(rack), programs_(programs) {}

    /// Creates the executor of `programs` and gives it the axes. Errors: as Rack::path_axes.
    Result<void> start(const rack::RackConfig& config);
    /// Gives the axes to the executor, unless it has them. Errors: as Rack::path_axes.
    Result<void> take_group();
    /// Takes an axis from the executor and returns it for single-axis motion. Errors: as Card::axis.
    Result<control::Axis*> take_axis(char letter);
    /// Records that another driver takes axes from the executor.
    void release() { group_holds_ = false; }
    /// Runs `set_up`, which sets up a card for another driver, and returns its result.
    Result<void> hand_over(const std::function<Result<void>()>& set_up);
    /// Gives the axes and the rack's stop flag back to the executor. Errors: as Rack::path_axes.
    Result<void> take_back();
    /// Returns true while a card is being set up for another driver; the card's counters are meaningless then.
    bool in_progress() const { return in_progress_; }

  private:
    Result<control::AxisGroup*> group();

    rack::Rack& rack_;
    ProgramRun& programs_;
    control::NoAxes no_axes_;
    bool group_holds_ = false;  ///< true: the axis group drives; false: single axes
    bool in_progress_ = false;
};

}  // namespace motionrack::operate
