// The drives of the axes and of the interpolator: their commands, their start and their stop.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/chip/action_conditions.hpp>
#include <motionrack/cards/mcx314/chip/event_requests.hpp>
#include <motionrack/cards/mcx314/chip/generators.hpp>
#include <motionrack/cards/mcx314/chip/options.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/sim/kernel.hpp>

namespace motionrack::mcx314 {

class Drives {
  public:
    Drives(State& state, const ChipOptions& options, sim::Kernel& kernel, sim::DeviceId id, EventRequests& requests,
           ActionConditions& conditions, Generators& generators)
        : state_(state),
          extended_(options.extended()),
          kernel_(kernel),
          id_(id),
          requests_(requests),
          conditions_(conditions),
          generators_(generators) {}

    /// Executes a drive command, 20h .. 23h: every named axis that is not driving starts, or holds the command until
    /// 25h.
    void command(int code, unsigned axes);
    /// Starts the drive of axis `a`; `code`: drive command, 20h .. 23h.
    void start(int a, int code);
    /// Executes an interpolation command, 30h .. 35h: starts an interpolation, or queues the next segment.
    void path_command(int code);
    /// Executes command 25h: starts the drives that the named axes hold.
    void free_held(unsigned axes);
    /// Requests a stop of the named axes: decelerating (command 26h) or immediate (27h).
    void ask_stop(unsigned axes, bool immediate);
    /// Returns the value that the chip uses for the register `v` of a finish point or centre: 24 bits, or 32 on the
    /// MCX314As.
    std::int64_t coordinate(std::uint32_t v) const { return extended_ ? rules::limited32(v) : rules::signed24(v); }

  private:
    void begin_generator(int a, Drive drive);
    void prepare_drive(int a);
    void choose_deceleration(int a);
    PathCommand captured(int code) const;
    bool any_busy(const PathCommand& command) const;
    void start_path(const PathCommand& command);

    State& state_;
    const bool extended_;
    sim::Kernel& kernel_;
    const sim::DeviceId id_;
    EventRequests& requests_;
    ActionConditions& conditions_;
    Generators& generators_;
};

}  // namespace motionrack::mcx314
