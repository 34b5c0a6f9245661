// The machine around a laser card: mirrors, lens, laser, and a part that moves; blocks of the card's output become
// marks on the part.
//
//   x, y ──► galvo ──► lens ──► field mm ──► track ──► part mm ──┐
//   gate ──► laser ──────────────────────────────────► J ────────┴──► workpiece
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/sim/parts/conveyor.hpp>
#include <motionrack/sim/parts/galvo.hpp>
#include <motionrack/sim/parts/laser_gate.hpp>
#include <motionrack/sim/parts/workpiece.hpp>
#include <optional>
#include <span>

namespace motionrack::parts {

struct StationSettings {
    GalvoSettings galvo;
    std::optional<sim::ScanLens> lens;  ///< none: bits_per_mm, without distortion
    double bits_per_mm = 8656;          ///< without a lens, 1 .. 1e6
    LaserSettings laser;
    ConveyorSettings track;
    WorkpieceSettings workpiece;
};

class MarkingStation {
  public:
    /// Refused as its parts refuse. `track`: in place of that of the settings; must live as long.
    static Result<MarkingStation> make(const StationSettings& settings, const Conveyor* track = nullptr);

    /// The card's gate changes; before the block that has its tick.
    void laser(std::int64_t half_us, bool on) { gate_.change(half_us, on); }
    /// The card's output of consecutive ticks, in order.
    void block(std::int64_t first_tick, std::span<const std::int32_t> x, std::span<const std::int32_t> y);

    /// Where the spot is in the field, mm, for mirrors at these bits.
    sim::Spot spot(sim::Spot bits) const;
    /// The same for the mirrors as they are.
    sim::Spot spot() const { return spot(last_); }
    /// The laser has no light now and none to come.
    bool dark(std::int64_t tick) const { return gate_.dark(tick); }
    const Conveyor& track() const { return outer_ != nullptr ? *outer_ : track_; }
    const GalvoPair& galvo() const { return galvo_; }
    const LaserGate& gate() const { return gate_; }
    Workpiece& workpiece() { return workpiece_; }
    const Workpiece& workpiece() const { return workpiece_; }

    /// Its state, for a device that a snapshot asks; valid until it is moved.
    struct NamedState {
        const char* name;
        std::span<std::byte> bytes;
    };
    static constexpr std::size_t state_count = 4;
    std::array<NamedState, state_count> states();

  private:
    MarkingStation(const StationSettings& settings, Conveyor track, const Conveyor* outer, const LaserGate& gate)
        : settings_(settings),
          galvo_(settings.galvo),
          track_(std::move(track)),
          outer_(outer),
          gate_(gate),
          workpiece_(settings.workpiece) {}
    void mark(std::int64_t tick, sim::Spot from, sim::Spot to);

    static constexpr std::size_t chunk = 512;
    StationSettings settings_;
    GalvoPair galvo_;
    Conveyor track_;
    const Conveyor* outer_ = nullptr;
    LaserGate gate_;
    Workpiece workpiece_;
    std::array<double, chunk> x_{}, y_{};
    sim::Spot last_;  // of the mirrors, bits
};

}  // namespace motionrack::parts
