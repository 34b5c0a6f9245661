// Catalogue of the types of card as the rack uses them: one line per type in catalogue.cpp.
#pragma once

#include <memory>
#include <motionrack/base/card_map.hpp>
#include <motionrack/base/function_library.hpp>
#include <motionrack/base/port.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/control/axis.hpp>
#include <motionrack/control/axis_group.hpp>
#include <motionrack/rack/card_types.hpp>
#include <motionrack/rack/config.hpp>
#include <motionrack/rack/register_view.hpp>
#include <motionrack/rack/stop_reactions.hpp>
#include <motionrack/sim/input_log.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/position_function.hpp>
#include <motionrack/sim/register_device.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

class MotionCard;

/// A position counter of a card, under its name in recordings.
struct CardCounter {
    std::string name;
    int channel = 0;
    bool encoder = false;  ///< true: MotionCard::encoder_counter; false: MotionCard::pulse_counter
};

/// A card in a running rack, with its bus.
class Card {
  public:
    virtual ~Card() = default;
    virtual const std::string& name() const = 0;
    virtual sim::DeviceId device() const = 0;
    virtual const CardMap& map() const = 0;
    /// Returns the card as one that moves axes; nullptr if it does not move axes.
    virtual MotionCard* motion() { return nullptr; }
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): motion() of a card that changes nothing
    const MotionCard* motion() const { return const_cast<Card*>(this)->motion(); }
    /// Registers as the host sees them; nullptr if the card has none.
    virtual sim::RegisterDevice* registers() { return nullptr; }
    /// Access widths of the card's bus in bits (8, 16, 32); empty: the card has no bus.
    virtual std::span<const int> bus_widths() const = 0;
    /// Host bus address of the map's offset 0.
    virtual std::uint32_t bus_base() const { return 0; }
    /// Returns true if the host can read this address although the map does not declare it. It belongs to a window of
    /// like values, of which the map declares the first.
    virtual bool in_window(std::uint32_t offset) const { return (void)offset, false; }
    /// Executes one host access of a width in bus_widths(), at bus_base() + an offset that the map declares. Takes the
    /// card's bus access time.
    virtual std::uint32_t bus_read(int bits, std::uint32_t address) = 0;
    virtual void bus_write(int bits, std::uint32_t address, std::uint32_t value) = 0;
    /// Reads a value by name, without side effects: a register or value of the card ("RR0"). A value of one channel has
    /// the channel's name and a dot in front ("x.RR1", "x.LP"). Counts are signed. Errors: invalid_input, listing the
    /// available names.
    virtual Result<std::int64_t> inspect(std::string_view name) const = 0;
    /// Names of the values that inspect() knows, without the registers of the map.
    virtual std::vector<std::string> value_names() const = 0;
    /// Returns the position counters that a recording shows; counter() reads one of them.
    virtual std::vector<CardCounter> counters() const = 0;
    virtual std::int64_t counter(const CardCounter& which) = 0;
    /// Returns a quantity of the card by name ("fout_hz"), or nothing if unknown.
    virtual std::optional<double> quantity(std::string_view) const { return std::nullopt; }
    virtual std::vector<std::string_view> quantity_names() const { return {}; }
    /// Description of a quantity.
    virtual std::string_view quantity_doc(std::string_view) const { return {}; }
    /// Faults that can be injected into the card itself. `fault` returns false if the fault or its value is unknown.
    virtual std::span<const std::string_view> fault_names() const { return {}; }
    virtual bool fault(std::string_view, double, Instant) { return false; }
    /// Full names of the wires shared with other cards ("bus.clk"). They can be driven from outside like the card's own
    /// wires.
    virtual std::span<const std::string> shared_wires() const { return {}; }
    /// Smallest distance between edges of its lines: a power of ten, at most 100 ns. A recording's time unit is not
    /// coarser.
    virtual Duration edge_unit() const { return nanoseconds(100); }
    /// Returns true if a recording's "scope.name" is a wire of this card, or a wire shared by it.
    bool shows(std::string_view scope, std::string_view wire) const;
    /// Copies the state outside the kernel's snapshot from `other`, a card of the same kind in another rack.
    virtual void copy_from(const Card& other) { (void)other; }
    /// Called once before the kernel starts, when all cards of the rack exist.
    virtual void complete() {}
    /// Host side: time and the interrupt line.
    virtual sim::VirtualHost& host() = 0;
    /// Bus of 16-bit registers; nullptr if the card has none.
    virtual sim::VirtualPort* port() { return nullptr; }
    /// Bus of 8-bit ports; nullptr if the card has none.
    virtual sim::VirtualBytePort* byte_port() { return nullptr; }
    /// Functions of the card's library; empty: the card has no library for manual calls.
    virtual std::span<const FunctionInfo> library_functions() const { return {}; }
    /// Function library on the card's bus for manual calls; nullptr if the card has none. Afterwards the previous
    /// driver must fetch the card again with path_axes() or axis(); no position of the card is valid then.
    virtual std::unique_ptr<FunctionLibrary> take_library() { return nullptr; }
    /// Returns true if describe() knows the conditions of this device: the card or its bus.
    virtual bool speaks_for(sim::DeviceId id) const { return id == device(); }
    virtual std::string describe(const sim::Condition& condition) const = 0;
    /// Condition code by which device() reports a restart by its watchdog, if it has a watchdog.
    virtual std::optional<std::uint16_t> watchdog_condition() const { return std::nullopt; }
};

/// A card that moves axes, with its driver.
class MotionCard : public Card {
  public:
    MotionCard* motion() final { return this; }
    std::int64_t counter(const CardCounter& which) final {
        return which.encoder ? encoder_counter(which.channel) : pulse_counter(which.channel);
    }
    /// Returns the number of a channel by its name in the rack file.
    virtual int channel_number(std::string_view channel) const = 0;
    /// Pulses of a channel as a function of time.
    virtual sim::PositionFunction& pulses(int channel) = 0;
    virtual void connect_encoder(int channel, sim::PositionFunction& counts) = 0;
    /// If `taken`, disconnects the channel's encoder and forces its inputs to their present levels; otherwise releases
    /// them and reconnects it. In between, edges of the forced inputs count.
    virtual void take_encoder(int channel, bool taken) = 0;
    /// Connects the card's built-in ideal machine, if it has one, because no axis of the rack file is on this card.
    /// Called once, before the kernel starts.
    virtual void connect_ideal_machine() {}
    /// The two encoder inputs of the ideal machine, which turns with `pulses(0)`; empty: the card has none.
    virtual std::span<const std::string_view> ideal_encoder() const { return {}; }
    /// Returns the card's axes as an axis group that follows paths; `channel[i]` moves axis i of the rack. The group
    /// starts at the valid position `position`. Without it, the axes continue from their counters.
    virtual Result<control::AxisGroup*> path_axes(const RackConfig& config,
                                                  const std::optional<control::Point>& position) = 0;
    /// Returns a single axis of the rack that this card moves. It continues from the group's position, or its position
    /// is invalid at first. Takes the card from path_axes(), and vice versa.
    virtual Result<control::Axis*> axis(const RackConfig& config, char letter) = 0;
    /// Acceleration reserve that the planner leaves for this card: fraction of each axis' limit, 0 .. 1.
    virtual double accel_reserve() const = 0;
    /// Rate changes above this limit (pulses/s) are steps, not ramps.
    virtual double jump_hz(const RackConfig& config) const = 0;
    /// Number of commands given to the card for paths, since path_axes().
    virtual std::int64_t segments() const = 0;
    /// Pulses of a channel in both directions since the start.
    virtual std::int64_t pulses_made(int channel) = 0;
    /// Hardware counters of a channel: pulses sent (LP of an MCX314), encoder counts (EP).
    virtual std::int64_t pulse_counter(int channel) = 0;
    virtual std::int64_t encoder_counter(int channel) = 0;
    /// Position of counter value 0, mm or degrees, for an axis that was homed or set and whose card keeps its counter.
    virtual double counter_origin() const { return 0; }
};

/// A card as its driver sees it: its registers or its byte ports, and the host's time.
struct CardBus {
    RegisterPort* registers = nullptr;  ///< nullptr: it has none
    BytePort* bytes = nullptr;          ///< nullptr: it has none
    Interrupt* host = nullptr;
    std::uint8_t select = 0;  ///< number that selects a card with byte ports
};
/// Number that selects a card of the rack file on its bus, as in CardBus; 0: none does.
std::uint8_t bus_select(const RackCard& card);
/// Bus of a virtual card.
CardBus bus_of(Card& card, const RackCard& config);

/// Values of a fault that cards of a type may have; Card::fault_names() says which a card has.
struct CardFault {
    std::string_view name;
    double min, max;
    std::string_view unit, doc;
    double (*max_of)(const RackCard& card) = nullptr;  ///< replaces max; may be nullptr
};

/// One type of card, complete. Each is one object, in the file of its card (NAME_plugin.cpp or NAME_card.cpp, declared
/// in NAME_card.hpp).
struct CardPlugin {
    CardType type;            ///< its description for the rack file reader
    const CardMap& (*map)();  ///< registers, commands, states and pins
    /// `before`: the existing cards of the rack; cards of some types share a bus.
    std::unique_ptr<Card> (*make)(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                  std::span<const std::unique_ptr<Card>> before);
    /// Reads the registers of a virtual or real card; nullptr if not supported. Errors: machine if no card answers.
    Result<RegisterView> (*view)(const CardBus& bus, bool clearing) = nullptr;
    /// Reads only the registers and values whose reading does not disturb a waiting function of `library`. nullptr:
    /// `view` disturbs none.
    RegisterView (*view_while_waiting)(const CardBus& bus) = nullptr;
    /// Function library of a virtual or real card; nullptr: no library for manual calls.
    std::unique_ptr<FunctionLibrary> (*library)(const CardBus& bus) = nullptr;
    /// Sentence on why real cards of the type cannot be accessed; empty: they can, with `view` and `library`. A map
    /// that does not come from the card's maker must not be used to write: it would set unknown registers.
    std::string_view no_live_port = {};
    std::span<const StopReaction> stop_reactions = {};
    std::span<const CardFault> faults = {};
};

/// All types of card, in the order of the reference page.
std::span<const CardPlugin* const> card_plugins();
/// Returns nullptr if the type is unknown.
const CardPlugin* find_card_plugin(std::string_view type);
/// Finds a type whose real cards have a live port. Errors: invalid_input, with the reason and the types that have one.
Result<const CardPlugin*> find_live_plugin(std::string_view type);

/// Builds the error that lists the readable registers of the card's map, and `more`.
tl::unexpected<Error> no_such_value(const Card& card, std::string_view name, std::span<const std::string_view> more);

}  // namespace motionrack::rack
