// A decoder card: counts scales, freezes all counts at an instant, and outputs them one by one on the bus.
//
//   scale 0 ──► [ count ] ──hold──► [ latch ]──┐
//   scale 1 ──► [ count ] ──hold──► [ latch ]──┼── addr, read_n ──► data
//
// A scale is a connected sim::PositionFunction, or the wires a<n> and b<n>.
#pragma once

#include <array>
#include <motionrack/cards/grating_bus/map.hpp>
#include <motionrack/cards/grating_bus/model/lines.hpp>
#include <motionrack/cards/grating_bus/model/settings.hpp>
#include <motionrack/sim/blocks/quadrature_counter.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/register_device.hpp>
#include <string>

namespace motionrack::grating_bus {

class Bus;

class Decoder final : public sim::Device, public sim::RegisterDevice {
  public:
    /// Adds the card and its wires NAME.a0, NAME.b0 .. to the kernel, and plugs it into the bus; before the kernel
    /// starts. `settings` must pass check().
    Decoder(sim::Kernel& kernel, const std::string& name, Bus& bus, const DecoderSettings& settings = {});

    /// Connects scale `n` to this source; nullptr: to the wires a<n> and b<n>.
    void connect(int n, sim::PositionFunction* scale) { scales_[static_cast<std::size_t>(n)] = scale; }
    /// Returns the present count of scale `n` (0 .. scales - 1), not limited to 32 bits.
    std::int64_t position(int n, Instant now) const;
    std::uint32_t count(int n, Instant now) const { return static_cast<std::uint32_t>(position(n, now)); }

    // ---- the host's bus: offsets of the map
    std::uint16_t read(std::uint32_t offset) override;
    void write(std::uint32_t offset, std::uint16_t value) override;
    std::uint16_t peek(std::uint32_t offset) const override;

    const DecoderSettings& settings() const { return settings_; }
    sim::DeviceId id() const { return id_; }
    /// Returns a wire that is always 1: the decoder has no interrupt.
    sim::WireId interrupt_wire() const { return int_wire_; }

    void on_scheduled(Instant) override {}
    void on_wire(int pin, int level, Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }
    bool fault(std::string_view name, double value, Instant now) override;

  private:
    friend class Bus;
    struct State {
        std::array<std::uint32_t, max_scales> latched{};
        std::uint32_t out = 0;  // present or last output
        std::uint32_t no_latch = 0;
        std::uint32_t high = 0;    // high word latched by a read of a low word
        std::uint32_t frozen = 0;  // a latch is held
        Instant valid{};           // instant at which the latch became, or becomes, valid
        Instant asked{};           // instant of the last fall of read_n or change of addr
        Instant output = never;    // instant at which the addressed count is output
        std::uint32_t hold = 0, read_n = 1, addr = rest_of(Line::addr);  // levels at the last reaction
        std::uint32_t reserved = 0;
        std::uint32_t lines[max_scales] = {};  // bit 0: A, bit 1: B
        std::array<sim::QuadratureDecoder, max_scales> counters;
    };
    static_assert(std::has_unique_object_representations_v<State>, "padding would get into the state's hash");

    bool answers(std::uint32_t addr) const { return addr < static_cast<std::uint32_t>(settings_.scales); }
    /// Latches the counts of all scales for a frame, at one instant.
    void latch(Instant now);
    /// Reacts to hold, read_n and addr.
    void follow(Lines& lines, int driver, Instant now);
    void ask(Instant now);
    bool is_count(std::uint32_t at) const {
        return at >= counts_at && at < counts_at + 4u * static_cast<std::uint32_t>(settings_.scales) && at % 2 == 0;
    }

    sim::Kernel& kernel_;
    DecoderSettings settings_;
    Bus& bus_;
    sim::DeviceId id_{};
    sim::WireId int_wire_{};
    std::array<sim::PositionFunction*, max_scales> scales_{};
    State state_{};
};

}  // namespace motionrack::grating_bus
