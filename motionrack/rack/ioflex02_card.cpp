// The IOFLEX02 in a rack. All boards of a rack share one bus, on which each answers at its base address. It moves
// nothing; its lines are wires.
#include <fmt/format.h>

#include <array>
#include <motionrack/cards/ioflex02/image.hpp>
#include <motionrack/cards/ioflex02/map.hpp>
#include <motionrack/cards/ioflex02/model/bus.hpp>
#include <motionrack/cards/ioflex02/model/card.hpp>
#include <motionrack/rack/ioflex02_card.hpp>
#include <motionrack/rack/own_pins.hpp>

namespace motionrack::rack {

namespace {

namespace io = ioflex02;

/// Keys of a rack file; settings_of() makes the model's settings of them.
struct Ioflex02Settings {
    std::int64_t base_address = 0x2300;  ///< 0 .. FF00h, a multiple of 100h: address on the common bus
    std::int64_t serial = 1;             ///< 0 .. 65,535
    double configuration_ms = 2'000;     ///< 0 .. 60,000 ms from the image's last byte to the running project
    bool preloaded = true;               ///< a project runs from power-up, without a download by the host
    std::string image;                   ///< compressed image in hexadecimal digits; empty: the built-in image
    std::int64_t bus_access_ns = 500;    ///< 0 .. 100,000 ns
};

constexpr auto ioflex02_pins = own_pins<std::size(io::map::pins)>(io::map::pins);

constexpr std::array<Field, 6> ioflex02_settings = {
    field<&Ioflex02Settings::base_address>("base_address", 0, 0xFF00, "",
                                           "address on the host's bus: a multiple of 256"),
    field<&Ioflex02Settings::serial>("serial", 0, 65'535, "", "its serial number"),
    field<&Ioflex02Settings::configuration_ms>(
        "configuration_ms", 0, 60'000, "ms", "time from the last byte of a configuration image to the running project"),
    formerly("loaded", field<&Ioflex02Settings::preloaded>(
                           "preloaded", 0, 0, "", "true: its project runs from the start; false: the host loads it")),
    absent_means(field<&Ioflex02Settings::image>(
                     "image", 0, 2 * io::max_image_file, "",
                     "its configuration image in hexadecimal digits, as `motionrack image show --hex` prints it: it "
                     "runs from the start, and Init of the function libraries loads it"),
                 "the built-in one"),
    field<&Ioflex02Settings::bus_access_ns>("bus_access_ns", 0, 100'000, "ns",
                                            "time that one access of the host takes"),
};

const Ioflex02Settings& ioflex02_in(const RackCard& card) {
    return card.settings.get<Ioflex02Settings>();
}
void* ioflex02_of(RackCard& card) {
    return &card.settings.edit<Ioflex02Settings>();
}

/// Returns the header data of its image, if valid.
Result<io::ImageInfo> ioflex02_image(const Ioflex02Settings& settings) {
    MOTIONRACK_TRY(const auto file, io::bytes_of_hex(settings.image));
    MOTIONRACK_TRY(const auto raw, io::unpacked(file));
    return io::inspect(raw);
}

std::optional<CardFlaw> ioflex02_flaw(const RackCard& card, std::span<const RackCard> before) {
    const Ioflex02Settings& own = ioflex02_in(card);
    for (const RackCard& other : before)
        if (other.type == card.type && ioflex02_in(other).serial == own.serial)
            return CardFlaw{"serial", fmt::format("Cards {} and {} have the same serial number {}; it must be unique.",
                                                  other.name, card.name, own.serial)};
    if (!own.image.empty())
        if (const auto raw = ioflex02_image(own); !raw) return CardFlaw{"image", raw.error().message};
    if (own.base_address % 256 == 0) return std::nullopt;
    return CardFlaw{"base_address",
                    fmt::format("base_address of card {} is {}; it must be a multiple of 256, such as {}.", card.name,
                                own.base_address, own.base_address / 256 * 256)};
}

io::Settings settings_of(const Ioflex02Settings& s) {
    io::Settings out;
    out.base_address = static_cast<std::uint32_t>(s.base_address);
    out.serial = static_cast<std::uint16_t>(s.serial);
    out.configuration_time = from_seconds(s.configuration_ms * 1e-3);
    out.preloaded = s.preloaded;
    if (!s.image.empty()) out.image = *io::unpacked(*io::bytes_of_hex(s.image));
    return out;
}

/// Values beside the registers: the time, in ticks of 1.2 us, and a value per axis.
constexpr std::string_view card_time = "TIME";
struct AxisValue {
    std::string_view name;
    std::int64_t (*get)(const io::Card& card, int axis);
};
constexpr AxisValue pins_of_axes[] = {
    {"POSITION", [](const io::Card& card, int axis) { return std::int64_t{card.position(axis)}; }},
    {"RAW", [](const io::Card& card, int axis) { return card.raw_count(axis); }},
    {"CALIBRATED", [](const io::Card& card, int axis) { return std::int64_t{card.status(axis) == io::sCal}; }},
    {"ILLEGAL_TRANSITIONS", [](const io::Card& card, int axis) { return std::int64_t{card.illegal(axis)}; }},
};

class Ioflex02Card final : public Card {
  public:
    Ioflex02Card(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log, std::shared_ptr<io::Bus> bus)
        : name_(config.name),
          card_(kernel, config.name, settings_of(ioflex02_in(config))),
          bus_(bus ? std::move(bus) : std::make_shared<io::Bus>(kernel, "ioflex")),
          port_(kernel, *bus_, bus_->id(), bus_->interrupt_wire(), nanoseconds(ioflex02_in(config).bus_access_ns),
                &log) {
        bus_->plug(card_);
    }

    const std::shared_ptr<io::Bus>& bus() const { return bus_; }
    io::Card& card() { return card_; }

    const std::string& name() const override { return name_; }
    sim::DeviceId device() const override { return card_.id(); }
    const CardMap& map() const override { return io::card_map(); }
    std::span<const int> bus_widths() const override {
        static constexpr int words[] = {16};
        return words;
    }
    std::uint32_t bus_base() const override { return card_.settings().base_address; }
    std::uint32_t bus_read(int, std::uint32_t address) override { return port_.read(address); }
    void bus_write(int, std::uint32_t address, std::uint32_t value) override {
        port_.write(address, static_cast<std::uint16_t>(value));
    }

    Result<std::int64_t> inspect(std::string_view name) const override {
        static constexpr std::string_view more[] = {"0.POSITION .. 3.POSITION", "0.RAW ..", "0.CALIBRATED ..",
                                                    "0.ILLEGAL_TRANSITIONS ..", card_time};
        if (name.size() > 2 && name[1] == '.' && name[0] >= '0' && name[0] <= '3')
            for (const AxisValue& value : pins_of_axes)
                if (value.name == name.substr(2)) return value.get(card_, name[0] - '0');
        if (name == card_time) return card_.time();
        for (const RegisterInfo& reg : map().registers)
            if (reg.name == name && reg.access != Access::write) return card_.peek(reg.offset);
        return no_such_value(*this, name, more);
    }
    std::vector<std::string> value_names() const override {
        std::vector<std::string> out = {std::string(card_time)};
        for (const char axis : std::string_view("0123"))
            for (const AxisValue& value : pins_of_axes)
                out.push_back(std::string(1, axis) + "." + std::string(value.name));
        return out;
    }
    std::vector<CardCounter> counters() const override {
        return {{"position0", 0, true}, {"position1", 1, true}, {"position2", 2, true}, {"position3", 3, true}};
    }
    std::int64_t counter(const CardCounter& which) override { return card_.position(which.channel); }

    sim::VirtualHost& host() override { return port_; }
    sim::VirtualPort* port() override { return &port_; }
    bool speaks_for(sim::DeviceId id) const override { return id == card_.id() || id == bus_->id(); }
    std::string describe(const sim::Condition& condition) const override { return io::describe(condition, name_); }

  private:
    std::string name_;
    io::Card card_;
    std::shared_ptr<io::Bus> bus_;
    sim::VirtualPort port_;
};

std::unique_ptr<Card> make_ioflex02(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                    std::span<const std::unique_ptr<Card>> before) {
    std::shared_ptr<io::Bus> bus;
    for (const auto& other : before)
        if (const auto* same = dynamic_cast<const Ioflex02Card*>(other.get())) bus = same->bus();
    return std::make_unique<Ioflex02Card>(kernel, config, log, std::move(bus));
}

void clear_ioflex02_outputs(Rack& rack, const StopReaction&) {
    for (const auto& card : rack.cards())
        if (auto* board = dynamic_cast<Ioflex02Card*>(card.get()); board != nullptr) board->card().clear_outputs();
}

constexpr std::array<StopReaction, 1> ioflex02_stops = {
    {{"ioflex02", every_stop, StopCategory::category_0, StopBy::latch, "its outputs go to 0; counting continues",
      milliseconds(2), false, clear_ioflex02_outputs, StopOrder::digital_outputs}}};

}  // namespace

constinit const CardPlugin ioflex02_plugin = {
    .type = {.name = "ioflex02",
             .doc = "position card for four encoders with calibration and time; it moves no axis, and its lines are "
                    "wires",
             .chip_pins = ioflex02_pins,
             .settings = ioflex02_settings,
             .settings_of = ioflex02_of,
             .max_position = 8'388'607,
             .flaw = ioflex02_flaw,
             .measures_only = true},
    .map = io::card_map,
    .make = make_ioflex02,
    .no_live_port =
        "An IOFLEX02 has no live port: its hardware manual is not at hand, so the registers of the virtual one are "
        "this project's own, and no real one has them.",
    .stop_reactions = ioflex02_stops};

std::vector<std::uint8_t> ioflex02_image_at(const RackConfig& config, std::uint32_t base_address) {
    for (const RackCard& card : config.cards)
        if (card.type == io::card_map().name && ioflex02_in(card).base_address == base_address)
            return *io::bytes_of_hex(ioflex02_in(card).image);
    return {};
}

io::Card* ioflex02_card_of(Rack& rack, std::string_view name) {
    auto* card = dynamic_cast<Ioflex02Card*>(rack.card(name));
    return card != nullptr ? &card->card() : nullptr;
}

}  // namespace motionrack::rack
