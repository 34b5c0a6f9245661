// Generates the lines of an encoder from a position: a disc or scale whose edges have small displacements.
//
//   PositionFunction (fine counts of a rotor, a carriage) ──► edge n at n * den / num, less its displacement
//       ──► LineOutput ──► a b z
//
// One edge is one event: the part watches the position for the next edge on either side. An axis that only needs counts
// connects a position function directly, without cost per edge; this part is for axes whose lines matter.
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/parts/line_output.hpp>
#include <motionrack/sim/position_function.hpp>
#include <string>
#include <string_view>

namespace motionrack::parts {

class EncoderPart : public sim::Device, private sim::PositionListener {
  public:
    sim::WireId a() const { return output_.a(); }
    sim::WireId b() const { return output_.b(); }
    sim::WireId z() const { return output_.z(); }
    /// Count of a perfect encoder and counter, 0 at position 0.
    std::int64_t count() const { return state_.count; }
    sim::DeviceId id() const { return id_; }
    /// Total of counts that were too fast for the electronics.
    std::int64_t lost() const { return output_.lost(); }

    void on_scheduled(Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }
    /// Faults of LineOutput, also with the prefix "encoder.".
    bool fault(std::string_view name, double value, Instant now) override;

  protected:
    /// `turn` counts (a multiple of 4) for `position_per_turn` counts of `position` (both > 0). Adds the device and its
    /// wires, before the start.
    EncoderPart(sim::Kernel& kernel, const std::string& name, sim::PositionFunction& position, std::int64_t turn,
                std::int64_t position_per_turn, const LineOutputSettings& lines);

    /// Displacement of edge n (0 .. turn - 1) towards early, in counts; less than a quarter of a revolution, and smooth
    /// enough to keep the order of edges.
    virtual double displacement(std::int64_t n) const = 0;
    /// True: the encoder is blind, the lines are constant.
    virtual bool blind() const { return false; }
    /// A fault's name without the optional prefix "encoder.".
    static std::string_view bare(std::string_view fault_name);
    /// Call after a change of displacement or blind.
    void look_again(Instant now);
    std::int64_t turn() const { return turn_; }

    LineOutput& output() { return output_; }

    /// State of the derived parts.
    struct State {
        LineOutputState lines;
        std::int64_t count = 0;
        std::int64_t own[4] = {};  ///< state of the derived part
        std::uint32_t begun = 0;
        std::uint32_t was_blind = 0;
    };
    static_assert(std::has_unique_object_representations_v<State>, "padding would get into the state's hash");
    State state_{};
    sim::Kernel& kernel_;

  private:
    void crossed(Instant now) override { update(now); }
    void rate_changed(double, double, Instant) override {}
    void update(Instant now);
    void schedule();
    std::int64_t position_of(std::int64_t n) const;
    std::int64_t count_at(std::int64_t position) const;

    sim::PositionFunction& position_;
    std::int64_t turn_;
    std::int64_t position_per_turn_;
    sim::DeviceId id_{};
    LineOutput output_;
    int slot_ = 0;
};

}  // namespace motionrack::parts
