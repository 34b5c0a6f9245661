// A grating scale with reading head and interpolator on a position function: counts, and lines A and B for listeners.
//
//   position ──► (position - zero) * interpolation / pitch ──► dirt ──► direction
//       ──► rate limit of the electronics ────┬─► counts (PositionFunction)
//                                             └─► a, b, z: wires, generated while subscribed
//
//   count  ...  0   1   2   3   4  ...     counting up: A leads B        pitch    |<------- pitch ------->|
//   A      ...  _/~~~~~~~\_______/~~       A high in phases 1 and 2      grating  ▐███████░░░░░░░▐███████░░
//   B      ...  _____/~~~~~~~\_____        B high in phases 2 and 3      counts   | | | | | | | | | | | |
//   Z      ...  ~~~\________ ...           one count wide, at index      interpolation = 12
//
// The count is a closed form of the position, exact in 128 bits; edges cost no time. Above the maximum rate counting
// stops: the missed counts are lost, counted and reported, and the scale is invalid until it is referenced.
//
// Faults: scale.lose n (n counts are lost at once), scale.dirt x (x nm from dirt_at on are not counted), scale.swapped
// (the lines are swapped while not 0: it counts backwards), scale.expansion x (the grating is x ppm longer; it expands
// about the present position of the head).
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/sim/edge_batcher.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/listeners.hpp>
#include <motionrack/sim/parts/conditions.hpp>
#include <motionrack/sim/parts/linear_stage.hpp>
#include <motionrack/sim/parts/range.hpp>
#include <motionrack/sim/position_function.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::parts {

struct LinearScaleSettings {
    std::int64_t pitch_pm = 20'000'000;   ///< 1000 .. 1e9 (1 nm to 1 mm): the grating's period, picometres
    std::int64_t interpolation = 4'096;   ///< 4 .. 65536, a multiple of 4: counts per pitch
    bool reversed = false;                ///< counts down while the position increases
    double zero_offset_nm = 0;            ///< position of count 0, within 10 m
    double max_count_rate = 20e6;         ///< counts/s, 1 .. 1e9: maximum rate that is counted
    std::optional<double> index_nm;       ///< position of the reference mark: Z is high for its count
    double dirt_position_nm = 0;          ///< start of the dirt of the fault
    std::int64_t places = places_per_nm;  ///< 1 .. 1e9: this number of position counts ...
    std::int64_t places_nm = 1;           ///< ... corresponds to this number of nm, 1 .. 1e9
};

/// Minimum time between two edges of the lines of a scale; each line has every second one.
Duration edge_spacing(const LinearScaleSettings& settings);

class LinearScale final : public sim::DeferringDevice, public sim::PositionFunction, private sim::PositionListener {
  public:
    /// Adds the device `name` and its wires NAME.a, NAME.b, NAME.z (lazily driven) to the kernel before it starts.
    LinearScale(sim::Kernel& kernel, const std::string& name, sim::PositionFunction& position,
                const LinearScaleSettings& settings = {});

    // ---- the counts
    std::int64_t count(Instant t) const override { return counted(position_.count(t)); }
    double rate(Instant t) const override;
    void watch(int slot, std::int64_t below, std::int64_t above) override;
    int add_listener(sim::PositionListener& listener) override;
    void watch_rate(double rate) override { position_.watch_rate(rate / counts_per_place()); }
    void set_edge_listener(sim::EdgeListener* listener) override;
    void deliver_edges() override { flush(); }

    double nm_per_count() const {
        return static_cast<double>(settings_.pitch_pm) / (1e3 * static_cast<double>(settings_.interpolation));
    }
    /// Position by the counts, nm from zero.
    double position_nm(Instant t) const {
        return static_cast<double>(count(t) * (settings_.reversed ? -1 : 1)) * nm_per_count();
    }
    /// False if counts were lost since the start or the last reference().
    bool counts_valid() const { return state_.counts_invalid == 0; }
    /// Marks the scale as referenced: earlier losses no longer matter.
    void reference() { state_.counts_invalid = 0; }
    /// Total of lost counts.
    std::int64_t lost() const { return state_.lost; }
    bool too_fast() const { return state_.too_fast != 0; }

    sim::WireId a() const { return wires_[0]; }
    sim::WireId b() const { return wires_[1]; }
    sim::WireId z() const { return wires_[2]; }
    sim::DeviceId id() const { return id_; }
    const LinearScaleSettings& settings() const { return settings_; }

    void on_scheduled(Instant now) override;
    int level_at(int pin, Instant now) const override;
    void wanted_changed(int pin, bool wanted, Instant now) override;
    void sync(Instant) override { flush(); }
    std::span<std::byte> state() override { return sim::bytes_of(state_); }
    bool fault(std::string_view name, double value, Instant now) override;

  private:
    struct State {
        Wide num = 1;  ///< counts of the grating per count of the position, in lowest terms
        Wide den = 1;
        std::int64_t zero = 0;    ///< position at which the grating's count is 0
        std::int64_t shift = 0;   ///< count - count of the grating
        std::int64_t frozen = 0;  ///< the count while the rate is too high
        std::int64_t lost = 0;
        std::int64_t dirt = 0;   ///< invisible counts
        std::int64_t shown = 0;  ///< count shown by the lines
        Instant free_at{};       ///< earliest instant of the next edge of the lines
        sim::Listeners::Watches watches{};
        std::int32_t direction = 1;
        std::int32_t swapped = 0;
        std::int32_t too_fast = 0;
        std::int32_t counts_invalid = 0;
        std::int32_t wanted = 0;  ///< bit i: wire i
        std::int32_t reserved = 0;
    };

    void crossed(Instant now) override { update(now); }
    void rate_changed(double before, double rate, Instant now) override;

    double counts_per_place() const { return static_cast<double>(state_.num) / static_cast<double>(state_.den); }
    std::int64_t grating(std::int64_t position) const;
    std::int64_t visible(std::int64_t grating) const;
    std::int64_t counted(std::int64_t position) const;
    bool index(std::int64_t position) const;
    Range place_range(const Range& counts) const;
    bool live() const { return state_.wanted != 0 || edges_ != nullptr; }
    void set_ratio(double ppm);
    void report(AxisCondition code, std::int64_t a, std::int64_t b);
    void update(Instant now);
    void aim(Instant now);
    void show(Instant now);
    void put_out(Instant now);
    void flush();

    sim::Kernel& kernel_;
    sim::PositionFunction& position_;
    LinearScaleSettings settings_;
    std::int64_t dirt_at_ = 0;  // count of the grating
    std::int64_t index_at_ = 0;
    Duration spacing_{};  // between two edges of the lines
    sim::DeviceId id_{};
    std::array<sim::WireId, 3> wires_{};
    int slot_ = 0;
    State state_{};
    sim::Listeners listeners_;
    sim::EdgeListener* edges_ = nullptr;
    sim::EdgeBatcher row_;
    bool looking_ = false;
};

}  // namespace motionrack::parts
