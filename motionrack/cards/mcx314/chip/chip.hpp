// The virtual MCX314: registers in front, four speed generators and an interpolator behind, exact to the tick
// (RULES.md).
//
//          WR0..WR7 ┌──────────┐ P, V, ..  ┌───────────┐ basic pulses ┌──────────────┐ pulses  xpp xpm
//   host ──────────►│ registers├──────────►│ generators├─────────────►│ lines, arcs  ├────────►  .. upp upm
//          RR0..RR7 └────▲─────┘           └─────▲─────┘              └──────────────┘
//                        └── EP ◄── encoders     └── limits, IN0..3, alarm, emergency ◄── wires
//
// Ticks are not simulated one by one. Between two events (a speed step, a special pulse, an input) the state is in
// closed form; the tick of an event is executed by the rules. Edges are generated only for listeners.
//
// Chip connects the owners of its state with the kernel and the bus:
//
//   CommandExecutor ─► Drives ◄─ ChipHomeSearch, ExternalDrives, SynchronousActions      what begins and stops drives
//   EventExecutor ─► Generators (by the rules), FastForward (closed form) ─► Comparators, PatternStack, EdgeStream
//   InputPins, InputFilters, EncoderInputs ─► state ─► Interrupts, OutputPins, PositionNotifier
//   MotionLaw, StatusRegisters, MachineStates, ChipValues                           read the state and change nothing
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/mcx314/chip/action_conditions.hpp>
#include <motionrack/cards/mcx314/chip/chip_conditions.hpp>
#include <motionrack/cards/mcx314/chip/chip_values.hpp>
#include <motionrack/cards/mcx314/chip/chip_wires.hpp>
#include <motionrack/cards/mcx314/chip/command_executor.hpp>
#include <motionrack/cards/mcx314/chip/comparators.hpp>
#include <motionrack/cards/mcx314/chip/drives.hpp>
#include <motionrack/cards/mcx314/chip/edge_stream.hpp>
#include <motionrack/cards/mcx314/chip/encoder_inputs.hpp>
#include <motionrack/cards/mcx314/chip/event_executor.hpp>
#include <motionrack/cards/mcx314/chip/event_requests.hpp>
#include <motionrack/cards/mcx314/chip/external_drives.hpp>
#include <motionrack/cards/mcx314/chip/fast_forward.hpp>
#include <motionrack/cards/mcx314/chip/generators.hpp>
#include <motionrack/cards/mcx314/chip/home_search.hpp>
#include <motionrack/cards/mcx314/chip/input_filters.hpp>
#include <motionrack/cards/mcx314/chip/input_pins.hpp>
#include <motionrack/cards/mcx314/chip/interrupts.hpp>
#include <motionrack/cards/mcx314/chip/machine_states.hpp>
#include <motionrack/cards/mcx314/chip/motion_law.hpp>
#include <motionrack/cards/mcx314/chip/options.hpp>
#include <motionrack/cards/mcx314/chip/output_pins.hpp>
#include <motionrack/cards/mcx314/chip/pattern_stack.hpp>
#include <motionrack/cards/mcx314/chip/position_notifier.hpp>
#include <motionrack/cards/mcx314/chip/pulse_listeners.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/cards/mcx314/chip/status_registers.hpp>
#include <motionrack/cards/mcx314/chip/synchronous_actions.hpp>
#include <motionrack/sim/held_outputs.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/position_function.hpp>
#include <motionrack/sim/register_device.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::mcx314 {

class Chip final : public sim::DeferringDevice, public sim::RegisterDevice {
  public:
    /// Adds the chip and its wires "<name>.<pin>" to the kernel. The clock input CLK is 16 MHz.
    Chip(sim::Kernel& kernel, const std::string& name, const ChipOptions& options = {});

    std::uint16_t read(std::uint32_t offset) override;
    void write(std::uint32_t offset, std::uint16_t value) override;
    std::uint16_t peek(std::uint32_t offset) const override { return status_.value(offset); }
    /// Access by the 8-bit bus (see ByteBus): port 2 n is the low byte of WRn and RRn, 2 n + 1 the high byte. Writing
    /// the low byte of WR0 executes its command.
    std::uint8_t read_byte(std::uint32_t port);
    void write_byte(std::uint32_t port, std::uint8_t value);

    /// Returns the output of an axis (0 X .. 3 U) as a position over time: + pulses minus - pulses since the start,
    /// independent of writes to LP.
    sim::PositionFunction& pulses(int axis) { return positions_[static_cast<std::size_t>(axis)]; }
    /// Connects the encoder at xeca/xecb; before the kernel starts.
    void connect_encoder(int axis, sim::PositionFunction& counts);
    /// Disconnects the encoder and forces xeca, xecb to its present levels (`taken`), or releases them and reconnects
    /// it. EP keeps its value; while disconnected it counts the forced levels. Between runs only.
    void take_encoder(int axis, bool taken);
    /// Returns the number of pulses since the start, those of both directions added.
    std::int64_t pulses_made(int axis);
    std::int32_t lp(int axis) const { return values_.lp(axis); }
    std::int32_t ep(int axis) const { return values_.ep(axis); }

    /// Returns a value by its name, without side effects: a register of the map, or the name of a data command ("P",
    /// "LP") or a read command ("CV"). Counts are signed. `axis` (0 .. 3) is used only for values that exist per axis.
    /// Empty if the name is unknown.
    std::optional<std::int64_t> inspect(std::string_view name, int axis) const { return values_.inspect(name, axis); }
    /// Returns the names that inspect() accepts: those of values per axis if `per_axis`, else those of the whole chip.
    static std::vector<std::string_view> inspected_names(bool per_axis) { return ChipValues::names(per_axis); }

    sim::DeviceId id() const { return id_; }
    sim::WireId interrupt_wire() const { return wires_.interrupt; }

    void on_scheduled(Instant now) override;
    void on_wire(int pin, int level, Instant now) override;
    int level_at(int pin, Instant now) const override;
    void wanted_changed(int pin, bool wanted, Instant now) override;
    void sync(Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }
    struct GeneralOutputs;  // general_outputs.hpp

  private:
    /// Position of one axis, counted in output pulses.
    class Output final : public sim::PositionFunction {
      public:
        std::int64_t count(Instant t) const override { return chip->law_.count_at(axis, t); }
        double rate(Instant t) const override { return chip->law_.rate_of(axis, t); }
        void watch(int slot, std::int64_t below, std::int64_t above) override { chip->watch(axis, slot, below, above); }
        int add_listener(sim::PositionListener& listener) override { return chip->listeners_.add(axis, listener); }
        void set_edge_listener(sim::EdgeListener* listener) override { chip->set_edge_listener(axis, listener); }
        void deliver_edges() override { chip->deliver_edges(axis); }

        Chip* chip = nullptr;
        int axis = 0;
    };
    /// Receives the notification that an encoder has passed a comparison value.
    class EncoderListener final : public sim::PositionListener {
      public:
        void crossed(Instant now) override { chip->encoder_crossed(axis, now); }
        void rate_changed(double, double, Instant) override {}
        Chip* chip = nullptr;
        int axis = 0;
    };

    // chip.cpp: time, wires, listeners
    void settle(Instant now);
    void begin();
    void catch_up(Instant now);
    void catch_up_before(Instant now);
    void watch(int axis, int slot, std::int64_t below, std::int64_t above);
    void set_edge_listener(int axis, sim::EdgeListener* listener);
    void deliver_edges(int axis);

    void encoder_crossed(int axis, Instant now);
    void encoder_lines(int axis, Instant now);

    // registers.cpp
    void reset();
    void write_bits(std::uint32_t offset, std::uint16_t value, std::uint16_t mask);
    void write_mode(std::uint32_t offset, int a, const sim::MaskedWrite& put);

    sim::Kernel& kernel_;
    sim::DeviceId id_;
    ChipOptions options_;
    bool extended_ = false;  // an MCX314As
    ChipWires wires_;
    State state_{};
    EventRequests requests_{state_};
    Interrupts interrupts_{state_, kernel_, wires_, requests_};
    EncoderInputs encoders_{state_, kernel_, wires_};
    ActionConditions conditions_{state_};
    Comparators comparators_{state_, encoders_, conditions_, options_};
    MotionLaw law_{state_};
    PulseListeners listeners_;
    EdgeStream edges_{state_, listeners_};
    FastForward forward_{state_, law_, listeners_, edges_, comparators_};
    PatternStack patterns_{state_.pattern, kernel_, id_};
    Generators generators_{
        state_, options_, {requests_, listeners_, law_, edges_, conditions_, comparators_, patterns_, forward_}};
    InputPins inputs_{state_, options_, kernel_, id_, wires_};
    InputFilters filters_{state_, kernel_, wires_, requests_, inputs_, conditions_, encoders_, comparators_, forward_};
    Drives drives_{state_, options_, kernel_, id_, requests_, conditions_, generators_};
    ExternalDrives external_{state_, inputs_, generators_, drives_};
    ChipHomeSearch homes_{state_,    kernel_,      id_,      requests_,   inputs_,
                          encoders_, comparators_, forward_, generators_, drives_};
    CommandExecutor commands_{
        state_,
        options_,
        kernel_,
        id_,
        {requests_, inputs_, filters_, conditions_, encoders_, comparators_, patterns_, generators_, drives_, homes_}};
    SynchronousActions actions_{state_, requests_, encoders_, forward_, generators_, drives_, homes_, commands_};
    PositionNotifier notifier_{state_, requests_, law_, listeners_, edges_};
    EventExecutor events_{state_, requests_, notifier_, forward_, generators_, filters_, external_, homes_, actions_};
    StatusRegisters status_{state_, inputs_, comparators_};
    OutputPins outputs_{state_, kernel_, wires_, requests_, law_, status_};
    MachineStates machines_{state_, kernel_};
    ChipValues values_{state_, kernel_, law_, encoders_, drives_, status_, machines_};
    std::array<Output, axes_of_chip> positions_;
    std::array<EncoderListener, axes_of_chip> encoder_listeners_;
};

}  // namespace motionrack::mcx314
