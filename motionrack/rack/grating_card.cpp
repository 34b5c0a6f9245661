// The grating bus in a rack: motion cards and decoder share one bus, which the first of them creates.
#include <algorithm>
#include <array>
#include <charconv>
#include <motionrack/cards/grating_bus/map.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/grating.hpp>
#include <motionrack/rack/grating_card.hpp>
#include <motionrack/rack/own_pins.hpp>

namespace motionrack::rack {

namespace {

namespace gb = grating_bus;

constexpr auto grating_bus_pins = own_pins<std::size(gb::map::pins)>(gb::map::pins);
constexpr auto grating_decoder_pins = [] {
    std::array<PinType, std::size(gb::map::scale_pins)> out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = {gb::map::scale_pins[i].view(), PinDirection::input, gb::map::decoder_pins[i % 2].meaning};
    return out;
}();

constexpr std::array<std::string_view, 4> grating_roles = {"first is host", "host", "slave", "remote"};
constexpr std::array<std::string_view, 3> shifter_ways = {"as role", "out", "in"};

constexpr std::array<Field, 15> grating_bus_settings = {
    with_choices(field<&GratingBusSettings::role>(
                     "role", 0, 0, "",
                     "the host drives clock and addresses, slaves only read; the first card of the rack is the host by "
                     "default; a remote one listens to a bus on another computer (motionrack "
                     "frames feed)"),
                 grating_roles),
    field<&GratingBusSettings::scales>("scales", 1, 128, "", "scales of a frame"),
    field<&GratingBusSettings::first>("first", 0, 127, "", "address of the first scale"),
    field<&GratingBusSettings::addresses>(
        "addresses", 0, 600, "",
        "addresses of the scales in the order in which they are read, as in \"5, 2, 9\", each 0 to 127 and only once; "
        "excludes scales and first; empty: from first on, as many as scales"),
    field<&GratingBusSettings::t1_ns>("t1_ns", 0.1, 6'000, "ns", "wait until the decoder has latched"),
    field<&GratingBusSettings::t2_ns>("t2_ns", 0.1, 6'000, "ns", "wait from the address to stable data"),
    field<&GratingBusSettings::t3_ns>("t3_ns", 0.1, 6'000, "ns", "wait until the data are latched"),
    field<&GratingBusSettings::clock_ns>("clock_ns", 0.1, 6'000, "ns", "period of the logic's clock"),
    field<&GratingBusSettings::period_us>("period_us", 1, 100'000, "us", "period of the frames"),
    field<&GratingBusSettings::offset_ns>("offset_ns", 0, 1e8, "ns", "time of a host's first frame, at most a period"),
    with_choices(field<&GratingBusSettings::clock_shifter>("clock_shifter", 0, 0, "",
                                                           "direction of the level shifter of clk, hold and read_n"),
                 shifter_ways),
    with_choices(field<&GratingBusSettings::address_shifter>("address_shifter", 0, 0, "",
                                                             "direction of the level shifter of addr"),
                 shifter_ways),
    formerly("checks", field<&GratingBusSettings::verify_lines>("verify_lines", 0, 0, "",
                                                                "frames with wrong line levels are not published")),
    field<&GratingBusSettings::seed>("seed", 0, 2'147'483'647, "", "of the jitter that can be injected"),
    field<&GratingBusSettings::bus_access_ns>("bus_access_ns", 0, 100'000, "ns",
                                              "time that one access of the processor takes"),
};

constexpr std::array<Field, 4> grating_decoder_settings = {
    field<&GratingDecoderSettings::scales>("scales", 1, 128, "",
                                           "number of scales that it counts, each with a pair of pins a0 b0, a1 b1 .."),
    field<&GratingDecoderSettings::latch_ns>("latch_ns", 0, 6'000, "ns", "from HOLD to valid counts"),
    field<&GratingDecoderSettings::output_ns>("output_ns", 0.1, 6'000, "ns", "from the address to valid data"),
    field<&GratingDecoderSettings::bus_access_ns>("bus_access_ns", 0, 100'000, "ns",
                                                  "time that one access of the host takes"),
};

void* grating_bus_settings_of(RackCard& card) {
    return &card.settings.edit<GratingBusSettings>();
}

void* grating_decoder_settings_of(RackCard& card) {
    return &card.settings.edit<GratingDecoderSettings>();
}

double frame_period_us(const RackCard& card) {
    return grating_bus_in(card).period_us;
}

std::int64_t decoded_scales(const RackCard& card) {
    return grating_decoder_in(card).scales;
}

/// Common base of a motion card and a decoder.
class Member : public Card {
  public:
    Member(const RackCard& config, std::shared_ptr<gb::Bus> bus) : name_(config.name), bus_(std::move(bus)) {}
    const std::shared_ptr<gb::Bus>& bus() const { return bus_; }

    const std::string& name() const override { return name_; }
    std::span<const int> bus_widths() const override {
        static constexpr int words[] = {16};
        return words;
    }
    std::span<const std::string> shared_wires() const override { return bus_->wire_names(); }
    bool speaks_for(sim::DeviceId id) const override { return id == device() || id == bus_->id(); }
    std::string describe(const sim::Condition& condition) const override {
        return condition.device == bus_->id() ? gb::describe(condition, *bus_) : gb::describe(condition, name_);
    }

  protected:
    static bool in_counts(std::uint32_t offset, int scales) {
        return offset >= gb::counts_at && offset < gb::counts_at + 4 * static_cast<std::uint32_t>(scales);
    }
    static std::vector<CardCounter> scale_counters(int scales) {
        std::vector<CardCounter> out;
        for (int n = 0; n < scales; ++n) out.push_back({"scale" + std::to_string(n), n, true});
        return out;
    }
    static std::vector<std::string> scale_values(int scales) {
        std::vector<std::string> out;
        for (int n = 0; n < scales; ++n) out.push_back(std::to_string(n) + ".COUNT");
        return out;
    }
    /// Reads a register by name; an unknown name gives an error that lists the readable ones and `more`.
    Result<std::int64_t> register_value(const sim::RegisterDevice& device, std::string_view name,
                                        std::span<const std::string_view> more) const {
        for (const RegisterInfo& reg : map().registers)
            if (reg.name == name && reg.access != Access::write) return device.peek(reg.offset);
        return no_such_value(*this, name, more);
    }
    /// Returns the number in front of `of` if it is below `scales`; else -1.
    static int scale_of(std::string_view name, int scales, std::string_view of = ".COUNT") {
        int n = -1;
        const auto [end, bad] = std::from_chars(name.data(), name.data() + name.size(), n);
        const bool whole = bad == std::errc() && std::string_view(end, name.data() + name.size()) == of;
        return whole && n >= 0 && n < scales ? n : -1;
    }

    std::string name_;
    std::shared_ptr<gb::Bus> bus_;
};

class GratingCard final : public Member {
  public:
    GratingCard(sim::Kernel& kernel, const RackCard& config, const gb::CardSettings& settings, sim::InputLog& log,
                std::shared_ptr<gb::Bus> bus)
        : Member(config, std::move(bus)),
          kernel_(kernel),
          card_(kernel, config.name, *bus_, settings),
          port_(kernel, card_, card_.id(), card_.interrupt_wire(), nanoseconds(grating_bus_in(config).bus_access_ns),
                &log) {}

    gb::Card& card() { return card_; }

    sim::DeviceId device() const override { return card_.id(); }
    const CardMap& map() const override { return gb::card_map(); }
    /// All edges of a frame follow its start by a sum of these times.
    Duration edge_unit() const override {
        const gb::BusTiming& t = card_.settings().timing;
        Duration unit = nanoseconds(10);
        for (const Duration time : {t.t1, t.t2, t.t3, t.clock, card_.settings().period, card_.settings().offset})
            while (time % unit != Duration{0}) unit /= 10;
        return unit;
    }
    sim::RegisterDevice* registers() override { return &card_; }
    bool in_window(std::uint32_t offset) const override {
        const auto words = static_cast<std::uint32_t>(card_.settings().scales);
        for (const std::uint32_t begin : {gb::addresses_at, gb::list_at})
            if (offset >= begin && offset < begin + 2 * words) return true;
        return in_counts(offset, card_.settings().scales);
    }
    std::uint32_t bus_read(int, std::uint32_t address) override { return port_.read(address); }
    void bus_write(int, std::uint32_t address, std::uint32_t value) override {
        port_.write(address, static_cast<std::uint16_t>(value));
    }

    Result<std::int64_t> inspect(std::string_view name) const override {
        static constexpr std::string_view more[] = {"0.COUNT ..", "0.ADDRESS ..", "SEQUENCE", "TIME"};
        const gb::Frame* frame = card_.last();
        if (name == "SEQUENCE") return frame ? frame->sequence : 0;
        if (name == "TIME") return frame ? frame->time : 0;
        if (const int n = scale_of(name, card_.settings().scales); n >= 0) return count(n);
        if (const int n = scale_of(name, card_.settings().scales, ".ADDRESS"); n >= 0)
            return frame ? frame->addresses[static_cast<std::size_t>(n)] : 0;
        return register_value(card_, name, more);
    }
    std::vector<std::string> value_names() const override {
        std::vector<std::string> out = scale_values(card_.settings().scales);
        for (int n = 0; n < card_.settings().scales; ++n) out.push_back(std::to_string(n) + ".ADDRESS");
        out.insert(out.end(), {"SEQUENCE", "TIME"});
        return out;
    }
    std::vector<CardCounter> counters() const override { return scale_counters(card_.settings().scales); }
    std::int64_t counter(const CardCounter& which) override { return count(which.channel); }

    std::vector<std::string_view> quantity_names() const override { return {"age_us", "sequence", "stale"}; }
    std::string_view quantity_doc(std::string_view name) const override {
        if (name == "age_us") return "age of its last published frame; -1: none";
        if (name == "sequence") return "number of that frame; -1: none";
        return "1 while its frame is too old to be used, else 0";
    }
    std::optional<double> quantity(std::string_view name) const override {
        const gb::Frame* frame = card_.last();
        if (name == "stale") return card_.stale() ? 1 : 0;
        if (name == "sequence") return frame ? static_cast<double>(frame->sequence) : -1;
        if (name == "age_us") return frame ? to_seconds(kernel_.now() - card_.held_since()) * 1e6 : -1;
        return std::nullopt;
    }
    std::span<const std::string_view> fault_names() const override {
        static constexpr std::string_view of_host[] = {"off", "reset", "jitter"},
                                          of_slave[] = {"off", "reset", "late", "miss_edge"};
        return card_.is_host() ? std::span<const std::string_view>(of_host)
                               : std::span<const std::string_view>(of_slave);
    }
    bool fault(std::string_view name, double value, Instant now) override { return card_.fault(name, value, now); }

    void complete() override {
        if (!bus_->decoders().empty() || card_.is_remote()) return;
        const bool taken = kernel_.find_wire("decoder.a0") != sim::WireId::none;
        gb::DecoderSettings settings;
        settings.scales = 1;
        for (const gb::Card* card : bus_->cards())
            if (!card->is_remote()) settings.scales = std::max(settings.scales, card->settings().last_address() + 1);
        const std::string name = taken ? name_ + ".decoder" : "decoder";
        own_decoder_ = std::make_unique<gb::Decoder>(kernel_, name, *bus_, settings);
        wires_ = bus_->wire_names();
        for (int n = 0; n < settings.scales; ++n)
            for (const char* line : {".a", ".b"}) wires_.push_back(name + line + std::to_string(n));
    }
    std::span<const std::string> shared_wires() const override { return own_decoder_ ? wires_ : bus_->wire_names(); }

    sim::VirtualHost& host() override { return port_; }
    sim::VirtualPort* port() override { return &port_; }

  private:
    std::int64_t count(int n) const {
        const gb::Frame* frame = card_.last();
        return frame ? static_cast<std::int32_t>(frame->counts[static_cast<std::size_t>(n)]) : 0;
    }

    sim::Kernel& kernel_;
    gb::Card card_;
    sim::VirtualPort port_;
    std::unique_ptr<gb::Decoder> own_decoder_;  // for a rack whose file has none
    std::vector<std::string> wires_;            // includes those of that decoder
};

class DecoderCard final : public Member {
  public:
    DecoderCard(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log, std::shared_ptr<gb::Bus> bus)
        : Member(config, std::move(bus)),
          kernel_(kernel),
          decoder_(kernel, config.name, *bus_, decoder_settings(config)),
          port_(kernel, decoder_, decoder_.id(), decoder_.interrupt_wire(),
                nanoseconds(grating_decoder_in(config).bus_access_ns), &log) {}

    gb::Decoder& decoder() { return decoder_; }

    sim::DeviceId device() const override { return decoder_.id(); }
    const CardMap& map() const override { return gb::decoder_map(); }
    sim::RegisterDevice* registers() override { return &decoder_; }
    bool in_window(std::uint32_t offset) const override { return in_counts(offset, decoder_.settings().scales); }
    std::uint32_t bus_read(int, std::uint32_t address) override { return port_.read(address); }
    void bus_write(int, std::uint32_t address, std::uint32_t value) override {
        port_.write(address, static_cast<std::uint16_t>(value));
    }

    Result<std::int64_t> inspect(std::string_view name) const override {
        static constexpr std::string_view more[] = {"0.COUNT .."};
        if (const int n = scale_of(name, decoder_.settings().scales); n >= 0)
            return decoder_.position(n, kernel_.now());
        return register_value(decoder_, name, more);
    }
    std::vector<std::string> value_names() const override { return scale_values(decoder_.settings().scales); }
    std::vector<CardCounter> counters() const override { return scale_counters(decoder_.settings().scales); }
    std::int64_t counter(const CardCounter& which) override { return decoder_.position(which.channel, kernel_.now()); }
    std::span<const std::string_view> fault_names() const override {
        static constexpr std::string_view names[] = {"no_latch"};
        return names;
    }
    bool fault(std::string_view name, double value, Instant now) override { return decoder_.fault(name, value, now); }

    sim::VirtualHost& host() override { return port_; }
    sim::VirtualPort* port() override { return &port_; }

  private:
    sim::Kernel& kernel_;
    gb::Decoder decoder_;
    sim::VirtualPort port_;
};

std::shared_ptr<gb::Bus> bus_of(sim::Kernel& kernel, std::span<const std::unique_ptr<Card>> before) {
    for (const auto& other : before)
        if (const auto* member = dynamic_cast<const Member*>(other.get())) return member->bus();
    return std::make_shared<gb::Bus>(kernel);
}

std::unique_ptr<Card> make_grating_bus(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                       std::span<const std::unique_ptr<Card>> before) {
    const bool first = std::none_of(before.begin(), before.end(), [](const auto& card) {
        auto* other = dynamic_cast<GratingCard*>(card.get());
        return other && !other->card().is_remote();
    });
    return std::make_unique<GratingCard>(kernel, config, grating_settings(config, first), log, bus_of(kernel, before));
}

std::unique_ptr<Card> make_grating_decoder(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                           std::span<const std::unique_ptr<Card>> before) {
    return std::make_unique<DecoderCard>(kernel, config, log, bus_of(kernel, before));
}

std::unique_ptr<CardProcessor> stage_processor(sim::Kernel& kernel, Card& card) {
    return std::make_unique<CardProcessor>(kernel, card.name() + ".processor", dynamic_cast<GratingCard&>(card).card());
}

void connect_scale(Card& card, int input, sim::PositionFunction& scale) {
    dynamic_cast<GratingCard&>(card).bus()->decoders()[0]->connect(input, &scale);
}

/// Returns the maximum value of the fault frame jitter, ns: less than half a period, in steps of 0.1 ns.
double max_frame_jitter_ns(const RackCard& card) {
    return std::min(grating_bus_in(card).period_us * 500 - 0.1, max_push);
}

constexpr std::array<CardFault, 5> grating_bus_faults = {{
    {"off", 0, 1, "", "1: the card has no power; 0: power returns, the card is reset"},
    {"reset", 0, 1, "", "1: the card is reset"},
    {"late", 0, max_push, "ns", "delay of the frames of the slave"},
    {"miss_edge", 0, max_push, "edges", "number of the next edges of HOLD that the slave misses"},
    {"jitter", 0, 0, "ns", "maximum delay of the host's frames", max_frame_jitter_ns},
}};
constexpr std::array<CardFault, 1> grating_decoder_faults = {
    {{"no_latch", 0, 1, "", "1: the decoder does not latch its counts; 0 repairs it"}}};

/// Sets the analog outputs without a control loop to 0 V.
void clear_analog_outputs(Rack& rack, const StopReaction&) {
    for (const auto& card : rack.cards()) {
        auto* found = dynamic_cast<GratingCard*>(card.get());
        if (found == nullptr) continue;
        for (int output = 0; output < gb::output_count; ++output)
            if (std::none_of(rack.stages().begin(), rack.stages().end(), [&](const RunningStage& stage) {
                    return stage.processor != nullptr && stage.config.card == card->name() &&
                           stage.config.output == output;
                }))
                found->card().put_out(output, 0);
    }
}

constexpr std::array<StopReaction, 1> grating_bus_stops = {
    {{"grating_bus", every_stop, StopCategory::category_0, StopBy::latch,
      "analog outputs without a loop go to 0 V; frames continue", milliseconds(2), false, clear_analog_outputs,
      StopOrder::analog_outputs}}};

constexpr std::string_view no_grating_bus_port =
    "A card of the grating bus has no live port: its source names no registers, so those of the virtual one are this "
    "project's own, and no real one has them.";

}  // namespace

constinit const CardPlugin grating_bus_plugin = {
    .type = {.name = "grating_bus",
             .doc = "motion card of a grating bus: all such cards of a rack read the same scales at the same instant, "
                    "one as host, the others listening",
             .chip_pins = grating_bus_pins,
             .settings = grating_bus_settings,
             .settings_of = grating_bus_settings_of,
             .flaw = grating_bus_flaw,
             .stage_drive = {.outputs = gb::output_count,
                             .scales = wanted_scales,
                             .period_us = frame_period_us,
                             .processor = stage_processor,
                             .connect_scale = connect_scale}},
    .map = gb::card_map,
    .make = make_grating_bus,
    .no_live_port = no_grating_bus_port,
    .stop_reactions = grating_bus_stops,
    .faults = grating_bus_faults};

constinit const CardPlugin grating_decoder_plugin = {
    .type = {.name = "grating_decoder",
             .doc = "decoder card of the grating bus: counts up to 128 scales and freezes them at HOLD. If a rack "
                    "with grating_bus cards has no decoder card, one named `decoder` is added",
             .chip_pins = grating_decoder_pins,
             .settings = grating_decoder_settings,
             .settings_of = grating_decoder_settings_of,
             .flaw = grating_decoder_flaw,
             .chip_pin_count = grating_decoder_pin_count,
             .decoded_scales = decoded_scales},
    .map = gb::decoder_map,
    .make = make_grating_decoder,
    .no_live_port = no_grating_bus_port,
    .faults = grating_decoder_faults};

gb::Bus* grating_bus_of(Rack& rack) {
    for (const auto& card : rack.cards())
        if (const auto* member = dynamic_cast<const Member*>(card.get())) return member->bus().get();
    return nullptr;
}

gb::Card* grating_card_of(Rack& rack, std::string_view name) {
    auto* card = dynamic_cast<GratingCard*>(rack.card(name));
    return card ? &card->card() : nullptr;
}

}  // namespace motionrack::rack
