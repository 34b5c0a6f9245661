// What kinds of card there are, as the rack needs them: one line a card in catalogue.cpp.
#pragma once

#include <memory>
#include <motionrack/base/card_map.hpp>
#include <motionrack/base/function_library.hpp>
#include <motionrack/control/axis.hpp>
#include <motionrack/control/axis_group.hpp>
#include <motionrack/rack/config.hpp>
#include <motionrack/rack/register_view.hpp>
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

/// A position counter of a card by the name that a recording gives it.
struct CardCounter {
    std::string name;
    int channel = 0;
    bool encoder = false;  ///< MotionCard::encoder_counter, else MotionCard::pulse_counter
};

/// A card in a running rack, with its bus.
class Card {
  public:
    virtual ~Card() = default;
    virtual const std::string& name() const = 0;
    virtual sim::DeviceId device() const = 0;
    virtual const CardMap& map() const = 0;
    /// The same card as one that moves axes; nullptr if it moves none.
    virtual MotionCard* motion() { return nullptr; }
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): motion() of a card that changes nothing
    const MotionCard* motion() const { return const_cast<Card*>(this)->motion(); }
    /// Registers as the host sees them; nullptr if the card has none.
    virtual sim::RegisterDevice* registers() { return nullptr; }
    /// Widths in bits (8, 16, 32) of the accesses that the card's bus makes; none: it has no bus.
    virtual std::span<const int> bus_widths() const = 0;
    /// Where the map's offset 0 is on the host's bus.
    virtual std::uint32_t bus_base() const { return 0; }
    /// Whether the host can read more there than the map declares: a window of numbers that are alike, of which it has
    /// the first.
    virtual bool in_window(std::uint32_t offset) const { return (void)offset, false; }
    /// One access of the host, of one of these widths and at bus_base() + an offset that the map declares; it takes the
    /// bus its time.
    virtual std::uint32_t bus_read(int bits, std::uint32_t address) = 0;
    virtual void bus_write(int bits, std::uint32_t address, std::uint32_t value) = 0;
    /// A value by its name, without effects: a register or value of the card ("RR0"), of one channel with the channel's
    /// name and a dot in front ("x.RR1", "x.LP"). Counts are signed. Errors: invalid_input with the names that there
    /// are.
    virtual Result<std::int64_t> inspect(std::string_view name) const = 0;
    /// The names of the values that inspect knows, registers left out where the map has them.
    virtual std::vector<std::string> value_names() const = 0;
    /// What a recording shows as numbers, and one of them.
    virtual std::vector<CardCounter> counters() const = 0;
    virtual std::int64_t counter(const CardCounter& which) = 0;
    /// A number of the card's own by its name ("fout_hz"), if it has one of that name.
    virtual std::optional<double> quantity(std::string_view) const { return std::nullopt; }
    virtual std::vector<std::string_view> quantity_names() const { return {}; }
    /// What one of these is, for people.
    virtual std::string_view quantity_doc(std::string_view) const { return {}; }
    /// What can be broken on the card itself. `fault`: false if it knows no such fault or value.
    virtual std::span<const std::string_view> fault_names() const { return {}; }
    virtual bool fault(std::string_view, double, Instant) { return false; }
    /// Wires by their full names that it shares with other cards ("bus.clk"); from outside they can be driven like its
    /// own.
    virtual std::span<const std::string> shared_wires() const { return {}; }
    /// How close edges of its lines may come: a power of ten, at most 100 ns. A recording's time has no coarser unit.
    virtual Duration edge_unit() const { return nanoseconds(100); }
    /// Whether a recording's "scope.name" is a wire of this card, or one that it shares.
    bool shows(std::string_view scope, std::string_view wire) const;
    /// What no snapshot of the kernel holds becomes that of `other`, a card of the same kind in another rack.
    virtual void copy_from(const Card& other) { (void)other; }
    /// All cards of the rack are there. Once, before the kernel starts.
    virtual void complete() {}
    /// The host's side: time and the interrupt line.
    virtual sim::VirtualHost& host() = 0;
    /// Its bus of 16-bit registers; nullptr if it has none.
    virtual sim::VirtualPort* port() { return nullptr; }
    /// Its bus of 8-bit ports; nullptr if it has none.
    virtual sim::VirtualBytePort* byte_port() { return nullptr; }
    /// The functions of the card's library; none: it has no library that could be called by hand.
    virtual std::span<const FunctionInfo> library_functions() const { return {}; }
    /// The library over the card's bus, for somebody who calls it by hand; nullptr as above. Whoever drove the card
    /// takes it anew afterwards, from path_axes() or axis(), and no position of it is trusted then.
    virtual std::unique_ptr<FunctionLibrary> take_library() { return nullptr; }
    /// Whether describe() knows the conditions of this device: the card, and its bus.
    virtual bool speaks_for(sim::DeviceId id) const { return id == device(); }
    virtual std::string describe(const sim::Condition& condition) const = 0;
    /// The code of the condition by which device() says that its watchdog has restarted it, if it has one.
    virtual std::optional<std::uint16_t> watchdog_condition() const { return std::nullopt; }
};

/// A card that moves axes, with its driver.
class MotionCard : public Card {
  public:
    MotionCard* motion() final { return this; }
    std::int64_t counter(const CardCounter& which) final {
        return which.encoder ? encoder_counter(which.channel) : pulse_counter(which.channel);
    }
    /// Number of a channel by its name in the rack file.
    virtual int channel_number(std::string_view channel) const = 0;
    /// Pulses of a channel, as a function of time.
    virtual sim::PositionFunction& pulses(int channel) = 0;
    virtual void connect_encoder(int channel, sim::PositionFunction& counts) = 0;
    /// Cuts the connected encoder of a channel off and forces its inputs to the levels that it has (`taken`), or
    /// releases them and puts it back. In between what the inputs are forced to counts.
    virtual void take_encoder(int channel, bool taken) = 0;
    /// No axis of the rack file is on this card: what follows its pulses then, if anything does. Once, before the
    /// kernel starts.
    virtual void connect_ideal_machine() {}
    /// The two inputs of the encoder of that machine, which turns with `pulses(0)`; empty: there is none.
    virtual std::span<const std::string_view> ideal_encoder() const { return {}; }
    /// The card's axes as a group that follows paths; `channel[i]` moves axis i of the rack. Set up at `position`,
    /// which is trusted then; without one they go on from where the counters say that they stand.
    virtual Result<control::AxisGroup*> path_axes(const RackConfig& config,
                                                  const std::optional<control::Point>& position) = 0;
    /// One axis of the rack that this card moves, by itself; it goes on from where the group stands, or its position is
    /// not trusted at first. Takes the card from path_axes(), and the other way round.
    virtual Result<control::Axis*> axis(const RackConfig& config, char letter) = 0;
    /// Part of each acceleration that the planner keeps back for this card.
    virtual double accel_reserve() const = 0;
    /// Rates that change by more than this at once (pulses a second) are jumps, not ramps.
    virtual double jump_hz(const RackConfig& config) const = 0;
    /// Commands given to the card for the present path.
    virtual std::int64_t segments() const = 0;
    /// Pulses of both directions that a channel has made since the start.
    virtual std::int64_t pulses_made(int channel) = 0;
    /// The card's own counters of a channel: LP, EP.
    virtual std::int64_t pulse_counter(int channel) = 0;
    virtual std::int64_t encoder_counter(int channel) = 0;
    /// The position where the counter is 0, mm or degrees: of an axis that was homed or declared and
    /// whose card keeps its counter.
    virtual double counter_origin() const { return 0; }
};

/// One kind of card.
struct CardKind {
    std::string_view type;    ///< as a rack file calls it
    const CardMap& (*map)();  ///< its registers, commands, states and pins
    /// `before`: the cards of the rack that there are already; cards of some kinds share a bus.
    std::unique_ptr<Card> (*make)(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                  std::span<const std::unique_ptr<Card>> before);
    /// Reads its registers through a port, of a virtual or a real card; nullptr if nobody has said how.
    RegisterView (*view)(RegisterPort& port, bool clearing) = nullptr;
    /// Its function library through a port, of a virtual or a real card; nullptr: it has none that is called by hand.
    std::unique_ptr<FunctionLibrary> (*library)(RegisterPort& port, Interrupt& interrupt) = nullptr;
};

/// The values that a card's map declares as registers that can be read, and `more`, as an error lists them.
tl::unexpected<Error> no_such_value(const Card& card, std::string_view name, std::span<const std::string_view> more);

std::unique_ptr<Card> make_ioflex02(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                    std::span<const std::unique_ptr<Card>> before);
std::unique_ptr<Card> make_grating_bus(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                       std::span<const std::unique_ptr<Card>> before);
std::unique_ptr<Card> make_grating_decoder(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                           std::span<const std::unique_ptr<Card>> before);
std::unique_ptr<Card> make_databoard4002(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                         std::span<const std::unique_ptr<Card>> before);

std::unique_ptr<Card> make_rtc5(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                std::span<const std::unique_ptr<Card>> before);

std::span<const CardKind> card_kinds();
/// nullptr if there is no such kind.
const CardKind* find_card_kind(std::string_view type);

}  // namespace motionrack::rack
