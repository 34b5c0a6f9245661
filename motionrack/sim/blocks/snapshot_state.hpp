// Additional state of a device: more bytes of a snapshot, under a separate name.
#pragma once

#include <motionrack/sim/device.hpp>

namespace motionrack::sim {

/// Only refers to `bytes`, which must outlive the object and must not move.
class SnapshotState final : public Device {
  public:
    void on_scheduled(Instant) override {}
    std::span<std::byte> state() override { return bytes; }
    std::span<std::byte> hashed_state() override { return hashed ? bytes : std::span<std::byte>{}; }
    std::span<std::byte> bytes;
    bool hashed = true;  ///< false: another state contains a hash of the bytes
};

}  // namespace motionrack::sim
