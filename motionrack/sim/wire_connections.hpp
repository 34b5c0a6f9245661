// Connects wires: the level of one (an output of a part) becomes that of another (an input of a card) at the same
// instant.
//
//   part ──► from ══ WireConnections ══► to ──► card
//            from ◄── subscribe ── to                    a lazily driven wire stays lazy through a connection
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <vector>

namespace motionrack::sim {

/// All connections of a rack in one device. Any number may start at one wire; at most one may end at a wire.
class WireConnections final : public Device {
  public:
    explicit WireConnections(Kernel& kernel, std::string name = "junctions");

    /// Makes `to` follow `from`; `inverted`: 0 becomes 1, every other level 0. Call before Kernel::start, and after a
    /// lazy driver of `from` is registered. A `to` at another level than `from` changes at instant 0.
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
