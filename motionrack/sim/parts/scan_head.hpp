// A scan head on the wires of a laser card, with its marks.
//
//   CARD.xout, yout ──► mirrors ──► lens ──┐
//   CARD.laser_on ────► laser ─────────────┴──► the part on its conveyor: MarkingStation, tick by tick of 10 us
//
// Ticks are processed when a line changes and at the end of a run. While the lines are constant and the laser is dark,
// the head is idle: the mirrors are then at their commanded positions.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/sim/blocks/snapshot_state.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/parts/marking_station.hpp>
#include <string>

namespace motionrack::parts {

/// Wires of the card.
struct ScanHeadWires {
    sim::WireId x, y, laser;
};

class ScanHead final : public sim::DeferringDevice {
  public:
    /// Adds the device `name` to the kernel before it starts and after the wires' owner.
    ScanHead(sim::Kernel& kernel, const std::string& name, const ScanHeadWires& wires, MarkingStation station);

    /// Call after the start.
    void begin();
    /// Mirrors, laser and part at the end of the last run.
    const MarkingStation& station() const { return station_; }
    /// Copies the marked points; a snapshot contains only their number.
    void copy_points(const ScanHead& other) { station_.workpiece().copy_points(other.station_.workpiece()); }
    bool gate() const { return state_.gate != 0; }
    sim::DeviceId id() const { return id_; }

    void on_scheduled(Instant) override {}
    void on_wire(int pin, int level, Instant now) override;
    void sync(Instant now) override { work_off(now); }
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    struct State {
        std::array<std::int64_t, 2> bits{};  ///< x, y
        std::int64_t next = 0;               ///< next tick to be processed
        std::int64_t changed = 0;            ///< tick of the last change of a line
        std::int64_t gate = 0;
    };
    void work_off(Instant now);

    sim::Kernel& kernel_;
    ScanHeadWires wires_;
    MarkingStation station_;
    sim::DeviceId id_{};
    State state_{};
    std::array<sim::SnapshotState, MarkingStation::state_count> held_;
    std::array<std::int32_t, 256> x_{}, y_{};
};

}  // namespace motionrack::parts
