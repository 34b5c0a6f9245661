// What lives in virtual time: cards, parts and observers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/base/time.hpp>
#include <span>
#include <string_view>
#include <type_traits>

namespace motionrack::sim {

/// The order of things that happen at one instant.
enum class Phase : std::uint8_t { wires, cards, parts, observers };

/// A device acts at the instants it asked for (Kernel::schedule), and is told of wires it listens to. Everything
/// reached from act, on_wire and level_at runs in virtual time: no allocation, no locks, no I/O, no text.
class Device {
  public:
    virtual ~Device() = default;
    /// Called when the scheduled instant has come.
    virtual void on_scheduled(Instant now) = 0;
    /// A wire this device listens to has a new level. `pin` is the number given to Kernel::listen.
    virtual void on_wire(int pin, int level, Instant now) { (void)pin, (void)level, (void)now; }
    /// The level of a wire that this device drives lazily (Kernel::drive_lazily), at `now`.
    virtual int level_at(int pin, Instant now) const { return (void)pin, (void)now, 0; }
    /// Someone began or ceased to want the changes of a lazily driven wire; schedule accordingly.
    virtual void wanted_changed(int pin, bool wanted, Instant now) { (void)pin, (void)wanted, (void)now; }
    /// A lazily driven wire is held at `level` from outside (Kernel::force), or no longer.
    virtual void forced_changed(int pin, bool forced, int level, Instant now) {
        (void)pin, (void)forced, (void)level, (void)now;
    }
    /// Everything that a snapshot must hold, as bytes of trivially copyable state.
    virtual std::span<std::byte> state() { return {}; }
    /// The part of it that Kernel::state_hash reads: all, unless it is large and a state that is read has a hash of it.
    virtual std::span<std::byte> hashed_state() { return state(); }
    /// Injects a fault by name; false if this device has no such fault. `value` is the fault's parameter, 0 clears it.
    virtual bool fault(std::string_view name, double value, Instant now) {
        return (void)name, (void)value, (void)now, false;
    }
};

/// A device that puts off what its listeners need not have at once. The kernel calls sync at the end of each run.
class DeferringDevice : public Device {
  public:
    /// Hands over whatever has been put off (edges to listeners) up to and including `now`, in virtual time.
    virtual void sync(Instant now) = 0;
};

/// The bytes of a trivially copyable state, for Device::state.
template <class T>
std::span<std::byte> bytes_of(T& state) {
    static_assert(std::is_trivially_copyable_v<T>, "a device's state is copied as bytes");
    return {reinterpret_cast<std::byte*>(&state), sizeof(T)};
}

}  // namespace motionrack::sim
