// The index line of the encoder of one axis as a wire, computed only while it has subscribers.
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/parts/encoder.hpp>
#include <string>

namespace motionrack::parts {

class IndexLine {
  public:
    /// Adds the wire NAME.enc_z, driven lazily by `axis`, if there is an encoder. `range`: rotor range of the constant
    /// line, while subscribed; it, `wanted` and `level` are parts of the axis' state.
    IndexLine(sim::Kernel& kernel, sim::DeviceId axis, const std::string& name, const Encoder& encoder, Range& range,
              std::int32_t& wanted, std::int32_t& level)
        : kernel_(kernel), encoder_(encoder), range_(range), wanted_(wanted), level_(level) {
        if (!encoder.present()) return;
        wire_ = kernel.add_wire(name + ".enc_z", encoder.index(0));
        kernel.drive_lazily(wire_, axis, 0);
    }

    /// WireId::none without an encoder.
    sim::WireId wire() const { return wire_; }

    void subscribe(bool wanted, std::int64_t rotor) {
        wanted_ = wanted;
        level_ = encoder_.index(rotor);
        range_ = wanted ? encoder_.index_range(rotor) : Range{};
    }
    /// Shows the line if it has subscribers and its range is left.
    void check(std::int64_t rotor) {
        if (!wanted_ || !range_.left(rotor)) return;
        // The index may be passed within one microstep: the wire shows it nevertheless.
        const int level = encoder_.index(rotor);
        if (level_ == level) kernel_.set_wire(wire_, 1 - level);
        kernel_.set_wire(wire_, level);
        level_ = level;
        range_ = encoder_.index_range(rotor);
    }
    /// Calls `add` with the rotor range within which the line does not change, while it has subscribers.
    template <class Add>
    void add_range(Add add) const {
        if (wanted_) add(range_);
    }

  private:
    sim::Kernel& kernel_;
    const Encoder& encoder_;
    Range& range_;
    std::int32_t& wanted_;
    std::int32_t& level_;
    sim::WireId wire_ = sim::WireId::none;
};

}  // namespace motionrack::parts
