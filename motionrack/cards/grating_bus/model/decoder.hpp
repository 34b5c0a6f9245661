// The decoder card: counts scales, freezes all of them at an instant, and puts one after the other on the bus.
//
//   scale 0 ──► [ count ] ──hold──► [ latch ]──┐
//   scale 1 ──► [ count ] ──hold──► [ latch ]──┼── addr, read_n ──► data
//
// A scale is a Motion as a whole, or the lines a<n> and b<n> as wires.
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
    /// Adds the card, its wires NAME.a0, NAME.b0 .. and itself to the bus, before the kernel starts. `settings` must
    /// pass check().
    Decoder(sim::Kernel& kernel, const std::string& name, Bus& bus, const DecoderSettings& settings = {});

    /// Scale `n` counts what this one counts; nullptr: the wires a<n> and b<n>.
    void connect(int n, sim::PositionFunction* scale) { scales_[static_cast<std::size_t>(n)] = scale; }
    /// The count of scale `n` (0 .. scales - 1) now, not wrapped.
    std::int64_t position(int n, Instant now) const;
    std::uint32_t count(int n, Instant now) const { return static_cast<std::uint32_t>(position(n, now)); }

    // ---- the host's bus: offsets of the map
    std::uint16_t read(std::uint32_t offset) override;
    void write(std::uint32_t offset, std::uint16_t value) override;
    std::uint16_t peek(std::uint32_t offset) const override;

    const DecoderSettings& settings() const { return settings_; }
    sim::DeviceId id() const { return id_; }
    /// It has no interrupt: always 1.
    sim::WireId interrupt_wire() const { return int_wire_; }

    void on_scheduled(Instant) override {}
    void on_wire(int pin, int level, Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }
    bool fault(std::string_view name, double value, Instant now) override;

  private:
    friend class Bus;
    struct State {
        std::array<std::uint32_t, max_scales> latched{};
        std::uint32_t out = 0;  // what it drives, or drove last
        std::uint32_t no_latch = 0;
        std::uint32_t high = 0;                                          // high word kept by a read of a low one
        std::uint32_t frozen = 0;                                        // a latch is being held
        Instant valid{};                                                 // when the latch became, or becomes, valid
        Instant asked{};                                                 // when read_n fell or addr changed last
        Instant output = never;                                          // when the addressed count comes out
        std::uint32_t hold = 0, read_n = 1, addr = rest_of(Line::addr);  // as it reacted to them last
        std::uint32_t reserved = 0;
        std::uint32_t lines[max_scales] = {};  // bit 0: A, bit 1: B
        std::array<sim::QuadratureDecoder, max_scales> counters;
    };
    static_assert(std::has_unique_object_representations_v<State>, "padding would get into the state's hash");

    bool answers(std::uint32_t addr) const { return addr < static_cast<std::uint32_t>(settings_.scales); }
    /// All scales of a frame at one instant.
    void latch(Instant now);
    /// Follows hold, read_n and addr.
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
