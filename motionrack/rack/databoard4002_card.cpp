// The DataBoard 4002 in a rack; all boards of a rack share one bus. An ideal motor follows the pulses of a card without
// an axis.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <motionrack/cards/databoard4002/axes/position_axis.hpp>
#include <motionrack/cards/databoard4002/library/library.hpp>
#include <motionrack/cards/databoard4002/map.hpp>
#include <motionrack/cards/databoard4002/model/bus.hpp>
#include <motionrack/cards/databoard4002/model/card.hpp>
#include <motionrack/cards/databoard4002/trim_text.hpp>
#include <motionrack/rack/byte_bus.hpp>
#include <motionrack/rack/databoard4002_card.hpp>

namespace motionrack::rack {

namespace {

namespace db = databoard4002;

db::Settings settings_of(const Databoard4002Settings& s) {
    struct Straps {
        db::Counting counting;
        sim::Edges folding;
    };
    constexpr std::array<Straps, 4> straps = {{{db::Counting::quadrature, sim::Edges::all},
                                               {db::Counting::quadrature, sim::Edges::both_of_a},
                                               {db::Counting::quadrature, sim::Edges::rising_a},
                                               {db::Counting::up_down, sim::Edges::all}}};
    db::Settings out;
    out.firmware_pass_ticks = static_cast<std::int32_t>(s.firmware_pass_ticks);
    out.byte_time = nanoseconds(s.byte_time_ns);
    out.version = static_cast<std::uint8_t>(s.version);
    out.zeroing = s.zeroing;
    out.quit_zeroes = s.quit_zeroes;
    out.trim = *db::trim_from_text(s.trim);
    out.counting = straps[static_cast<std::size_t>(s.count_mode)].counting;
    out.folding = straps[static_cast<std::size_t>(s.count_mode)].folding;
    out.first_pair = static_cast<std::int32_t>(s.first_pair);
    out.single_ended = s.single_ended;
    return out;
}

/// Converts the axis to the card's own counts: edges that the straps pass, velocities by voltage or frequency.
db::PositionAxisSettings axis_settings(const RackConfig& config, const RackAxis& axis,
                                       Databoard4002CountMode count_mode) {
    constexpr std::array<double, 4> counts_of_edge = {1, 0.5, 0.25, 1};
    db::PositionAxisSettings out;
    out.name = std::string(1, axis.letter);
    out.unit = axis.unit();
    out.limits = config.limits()[static_cast<std::size_t>(axis.index())];
    out.counts_per_unit = axis.counts_per_unit() * counts_of_edge[static_cast<std::size_t>(count_mode)];
    if (axis.servo) {
        out.scale.trim = *db::trim_from_text(databoard4002_in(*config.card(axis.card)).trim);
        out.scale.analog = true;
        out.scale.counts_per_volt = axis.servo->velocity_per_volt * out.counts_per_unit;
        out.lag_s = axis.servo->time_constant_ms * 1e-3 * (1 + axis.servo->load_inertia_ratio);
        out.position_window = axis.servo->position_window;
    } else {
        out.scale.counts_per_pulse = out.counts_per_unit / axis.pulses_per_unit();
    }
    return out;
}

/// A value by its name.
struct ByteValue {
    std::string_view name;
    double (*get)(const db::Card& card);
    std::string_view doc = {};
};

// Quantities of the C boundary.
constexpr ByteValue quantities_of_card[] = {
    {"fout_hz", [](const db::Card& card) { return card.fout_hz(); }, "frequency of the pulses at FOUT"},
    {"position_counts", [](const db::Card& card) { return static_cast<double>(card.position()); },
     "value of its position counter"},
};

// Values beside the registers; own_number: card number written to port 1 to select the card.
constexpr std::string_view own_number = "SELECT";
constexpr ByteValue inspected[] = {
    {"POSITION", [](const db::Card& card) { return static_cast<double>(card.position()); }},
    {"RATE", [](const db::Card& card) { return static_cast<double>(card.output_rate()); }},
    {"MOVING", [](const db::Card& card) { return card.moving() ? 1.0 : 0.0; }},
    {"LOCKED", [](const db::Card& card) { return card.locked() ? 1.0 : 0.0; }},
    {"EVENT", [](const db::Card& card) { return static_cast<double>(card.event_word()); }},
};

class Databoard4002Card final : public ByteBusCard<MotionCard> {
  public:
    Databoard4002Card(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log, std::shared_ptr<db::Bus> bus)
        : name_(config.name),
          card_number_(databoard4002_in(config).card_number),
          card_(kernel, config.name, settings_of(databoard4002_in(config))),
          bus_(bus ? std::move(bus) : std::make_shared<db::Bus>(kernel, "databoard")),
          port_(kernel, *bus_, bus_->id(), bus_->interrupt_wire(), nanoseconds(databoard4002_in(config).bus_access_ns),
                &log) {
        bus_->plug(card_, static_cast<std::uint8_t>(databoard4002_in(config).card_number));
    }

    const std::shared_ptr<db::Bus>& bus() const { return bus_; }
    const db::Card& card() const { return card_; }

    const std::string& name() const override { return name_; }
    sim::DeviceId device() const override { return card_.id(); }
    const CardMap& map() const override { return db::card_map(); }

    Result<std::int64_t> inspect(std::string_view name) const override {
        std::vector<std::string_view> more;
        for (const ByteValue& value : inspected) {
            if (value.name == name) return static_cast<std::int64_t>(value.get(card_));
            more.push_back(value.name);
        }
        if (name == own_number) return card_number_;
        more.push_back(own_number);
        for (const RegisterInfo& reg : map().registers)
            if (reg.name == name && reg.access != Access::write && reg.bank.empty())
                return card_.peek(static_cast<std::uint8_t>(reg.offset));
        return no_such_value(*this, name, more);
    }
    std::vector<std::string> value_names() const override {
        std::vector<std::string> out = {std::string(own_number)};
        for (const ByteValue& value : inspected) out.emplace_back(value.name);
        return out;
    }
    std::optional<double> quantity(std::string_view name) const override {
        for (const ByteValue& value : quantities_of_card)
            if (value.name == name) return value.get(card_);
        return std::nullopt;
    }
    std::vector<std::string_view> quantity_names() const override {
        std::vector<std::string_view> out;
        for (const ByteValue& value : quantities_of_card) out.push_back(value.name);
        return out;
    }

    std::string_view quantity_doc(std::string_view name) const override {
        for (const ByteValue& value : quantities_of_card)
            if (value.name == name) return value.doc;
        return {};
    }

    std::vector<CardCounter> counters() const override { return {{"position", 0, true}}; }
    int channel_number(std::string_view) const override { return 0; }
    sim::PositionFunction& pulses(int) override { return card_.pulses(); }
    void connect_encoder(int, sim::PositionFunction& counts) override { card_.connect_encoder(counts); }
    void take_encoder(int, bool taken) override { card_.take_encoder(taken); }
    void connect_ideal_machine() override {
        card_.connect_encoder(card_.pulses());
        ideal_ = true;
    }
    std::span<const std::string_view> ideal_encoder() const override {
        static constexpr std::string_view pins[] = {"o1", "o2"};
        if (!ideal_) return {};
        return pins;
    }
    Result<control::AxisGroup*> path_axes(const RackConfig&, const std::optional<control::Point>&) override {
        return fail(
            ErrorKind::refused,
            fmt::format("Card {} positions its one axis by itself and follows no paths. Nothing was moved.", name_));
    }
    Result<control::Axis*> axis(const RackConfig& config, char letter) override {
        if (axis_ && !given_away_) return axis_.get();
        const RackAxis* found = config.axis(letter);
        MOTIONRACK_ASSERT(found != nullptr && found->card == name_);
        const Databoard4002Settings& own = databoard4002_in(*config.card(name_));
        db::DriverSettings settings;
        settings.select = static_cast<std::uint8_t>(own.card_number);
        auto driver = std::make_unique<db::Driver>(port_, port_, settings);
        auto made = std::make_unique<db::PositionAxis>(*driver, port_, axis_settings(config, *found, own.count_mode));
        MOTIONRACK_CHECK(made->set_up());
        axis_ = std::move(made);
        driver_ = std::move(driver);
        given_away_ = false;
        return axis_.get();
    }
    std::span<const FunctionInfo> library_functions() const override { return db::library_functions(); }
    std::unique_ptr<FunctionLibrary> take_library() override {
        given_away_ = true;  // the axis group keeps this axis until the next one is made
        return std::make_unique<db::CommandLibrary>(port_, port_, static_cast<std::uint8_t>(card_number_));
    }
    double accel_reserve() const override { return 0; }
    double jump_hz(const RackConfig&) const override { return std::numeric_limits<double>::infinity(); }
    std::int64_t segments() const override { return 0; }
    std::int64_t pulses_made(int) override { return 0; }
    std::int64_t pulse_counter(int) override { return card_.position(); }
    std::int64_t encoder_counter(int) override { return card_.position(); }
    double counter_origin() const override { return axis_ ? axis_->counter_origin() : 0; }

    std::span<const std::string_view> fault_names() const override { return db::Card::fault_names(); }
    bool fault(std::string_view name, double value, Instant now) override { return card_.fault(name, value, now); }
    sim::VirtualBytePort* byte_port() override { return &port_; }
    bool speaks_for(sim::DeviceId id) const override { return id == card_.id() || id == bus_->id(); }
    std::string describe(const sim::Condition& condition) const override { return db::describe(condition, name_); }
    std::optional<std::uint16_t> watchdog_condition() const override {
        return static_cast<std::uint16_t>(db::CardCondition::watchdog_reset);
    }

  private:
    std::string name_;
    std::int64_t card_number_;
    db::Card card_;
    std::shared_ptr<db::Bus> bus_;
    sim::VirtualBytePort port_;
    std::unique_ptr<db::Driver> driver_;
    std::unique_ptr<db::PositionAxis> axis_;
    bool given_away_ = false;  // to a library
    bool ideal_ = false;       // an ideal motor follows its pulses
};

}  // namespace

std::unique_ptr<Card> make_databoard4002(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                         std::span<const std::unique_ptr<Card>> before) {
    std::shared_ptr<db::Bus> bus;
    for (const auto& other : before)
        if (const auto* same = dynamic_cast<const Databoard4002Card*>(other.get())) bus = same->bus();
    return std::make_unique<Databoard4002Card>(kernel, config, log, std::move(bus));
}

const db::Card* databoard4002_card_of(Rack& rack, std::string_view name) {
    const auto* found = dynamic_cast<const Databoard4002Card*>(rack.card(name));
    return found != nullptr ? &found->card() : nullptr;
}

}  // namespace motionrack::rack
