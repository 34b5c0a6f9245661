// The IOFLEX02 in a rack. All boards of a rack share one bus, on which each answers at its base address. It moves
// nothing; its lines are wires.
#include <motionrack/cards/ioflex02/image.hpp>
#include <motionrack/cards/ioflex02/map.hpp>
#include <motionrack/cards/ioflex02/model/bus.hpp>
#include <motionrack/cards/ioflex02/model/card.hpp>
#include <motionrack/rack/ioflex02_card.hpp>

namespace motionrack::rack {

namespace {

namespace io = ioflex02;

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
          card_(kernel, config.name, settings_of(config.ioflex02)),
          bus_(bus ? std::move(bus) : std::make_shared<io::Bus>(kernel, "ioflex")),
          port_(kernel, *bus_, bus_->id(), bus_->interrupt_wire(), nanoseconds(config.ioflex02.bus_access_ns), &log) {
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

}  // namespace

std::unique_ptr<Card> make_ioflex02(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                    std::span<const std::unique_ptr<Card>> before) {
    std::shared_ptr<io::Bus> bus;
    for (const auto& other : before)
        if (const auto* same = dynamic_cast<const Ioflex02Card*>(other.get())) bus = same->bus();
    return std::make_unique<Ioflex02Card>(kernel, config, log, std::move(bus));
}

std::vector<std::uint8_t> ioflex02_image_at(const RackConfig& config, std::uint32_t base_address) {
    for (const RackCard& card : config.cards)
        if (card.type == io::card_map().name && card.ioflex02.base_address == base_address)
            return *io::bytes_of_hex(card.ioflex02.image);
    return {};
}

io::Card* ioflex02_card_of(Rack& rack, std::string_view name) {
    auto* card = dynamic_cast<Ioflex02Card*>(rack.card(name));
    return card != nullptr ? &card->card() : nullptr;
}

}  // namespace motionrack::rack
