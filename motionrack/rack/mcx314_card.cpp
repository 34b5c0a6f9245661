// The MCX314 in a rack: four channels that follow paths together or move singly.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <motionrack/cards/mcx314/axes/chip_axis_group.hpp>
#include <motionrack/cards/mcx314/axes/single_axis.hpp>
#include <motionrack/cards/mcx314/chip/by_name.hpp>
#include <motionrack/cards/mcx314/chip/byte_bus.hpp>
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/driver/driver.hpp>
#include <motionrack/cards/mcx314/library/library.hpp>
#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <optional>

namespace motionrack::rack {

namespace {

using enum PinDirection;

constexpr std::array<PinType, 23> mcx314_channel_pins = {{
    {"pp", output, "pulse (one-pulse mode), or pulses in the + direction"},
    {"pm", output, "direction (one-pulse mode), or pulses in the - direction"},
    {"eca", input, "encoder A"},
    {"ecb", input, "encoder B"},
    {"in0", input, "stop input 0"},
    {"in1", input, "stop input 1"},
    {"in2", input, "stop input 2"},
    {"in3", input, "stop input 3"},
    {"lmtp", input, "limit in the + direction"},
    {"lmtm", input, "limit in the - direction"},
    {"alarm", input, "alarm of the motor's drive"},
    {"inpos", input, "in position, from the motor's drive"},
    {"expp", input, "external operation +"},
    {"expm", input, "external operation -"},
    {"drive", output, "high while the axis moves; of an mcx314as also the deviation counter clear pulse"},
    {"out0", output, "general output 0"},
    {"out1", output, "general output 1"},
    {"out2", output, "general output 2"},
    {"out3", output, "general output 3"},
    {"out4", output, "general output 4"},
    {"out5", output, "general output 5"},
    {"out6", output, "general output 6"},
    {"out7", output, "general output 7"},
}};

constexpr std::array<PinType, 3> mcx314_chip_pins = {{
    {"emgn", input, "emergency stop of all axes, active low"},
    {"expls_n", input, "external pulse of interpolation, active low"},
    {"int_n", output, "interrupt, active low"},
}};

constexpr std::array<DefaultWire, 8> mcx314_wires = {{
    {"pp", "step"},
    {"pm", "dir"},
    {"eca", "enc_a"},
    {"ecb", "enc_b"},
    {"in2", "enc_z"},
    {"in0", "home"},
    {"lmtp", "limit_plus"},
    {"lmtm", "limit_minus"},
}};

constexpr std::array<std::string_view, 2> mcx314_variants = {"mcx314", "mcx314as"};
constexpr std::array<std::string_view, 2> bus_widths = {"16-bit", "8-bit"};

constexpr std::array<std::string_view, 2> low_speed_drives = {"at V", "at SV"};
constexpr std::array<std::string_view, 2> software_limits = {"beyond", "at"};

constexpr std::array<Field, 8> mcx314_settings = {
    with_choices(field<&Mcx314Settings::variant>("variant", 0, 0, "",
                                                 "the chip: the original, or the one with filters, automatic home "
                                                 "search, synchronous actions and wide ranges"),
                 mcx314_variants),
    with_choices(formerly("slow_drives", field<&Mcx314Settings::low_speed_drive>(
                                             "low_speed_drive", 0, 0, "",
                                             "the speed of a drive with V <= SV; the sources do not agree")),
                 low_speed_drives),
    with_choices(field<&Mcx314Settings::software_limits>(
                     "software_limits", 0, 0, "",
                     "whether + software limits begin beyond COMP+ or at it; the sources do not agree"),
                 software_limits),
    field<&Mcx314Settings::ao_after_reset>("ao_after_reset", 0, 65'535, "pulses",
                                           "initial AO; not stated in the sources"),
    field<&Mcx314Settings::clock_hz>("clock_hz", 16'000'000, 16'000'000, "Hz",
                                     "the chip's clock; the model knows the documented one"),
    with_choices(field<&Mcx314Settings::bus>("bus", 0, 0, "", "width of the host's bus"), bus_widths),
    field<&Mcx314Settings::bus_access_ns>(
        "bus_access_ns", 0, 100'000, "ns",
        "time that one access of the host takes; two of them to a register on 8 bits"),
    field<&Mcx314Settings::host_latency_us>(
        "host_latency_us", 0, 10'000, "us",
        "from an interrupt of the card to the host's first access; path segments are at least this long"),
};

// At most one pulse every four clocks (R = 16,000, V = 8,000: every second tick of the halved clock).
double mcx314_pulse_hz(const RackCard& card) {
    return static_cast<double>(card.mcx314.clock_hz) / 4;
}

// A = 8,000 at multiple 500: 8,000 * 125 * 500 pulses/s2.
double mcx314_accel_hz_s(const RackCard&) {
    return 8000.0 * 125 * 500;
}

// The inputs are sampled at every second clock; shorter states are missed.
double mcx314_encoder_hz(const RackCard& card) {
    return static_cast<double>(card.mcx314.clock_hz) / 2;
}

void* mcx314_of(RackCard& card) {
    return &card.mcx314;
}

constexpr std::array<Lamp, 3> mcx314_lamps = {{{"alarm", "alarm", 0}, {"capture", "in3", 0}, {"compare", "out4"}}};
constexpr std::array<StopPin, 4> mcx314_stop_pins = {{
    {"emgn", StopSource::emergency_stop},
    {"alarm", StopSource::drive_alarm},
    {"lmtp", StopSource::limit_switch, 0, +1},
    {"lmtm", StopSource::limit_switch, 0, -1},
}};
constexpr std::array<std::string_view, 4> mcx314_stops = {"in0", "in1", "in2", "in3"};

class Mcx314Card final : public MotionCard {
  public:
    Mcx314Card(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log)
        : name_(config.name),
          kernel_(kernel),
          narrow_(config.mcx314.bus == BusWidth::bits8),
          byte_access_(nanoseconds(config.mcx314.bus_access_ns)),
          access_(narrow_ ? 2 * byte_access_ : byte_access_),
          chip_(kernel, config.name, options_of(config.mcx314)),
          port_(kernel, registers_on_bus(), chip_.id(), chip_.interrupt_wire(), access_, &log),
          driver_(port_, port_),
          latency_(microseconds(config.mcx314.host_latency_us)) {
        port_.set_latency(latency_);
    }

    const std::string& name() const override { return name_; }
    sim::DeviceId device() const override { return chip_.id(); }
    const CardMap& map() const override { return mcx314::card_map(); }
    sim::RegisterDevice* registers() override { return &chip_; }
    std::span<const int> bus_widths() const override {
        static constexpr int words[] = {16}, bytes[] = {8};
        return narrow_ ? bytes : words;
    }
    std::uint32_t bus_read(int, std::uint32_t address) override {
        if (!narrow_) return port_.read(address);
        port_.pass(byte_access_);
        const std::uint32_t value = byte_bus_.in(static_cast<std::uint8_t>(address));
        kernel_.settle();
        return value;
    }
    void bus_write(int, std::uint32_t address, std::uint32_t value) override {
        if (!narrow_) return port_.write(address, static_cast<std::uint16_t>(value));
        port_.pass(byte_access_);
        byte_bus_.out(static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(value));
        kernel_.settle();
    }
    Result<std::int64_t> inspect(std::string_view name) const override;
    std::vector<std::string> value_names() const override;
    std::vector<CardCounter> counters() const override {
        std::vector<CardCounter> out;
        for (int channel = 0; channel < mcx314::channel_count; ++channel)
            for (const bool encoder : {false, true})
                out.push_back({std::string(1, "xyzu"[channel]) + (encoder ? "ep" : "lp"), channel, encoder});
        return out;
    }
    int channel_number(std::string_view channel) const override {
        return static_cast<int>(std::string_view("xyzu").find(channel));
    }
    sim::PositionFunction& pulses(int channel) override { return chip_.pulses(channel); }
    void connect_encoder(int channel, sim::PositionFunction& counts) override {
        chip_.connect_encoder(channel, counts);
    }
    void take_encoder(int channel, bool taken) override { chip_.take_encoder(channel, taken); }
    sim::VirtualHost& host() override { return port_; }
    sim::VirtualPort* port() override { return &port_; }

    Result<control::AxisGroup*> path_axes(const RackConfig& config,
                                          const std::optional<control::Point>& position) override {
        const CardCounters counters = position ? CardCounters() : read_counters();
        for (auto& one : single_) one.reset();
        axes_.emplace(driver_, axis_map(config), mcx314::HostTimes{access_, latency_});
        axes_->set_probe(probe_channels(config));
        MOTIONRACK_CHECK(axes_->set_up(position.value_or(position_of(config, counters))));
        for (int c = 0; c < mcx314::channel_count && !position; ++c)
            MOTIONRACK_CHECK(driver_.EPS(1u << c, counters.counts[static_cast<std::size_t>(c)]));
        group_valid_ = counters.position_valid;
        if (position) group_valid_.fill(true);
        return &*axes_;
    }

    Result<control::Axis*> axis(const RackConfig& config, char letter) override {
        const RackAxis* found = config.axis(letter);
        MOTIONRACK_ASSERT(found != nullptr && found->card == name_);
        if (axes_ || !singles_ready_) {
            before_singles_ = read_counters();
            axes_.reset();
            MOTIONRACK_CHECK(mcx314::SingleAxis::prepare(driver_));
            MOTIONRACK_CHECK(restore_counters(before_singles_));
            singles_ready_ = true;
        }
        std::unique_ptr<mcx314::SingleAxis>& one = single_[static_cast<std::size_t>(found->index())];
        if (one) return one.get();
        mcx314::SingleAxisSettings settings;
        settings.name = std::string(1, letter);
        settings.unit = found->unit();
        settings.channel = channel_number(found->channel);
        settings.limits = config.limits()[static_cast<std::size_t>(found->index())];
        settings.counts_per_unit = found->counts_per_unit();
        settings.pulses_per_turn = found->pulses_per_rev();
        one = std::make_unique<mcx314::SingleAxis>(driver_, settings);
        MOTIONRACK_CHECK(one->set_up());
        const auto c = static_cast<std::size_t>(settings.channel);
        if (before_singles_.position_valid[c])
            MOTIONRACK_CHECK(one->go_on(before_singles_.pulses[c], before_singles_.counts[c], true));
        return one.get();
    }

    std::span<const FunctionInfo> library_functions() const override { return mcx314::library_functions(); }
    std::unique_ptr<FunctionLibrary> take_library() override {
        axes_.reset();
        for (auto& one : single_) one.reset();
        singles_ready_ = false;
        before_singles_ = {};
        group_valid_.fill(false);
        return std::make_unique<mcx314::Library>(port_, port_);
    }
    double accel_reserve() const override { return mcx314::ChipAxisGroup::accel_reserve; }
    double jump_hz(const RackConfig& config) const override {
        // A ramp changes the rate by one velocity unit at a time, of the long axis or of two axes stepping together.
        return 1.5 * 8e6 / mcx314::Segmenter::best_range(axis_map(config));
    }
    std::int64_t segments() const override { return axes_ ? axes_->segments() : 0; }
    std::int64_t pulses_made(int channel) override { return chip_.pulses_made(channel); }
    std::int64_t pulse_counter(int channel) override { return chip_.lp(channel); }
    std::int64_t encoder_counter(int channel) override { return chip_.ep(channel); }
    std::string describe(const sim::Condition& condition) const override { return mcx314::describe(condition, name_); }

  private:
    static mcx314::ChipOptions options_of(const Mcx314Settings& settings) {
        mcx314::ChipOptions options;
        if (settings.variant == Mcx314Variant::mcx314as) options.variant = mcx314::Variant::mcx314as;
        if (settings.low_speed_drive == Mcx314LowSpeedDrive::at_sv) options.slow_drive = mcx314::SlowDrive::at_sv;
        if (settings.software_limits == Mcx314SoftwareLimits::at) options.software_limit = mcx314::SoftwareLimit::at;
        options.offset_after_reset = static_cast<std::uint16_t>(settings.ao_after_reset);
        return options;
    }
    mcx314::AxisMap axis_map(const RackConfig& config) const {
        mcx314::AxisMap map;
        map.limits = config.limits();
        map.arc_tolerance_mm = config.controller.arc_tolerance_mm;
        for (const RackAxis& axis : config.axes)
            if (axis.card == name_) map.channel[static_cast<std::size_t>(axis.index())] = channel_number(axis.channel);
        return map;
    }

    /// Channels whose IN3 is wired to the rack's probe, one bit each.
    unsigned probe_channels(const RackConfig& config) const {
        unsigned out = 0;
        for (const RackWire& wire : config.wires) {
            if (wire.from.owner != EndOwner::probe || wire.to.owner != EndOwner::card) continue;
            if (config.cards[static_cast<std::size_t>(wire.to.index)].name != name_ || wire.to.pin.size() != 4 ||
                wire.to.pin.substr(1) != "in3")
                continue;
            out |= 1u << channel_number(wire.to.pin.substr(0, 1));
        }
        return out;
    }

    /// Counters of the channels, and whether they are valid positions.
    struct CardCounters {
        std::array<std::int64_t, mcx314::channel_count> pulses = {}, counts = {};
        std::array<bool, mcx314::channel_count> position_valid = {};
    };
    CardCounters read_counters() {
        // Channels not used singly since the group lost the card are still where it left them.
        CardCounters out = before_singles_;
        const auto read = [&](std::size_t c, bool valid) {
            out.pulses[c] = driver_.ReadLPS(static_cast<int>(c));
            out.counts[c] = driver_.ReadEPS(static_cast<int>(c));
            out.position_valid[c] = valid;
        };
        for (std::size_t c = 0; axes_ && c < out.pulses.size(); ++c) read(c, group_valid_[c]);
        for (const auto& one : single_)
            if (one) read(static_cast<std::size_t>(one->channel()), one->position_valid());
        return out;
    }
    /// Restores the counters after the chip's reset, which has cleared those of all channels.
    Result<void> restore_counters(const CardCounters& counters) {
        for (std::size_t c = 0; c < counters.pulses.size(); ++c) {
            if (counters.pulses[c] != 0) MOTIONRACK_CHECK(driver_.LPS(1u << c, counters.pulses[c]));
            if (counters.counts[c] != 0) MOTIONRACK_CHECK(driver_.EPS(1u << c, counters.counts[c]));
        }
        return {};
    }
    control::Point position_of(const RackConfig& config, const CardCounters& counters) const {
        const mcx314::AxisMap map = axis_map(config);
        control::Point out = {};
        for (std::size_t i = 0; i < out.size(); ++i)
            if (map.channel[i] >= 0)
                out[i] = static_cast<double>(counters.pulses[static_cast<std::size_t>(map.channel[i])]) /
                         map.limits[i].pulses_per_unit;
        return out;
    }

    sim::RegisterDevice& registers_on_bus() {
        if (narrow_) return byte_bus_;
        return chip_;
    }

    std::string name_;
    sim::Kernel& kernel_;
    bool narrow_;           // 8-bit bus
    Duration byte_access_;  // duration of one host access
    Duration access_;       // access time of a whole register
    mcx314::Chip chip_;
    mcx314::ByteBus byte_bus_{chip_};
    sim::VirtualPort port_;
    mcx314::Driver driver_;
    Duration latency_;
    std::optional<mcx314::ChipAxisGroup> axes_;
    std::array<std::unique_ptr<mcx314::SingleAxis>, 6> single_ = {};
    bool singles_ready_ = false;
    CardCounters before_singles_;  // state when the group lost the card
    std::array<bool, mcx314::channel_count> group_valid_ = {};
};

Result<std::int64_t> Mcx314Card::inspect(std::string_view name) const {
    return mcx314::value_by_name(chip_, map(), name_, name, in_quotes(name));
}

std::vector<std::string> Mcx314Card::value_names() const {
    std::vector<std::string> out;
    const auto is_register = [this](std::string_view name) {
        return std::any_of(map().registers.begin(), map().registers.end(),
                           [&](const RegisterInfo& reg) { return reg.name == name; });
    };
    for (const char channel : std::string_view("xyzu"))
        for (const std::string_view name : mcx314::Chip::inspected_names(true))
            if (!is_register(name)) out.push_back(fmt::format("{}.{}", channel, name));
    for (const std::string_view name : mcx314::Chip::inspected_names(false))
        if (!is_register(name)) out.emplace_back(name);
    return out;
}

std::unique_ptr<Card> make_mcx314(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                  std::span<const std::unique_ptr<Card>>) {
    return std::make_unique<Mcx314Card>(kernel, config, log);
}

std::unique_ptr<FunctionLibrary> mcx314_library(const CardBus& bus) {
    return std::make_unique<mcx314::Library>(*bus.registers, *bus.host);
}
Result<RegisterView> mcx314_view(const CardBus& bus, bool clearing) {
    return view_mcx314(*bus.registers, clearing);
}

}  // namespace

constinit const CardPlugin mcx314_plugin = {.type = {.name = "mcx314",
                                                     .doc = "four-axis pulse chip with interpolation",
                                                     .channels = "xyzu",
                                                     .channel_pins = mcx314_channel_pins,
                                                     .chip_pins = mcx314_chip_pins,
                                                     .default_wires = mcx314_wires,
                                                     .estop_pin = "emgn",
                                                     .settings = mcx314_settings,
                                                     .settings_of = mcx314_of,
                                                     .max_pulse_hz = mcx314_pulse_hz,
                                                     .max_accel_hz_s = mcx314_accel_hz_s,
                                                     .max_encoder_hz = mcx314_encoder_hz,
                                                     .home_pins = mcx314_stops,
                                                     .index_pins = mcx314_stops,
                                                     .lamps = mcx314_lamps,
                                                     .probe_pin = "in3",
                                                     .stop_pins = mcx314_stop_pins},
                                            .map = mcx314::card_map,
                                            .make = make_mcx314,
                                            .view = mcx314_view,
                                            .library = mcx314_library};

}  // namespace motionrack::rack
