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
#include <motionrack/rack/mcx314_card.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <optional>

namespace motionrack::rack {

namespace {

class Mcx314Card final : public MotionCard {
  public:
    Mcx314Card(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log)
        : name_(config.name),
          kernel_(kernel),
          narrow_(mcx314_in(config).bus == BusWidth::bits8),
          byte_access_(nanoseconds(mcx314_in(config).bus_access_ns)),
          access_(narrow_ ? 2 * byte_access_ : byte_access_),
          chip_(kernel, config.name, options_of(mcx314_in(config))),
          port_(kernel, registers_on_bus(), chip_.id(), chip_.interrupt_wire(), access_, &log),
          driver_(port_, port_),
          latency_(microseconds(mcx314_in(config).host_latency_us)) {
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

}  // namespace

std::unique_ptr<Card> make_mcx314(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                  std::span<const std::unique_ptr<Card>>) {
    return std::make_unique<Mcx314Card>(kernel, config, log);
}

}  // namespace motionrack::rack
