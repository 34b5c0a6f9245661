// The RTC5 in a rack: no bus, no axes; its lines are wires, and programs give it commands.
#include <algorithm>
#include <array>
#include <motionrack/cards/rtc5/map.hpp>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/own_pins.hpp>
#include <motionrack/rack/rtc5_card.hpp>

namespace motionrack::rack {

namespace {

using rtc5::Engine;

/// Keys of a rack file; settings_of() makes the model's settings of them.
struct Rtc5Settings {
    std::int64_t list_memory = 1 << 20;  ///< 16 .. 1,048,576 positions
};

constexpr auto rtc5_pins = [] {
    auto out = own_pins<std::size(rtc5::map::pins)>(rtc5::map::pins.data());
    for (std::size_t i = 0; i < out.size(); ++i) out[i].bits = rtc5::map::lines[i].bits;
    return out;
}();

constexpr std::array<Field, 1> rtc5_settings = {
    field<&Rtc5Settings::list_memory>("list_memory", rtc5::min_list_memory, rtc5::max_list_memory, "",
                                      "positions for list commands; a copy of the rack copies them all"),
};

void* rtc5_of(RackCard& card) {
    return &card.settings.edit<Rtc5Settings>();
}

/// Makes the model's settings. Lists are as at power-up, or the two halves of a small memory.
rtc5::Settings settings_of(const Rtc5Settings& s) {
    rtc5::Settings out;
    out.list_memory = s.list_memory;
    out.list1 = out.list2 = std::min(out.list1, s.list_memory / 2);
    return out;
}

/// A value beside the status words.
struct WordValue {
    std::string_view name;
    std::int64_t (*get)(const Engine& engine);
};
constexpr WordValue values[] = {
    {"STATUS", [](const Engine& e) { return std::int64_t{e.status()}; }},
    {"MARKING_INFO", [](const Engine& e) { return e.state().flags.marking_info; }},
    {"STARTSTOP_INFO", [](const Engine& e) { return std::int64_t{e.startstop_info()}; }},
    {"LIST_STATUS", [](const Engine& e) { return std::int64_t{e.parts().lists.status()}; }},
    {"XOUT", [](const Engine& e) { return std::int64_t{e.output().a[0]}; }},
    {"YOUT", [](const Engine& e) { return std::int64_t{e.output().a[1]}; }},
    {"XOUT_B", [](const Engine& e) { return std::int64_t{e.output().b[0]}; }},
    {"YOUT_B", [](const Engine& e) { return std::int64_t{e.output().b[1]}; }},
    {"LIST_POSITION", [](const Engine& e) { return e.parts().execution.position(); }},
    {"INPUT_POSITION", [](const Engine& e) { return e.input_pointer(); }},
    {"ENCODER0", [](const Engine& e) { return std::int64_t{e.encoder(0)}; }},
    {"ENCODER1", [](const Engine& e) { return std::int64_t{e.encoder(1)}; }},
    {"MCBSP0", [](const Engine& e) { return std::int64_t{e.state().mcbsp.memory[0]}; }},
    {"MCBSP1", [](const Engine& e) { return std::int64_t{e.state().mcbsp.memory[1]}; }},
    {"MCBSP2", [](const Engine& e) { return std::int64_t{e.state().mcbsp.memory[2]}; }},
    {"MCBSP3", [](const Engine& e) { return std::int64_t{e.state().mcbsp.memory[3]}; }},
    {"STARTS_WAITING", [](const Engine& e) { return e.state().starts.waiting; }},
    {"IO", [](const Engine& e) { return e.state().io; }},
    {"TICK", [](const Engine& e) { return e.tick(); }},
};

struct Number {
    std::string_view name;
    double (*get)(const Engine& engine);
    std::string_view doc;
};
constexpr Number numbers[] = {
    {"jump_speed_bits_ms", [](const Engine& e) { return e.state().path.jump_speed; }, "speed of its jumps"},
    {"mark_speed_bits_ms", [](const Engine& e) { return e.state().path.mark_speed; }, "speed of its marks"},
    {"corrected_x_bits", [](const Engine& e) { return e.output().corrected.x; }, "X after all corrections"},
    {"corrected_y_bits", [](const Engine& e) { return e.output().corrected.y; }, "Y after all corrections"},
    {"encoder_speed_counts_ms", [](const Engine& e) { return e.parts().encoders.speed(); },
     "speed of the encoder that it follows, signed"},
};

/// Host time for a program beside the card; the end of a list serves as its interrupt.
class Host final : public sim::VirtualHost {
  public:
    Host(sim::Kernel& kernel, const rtc5::Card& card, sim::InputLog& log)
        : VirtualHost(kernel, card.id(), card.busy_wire(), 0, Duration{0}, &log) {}
};

class Rtc5Card final : public Card {
  public:
    Rtc5Card(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log)
        : name_(config.name),
          card_(kernel, config.name, settings_of(config.settings.get<Rtc5Settings>())),
          host_(kernel, card_, log) {}

    rtc5::Card& card() { return card_; }

    const std::string& name() const override { return name_; }
    sim::DeviceId device() const override { return card_.id(); }
    const CardMap& map() const override { return rtc5::card_map(); }
    std::span<const int> bus_widths() const override { return {}; }
    std::uint32_t bus_read(int, std::uint32_t) override { return 0; }
    void bus_write(int, std::uint32_t, std::uint32_t) override {}

    Result<std::int64_t> inspect(std::string_view name) const override {
        std::vector<std::string_view> more;
        for (const auto& [known, get] : values) {
            if (known == name) return get(card_.engine());
            if (more.empty() && known != "XOUT") continue;  // the status words are in the map
            more.push_back(known);
        }
        return no_such_value(*this, name, more);
    }
    std::vector<std::string> value_names() const override {
        std::vector<std::string> out;
        for (const WordValue& value : values)
            if (std::none_of(map().registers.begin(), map().registers.end(),
                             [&](const RegisterInfo& reg) { return reg.name == value.name; }))
                out.emplace_back(value.name);
        return out;
    }
    std::vector<CardCounter> counters() const override { return {{"encoder0", 0, true}, {"encoder1", 1, true}}; }
    std::int64_t counter(const CardCounter& which) override { return card_.caught_up().encoder(which.channel); }
    std::optional<double> quantity(std::string_view name) const override {
        for (const Number& number : numbers)
            if (number.name == name) return number.get(card_.engine());
        return std::nullopt;
    }
    std::vector<std::string_view> quantity_names() const override {
        std::vector<std::string_view> out;
        for (const Number& number : numbers) out.push_back(number.name);
        return out;
    }
    std::string_view quantity_doc(std::string_view name) const override {
        for (const Number& number : numbers)
            if (number.name == name) return number.doc;
        return {};
    }
    void copy_from(const Card& other) override { card_.copy_beside_state(dynamic_cast<const Rtc5Card&>(other).card_); }

    sim::VirtualHost& host() override { return host_; }
    std::string describe(const sim::Condition& condition) const override { return rtc5::describe(condition, name_); }

  private:
    std::string name_;
    rtc5::Card card_;
    Host host_;
};

std::unique_ptr<Card> make_rtc5(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                std::span<const std::unique_ptr<Card>>) {
    return std::make_unique<Rtc5Card>(kernel, config, log);
}

/// Ends lists, blocks starts, and closes the laser's gate at this tick.
void laser_off(Rack& rack, const StopReaction&) {
    for (const auto& card : rack.cards())
        if (auto* laser = dynamic_cast<Rtc5Card*>(card.get()); laser != nullptr) {
            laser->card().engine().set_control_mode(0);
            laser->card().engine().stop_execution();
        }
}

constexpr std::array<StopReaction, 1> rtc5_stops = {
    {{"rtc5", every_stop, StopCategory::category_0, StopBy::latch,
      "the laser goes off, lists end, and starts are no longer accepted; the mirrors stay where they are",
      milliseconds(2), false, laser_off, StopOrder::laser}}};

}  // namespace

constinit const CardPlugin rtc5_plugin = {
    .type = {.name = "rtc5",
             .doc =
                 "control of a laser scan head that marks moving parts; it moves no axis and has no bus: programs use "
                 "the commands of its library",
             .chip_pins = rtc5_pins,
             .settings = rtc5_settings,
             .settings_of = rtc5_of,
             .marks = true},
    .map = rtc5::card_map,
    .make = make_rtc5,
    .no_live_port =
        "An RTC5 has no live port: a real one is driven through its maker's DLL, and no source names the registers "
        "behind it.",
    .stop_reactions = rtc5_stops};

rtc5::Card* rtc5_card_of(Rack& rack, std::string_view name) {
    auto* card = dynamic_cast<Rtc5Card*>(rack.card(name));
    return card ? &card->card() : nullptr;
}

}  // namespace motionrack::rack
