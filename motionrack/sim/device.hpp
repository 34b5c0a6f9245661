// Devices in virtual time: cards, parts and observers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/base/time.hpp>
#include <span>
#include <string_view>
#include <type_traits>

namespace motionrack::sim {

/// Order of events at one instant.
enum class Phase : std::uint8_t { wires, cards, parts, observers };

/// A device acts at the instants it scheduled (Kernel::schedule) and is notified of wires it listens to. Everything
/// reached from on_scheduled, on_wire and level_at runs in virtual time: no allocation, no locks, no I/O, no text.
class Device {
  public:
    virtual ~Device() = default;
    /// Called at the scheduled instant.
    virtual void on_scheduled(Instant now) = 0;
    /// A wire with this device as listener has a new level. `pin`: number given to Kernel::add_listener.
    virtual void on_wire(int pin, int level, Instant now) { (void)pin, (void)level, (void)now; }
    /// Level of a lazily driven wire (Kernel::drive_lazily) at `now`.
    virtual int level_at(int pin, Instant now) const { return (void)pin, (void)now, 0; }
    /// A lazily driven wire has gained its first or lost its last subscriber; schedule accordingly.
    virtual void wanted_changed(int pin, bool wanted, Instant now) { (void)pin, (void)wanted, (void)now; }
    /// A lazily driven wire is forced to `level` from outside (Kernel::force), or released.
    virtual void forced_changed(int pin, bool forced, int level, Instant now) {
        (void)pin, (void)forced, (void)level, (void)now;
    }
    /// The complete state for a snapshot, as bytes of trivially copyable state.
    virtual std::span<std::byte> state() { return {}; }
    /// The part that Kernel::state_hash reads: all, unless it is large and another state contains its hash.
    virtual std::span<std::byte> hashed_state() { return state(); }
    /// Injects a fault by name; returns false if the fault is unknown. `value`: parameter of the fault, 0 clears it.
    virtual bool fault(std::string_view name, double value, Instant now) {
        return (void)name, (void)value, (void)now, false;
    }
};

/// A device that defers work that its listeners do not need at once. The kernel calls sync at the end of each run.
class DeferringDevice : public Device {
  public:
    /// Delivers all deferred work (edges to listeners) up to and including `now`, in virtual time.
    virtual void sync(Instant now) = 0;
};

/// The bytes of a trivially copyable state, for Device::state.
template <class T>
std::span<std::byte> bytes_of(T& state) {
    static_assert(std::is_trivially_copyable_v<T>, "a device's state is copied as bytes");
    return {reinterpret_cast<std::byte*>(&state), sizeof(T)};
}

}  // namespace motionrack::sim
