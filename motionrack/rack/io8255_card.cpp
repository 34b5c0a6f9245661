// The IO8255 in a rack. Each card has a bus of its own with four ports; its lines are wires.
#include <array>
#include <motionrack/cards/io8255/map.hpp>
#include <motionrack/cards/io8255/model/card.hpp>
#include <motionrack/rack/byte_bus.hpp>
#include <motionrack/rack/io8255_card.hpp>
#include <motionrack/rack/own_pins.hpp>
#include <motionrack/rack/rack.hpp>

namespace motionrack::rack {

namespace {

/// Keys of a rack file.
struct Io8255Settings {
    std::int64_t bus_access_ns = 1'000;  ///< 0 .. 100,000 ns
};

constexpr auto io8255_pins = own_pins<std::size(io8255::map::pins)>(io8255::map::pins);

constexpr std::array<Field, 1> io8255_settings = {
    field<&Io8255Settings::bus_access_ns>("bus_access_ns", 0, 100'000, "ns", "time that one access of the host takes")};

const Io8255Settings& io8255_in(const RackCard& card) {
    return card.settings.get<Io8255Settings>();
}
void* io8255_of(RackCard& card) {
    return &card.settings.edit<Io8255Settings>();
}

/// Value beside the registers: the control word, which the host cannot read.
constexpr std::string_view control_word = "CONTROL_WORD";

class Io8255Card final : public ByteBusCard<Card> {
  public:
    Io8255Card(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log)
        : name_(config.name),
          card_(kernel, config.name),
          port_(kernel, card_, card_.id(), card_.interrupt_wire(), nanoseconds(io8255_in(config).bus_access_ns), &log) {
    }

    io8255::Card& card() { return card_; }

    const std::string& name() const override { return name_; }
    sim::DeviceId device() const override { return card_.id(); }
    const CardMap& map() const override { return io8255::card_map(); }

    Result<std::int64_t> inspect(std::string_view name) const override {
        if (name == control_word) return card_.control_word();
        for (const RegisterInfo& reg : map().registers)
            if (reg.name == name && reg.access != Access::write)
                return card_.peek(static_cast<std::uint8_t>(reg.offset));
        static constexpr std::string_view more[] = {control_word};
        return no_such_value(*this, name, more);
    }
    std::vector<std::string> value_names() const override { return {std::string(control_word)}; }
    std::vector<CardCounter> counters() const override { return {}; }
    std::int64_t counter(const CardCounter&) override { return 0; }

    sim::VirtualBytePort* byte_port() override { return &port_; }
    std::string describe(const sim::Condition& condition) const override { return io8255::describe(condition, name_); }

  private:
    std::string name_;
    io8255::Card card_;
    sim::VirtualBytePort port_;
};

std::unique_ptr<Card> make_io8255(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                  std::span<const std::unique_ptr<Card>>) {
    return std::make_unique<Io8255Card>(kernel, config, log);
}

void clear_io8255_outputs(Rack& rack, const StopReaction&) {
    for (const auto& card : rack.cards())
        if (auto* board = dynamic_cast<Io8255Card*>(card.get()); board != nullptr) board->card().clear_outputs();
}

constexpr std::array<StopReaction, 1> io8255_stops = {
    {{"io8255", every_stop, StopCategory::category_0, StopBy::latch,
      "its outputs go to 0, bytes that no peripheral has taken are discarded; handshakes continue", milliseconds(2),
      false, clear_io8255_outputs, StopOrder::digital_outputs}}};

}  // namespace

constinit const CardPlugin io8255_plugin = {
    .type = {.name = "io8255",
             .doc = "parallel inputs and outputs: three ports of 8 lines, of which two can be strobed; it moves no "
                    "axis, and its lines are wires",
             .chip_pins = io8255_pins,
             .settings = io8255_settings,
             .settings_of = io8255_of,
             .measures_only = true},
    .map = io8255::card_map,
    .make = make_io8255,
    .no_live_port =
        "An IO8255 has no live port: the virtual one is the chip with drivers and receivers of this project's own, and "
        "the lines and addresses of a real board are its maker's.",
    .stop_reactions = io8255_stops};

}  // namespace motionrack::rack
