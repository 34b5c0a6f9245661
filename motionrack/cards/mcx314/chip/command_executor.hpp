// Executes the commands of WR0, and accesses the registers that the bus reaches only through data commands.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/chip/action_conditions.hpp>
#include <motionrack/cards/mcx314/chip/comparators.hpp>
#include <motionrack/cards/mcx314/chip/drives.hpp>
#include <motionrack/cards/mcx314/chip/encoder_inputs.hpp>
#include <motionrack/cards/mcx314/chip/event_requests.hpp>
#include <motionrack/cards/mcx314/chip/generators.hpp>
#include <motionrack/cards/mcx314/chip/home_search.hpp>
#include <motionrack/cards/mcx314/chip/input_filters.hpp>
#include <motionrack/cards/mcx314/chip/input_pins.hpp>
#include <motionrack/cards/mcx314/chip/options.hpp>
#include <motionrack/cards/mcx314/chip/pattern_stack.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/sim/kernel.hpp>

namespace motionrack::mcx314 {

class CommandExecutor {
  public:
    /// Components of the chip on which commands act.
    struct CommandedParts {
        EventRequests& requests;
        InputPins& inputs;
        InputFilters& filters;
        ActionConditions& conditions;
        EncoderInputs& encoders;
        Comparators& comparators;
        PatternStack& patterns;
        Generators& generators;
        Drives& drives;
        ChipHomeSearch& homes;
    };
    CommandExecutor(State& state, const ChipOptions& options, sim::Kernel& kernel, sim::DeviceId id,
                    const CommandedParts& parts)
        : state_(state),
          extended_(options.extended()),
          kernel_(kernel),
          id_(id),
          requests_(parts.requests),
          inputs_(parts.inputs),
          filters_(parts.filters),
          conditions_(parts.conditions),
          encoders_(parts.encoders),
          comparators_(parts.comparators),
          patterns_(parts.patterns),
          generators_(parts.generators),
          drives_(parts.drives),
          homes_(parts.homes) {}

    /// Executes a word written to WR0 whose RESET bit is 0.
    void execute(std::uint16_t value);
    /// Writes WR6 (low word) and WR7 (high word) to the register that the data command `code` selects on axis `a`.
    void data_write(int code, int a);

  private:
    void data_read(int code, int a);
    // command_executor_extended.cpp
    static bool has_extended(int code);
    bool execute_extended(int code, unsigned axes);
    void write_extended(int code, int a);
    void set_extension(int a);
    void set_ring_end(int a, std::int32_t value);

    State& state_;
    const bool extended_;
    sim::Kernel& kernel_;
    const sim::DeviceId id_;
    EventRequests& requests_;
    InputPins& inputs_;
    InputFilters& filters_;
    ActionConditions& conditions_;
    EncoderInputs& encoders_;
    Comparators& comparators_;
    PatternStack& patterns_;
    Generators& generators_;
    Drives& drives_;
    ChipHomeSearch& homes_;
};

}  // namespace motionrack::mcx314
