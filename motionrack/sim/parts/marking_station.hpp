// The machine around a laser card: mirrors, lens, laser, and a moving part. It converts blocks of the card's output to
// marks on the part.
//
//   x, y ──► galvo ──► lens ──► field mm ──► conveyor ► part mm ─┐
//   gate ──► laser ──────────────────────────────────► J ────────┴──► workpiece
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/sim/parts/conveyor.hpp>
#include <motionrack/sim/parts/galvo_pair.hpp>
#include <motionrack/sim/parts/laser_gate.hpp>
#include <motionrack/sim/parts/workpiece.hpp>
#include <optional>
#include <span>

namespace motionrack::parts {

struct StationSettings {
    GalvoSettings galvo;
    std::optional<sim::ScanLens> lens;  ///< absent: bits_per_mm, without distortion
    double bits_per_mm = 8656;          ///< without a lens, 1 .. 1e6
    LaserSettings laser;
    ConveyorSettings track;
    WorkpieceSettings workpiece;
};

class MarkingStation {
  public:
    /// Errors: refused, as by its parts. `track`: replaces the conveyor of the settings; must outlive the station.
    static Result<MarkingStation> make(const StationSettings& settings, const Conveyor* track = nullptr);

    /// Records a change of the card's gate; call before the block that contains its tick.
    void laser(std::int64_t half_us, bool on) { gate_.change(half_us, on); }
    /// Processes the card's output of consecutive ticks, in order.
    void block(std::int64_t first_tick, std::span<const std::int32_t> x, std::span<const std::int32_t> y);

    /// Position of the spot in the field, mm, for mirrors at these bits.
    sim::Spot spot(sim::Spot bits) const;
    /// Position of the spot in the field, mm, at the present mirror positions.
    sim::Spot spot() const { return spot(last_); }
    /// True if the laser is dark and no light is pending.
    bool dark(std::int64_t tick) const { return gate_.dark(tick); }
    const Conveyor& track() const { return outer_ != nullptr ? *outer_ : track_; }
    const GalvoPair& galvo() const { return galvo_; }
    const LaserGate& gate() const { return gate_; }
    Workpiece& workpiece() { return workpiece_; }
    const Workpiece& workpiece() const { return workpiece_; }

    /// State for the snapshot of a device; valid until the station is moved.
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
    sim::Spot last_;  // mirrors, bits
};

}  // namespace motionrack::parts
