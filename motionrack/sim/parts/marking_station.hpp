// The machine around a laser card: mirrors, lens, laser, and a part that moves; blocks of the card's output become
// marks on the part.
//
//   x, y ──► galvo ──► lens ──► field mm ──► track ──► part mm ──┐
//   gate ──► laser ──────────────────────────────────► J ────────┴──► workpiece
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/sim/parts/galvo.hpp>
#include <motionrack/sim/parts/laser_gate.hpp>
#include <motionrack/sim/parts/track.hpp>
#include <motionrack/sim/parts/workpiece.hpp>
#include <optional>
#include <span>

namespace motionrack::parts {

struct StationSettings {
    GalvoSettings galvo;
    std::optional<sim::ScanLens> lens;  ///< none: bits_per_mm, without distortion
    double bits_per_mm = 8656;          ///< without a lens, 1 .. 1e6
    LaserSettings laser;
    TrackSettings track;
    WorkpieceSettings workpiece;
};

class MarkingStation {
  public:
    /// Refused as its parts refuse.
    static Result<MarkingStation> make(const StationSettings& settings);

    /// The card's gate changes; before the block that has its tick.
    void laser(std::int64_t half_us, bool on) { gate_.change(half_us, on); }
    /// The card's output of consecutive ticks, in order.
    void block(std::int64_t first_tick, std::span<const std::int32_t> x, std::span<const std::int32_t> y);

    /// Where the spot is in the field, mm, for mirrors at these bits.
    sim::Spot spot(sim::Spot bits) const;
    Track& track() { return track_; }
    const GalvoPair& galvo() const { return galvo_; }
    Workpiece& workpiece() { return workpiece_; }

  private:
    MarkingStation(const StationSettings& settings, Track track, LaserGate gate)
        : settings_(settings),
          galvo_(settings.galvo),
          track_(std::move(track)),
          gate_(std::move(gate)),
          workpiece_(settings.workpiece) {}
    void mark(std::int64_t tick, sim::Spot from, sim::Spot to);

    static constexpr std::size_t chunk = 512;
    StationSettings settings_;
    GalvoPair galvo_;
    Track track_;
    LaserGate gate_;
    Workpiece workpiece_;
    std::array<double, chunk> x_{}, y_{};
    sim::Spot last_;  // of the mirrors, bits
};

}  // namespace motionrack::parts
