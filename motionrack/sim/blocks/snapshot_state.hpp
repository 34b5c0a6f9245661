// State beside that of a device: more bytes of a snapshot, under a name of their own.
#pragma once

#include <motionrack/sim/device.hpp>

namespace motionrack::sim {

/// Does nothing but hold `bytes`, which must live as long and not move.
class SnapshotState final : public Device {
  public:
    void on_scheduled(Instant) override {}
    std::span<std::byte> state() override { return bytes; }
    std::span<std::byte> hashed_state() override { return hashed ? bytes : std::span<std::byte>{}; }
    std::span<std::byte> bytes;
    bool hashed = true;  ///< false: another state has a hash of them
};

}  // namespace motionrack::sim
