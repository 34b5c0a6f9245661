// Joins wires: the level of one (an output of a part) is that of another (an input of a card), at the same instant.
//
//   part ──► from ══ WireConnections ══► to ──► card
//            from ◄── want ─────── to                    a lazily driven wire stays lazy through a junction
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <vector>

namespace motionrack::sim {

/// All junctions of a rack in one device. Any number may start at one wire; at most one may end at a wire.
class WireConnections final : public Device {
  public:
    explicit WireConnections(Kernel& kernel, std::string name = "junctions");

    /// From now on `to` follows `from`; `inverted`: 0 becomes 1, all else 0. Before Kernel::start, and after `from`'s
    /// owner has said whether it drives it lazily. A `to` at another level than `from` changes at instant 0.
    void join(WireId from, WireId to, bool inverted = false);

    void on_scheduled(Instant now) override;
    void on_wire(int pin, int level, Instant now) override;
    int level_at(int pin, Instant now) const override;
    void wanted_changed(int pin, bool wanted, Instant now) override;

  private:
    struct Connection {
        WireId from{};
        WireId to{};
        bool inverted = false;
        bool lazy = false;
        int level(int of) const { return inverted ? of == 0 : of; }
    };

    Kernel& kernel_;
    DeviceId id_;
    std::vector<Connection> joints_;
};

}  // namespace motionrack::sim
