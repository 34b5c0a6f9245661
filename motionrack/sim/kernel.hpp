// The common clock of a rack: runs devices in the order (instant, phase, sequence) and transports wire levels.
//
//   schedule(id, t) ──► due[id] ──► earliest (t, phase, seq) ──► on_scheduled(t) ─► set_wire ─► queue ─► on_wire
//
// After start(), no code reached from run_until allocates, locks or does I/O. External input enters between runs and is
// recorded by the InputLog (input_log.hpp).
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/sim/device.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::sim {

enum class DeviceId : std::uint16_t {};
enum class WireId : std::uint16_t { none = 0xFFFF };

/// A condition of the machine: reported to the user, but not an error of the program.
struct Condition {
    Instant at{};
    DeviceId device{};
    std::uint16_t code = 0;  ///< the device's own code; its module turns it into a sentence
    std::int64_t a = 0;      ///< values for the sentence
    std::int64_t b = 0;
};

/// The device of the kernel's own conditions.
inline constexpr DeviceId no_device{0xFFFF};
/// Condition of the kernel: a loop of wires would change without end at one instant. a: number of a wire in the loop,
/// which keeps its level; b: changes executed before.
inline constexpr std::uint16_t wires_never_settle = 1;

/// Reason for the end of a run.
enum class RunEnd : std::uint8_t {
    reached,  ///< the requested virtual time is reached
    broken    ///< a device called break_run (an interrupt line fell, a buffer is nearly full), or a condition was
              ///< reported
};

/// Additional causes that end a run early.
enum class RunBreak : std::uint8_t {
    none,
    conditions  ///< ends the run after the event that reports a condition
};

/// Complete state of a rack at one instant; restoring copies it back. Valid only for the kernel (wiring) it was taken
/// from.
struct Snapshot {
    std::vector<std::byte> bytes;
};

class Kernel {
  public:
    static constexpr std::size_t condition_capacity = 4096;

    // ---- construction, before start()
    DeviceId add(Device& device, Phase phase, std::string name);
    /// Adds a wire with its level at rest. Names are unique ("motion.xlmtp"). `bits`: recorded bits of the level; 1:
    /// whether it is not 0. `same`: adds a further name to this wire.
    WireId add_wire(std::string name, int level, int bits = 1, WireId same = WireId::none);
    /// Notifies `device` (on_wire with `pin`) of every change while it is subscribed (see subscribe).
    void listen(WireId wire, DeviceId device, int pin);
    /// Takes the level from `device` (level_at with `pin`) while the wire has no subscriber.
    void drive_lazily(WireId wire, DeviceId device, int pin);
    /// Ends the construction and allocates the buffers.
    void start();

    // ---- running
    /// Runs to virtual time `until`, or until a device or `at` breaks the run. Syncs every device before it returns.
    RunEnd run_until(Instant until, RunBreak at = RunBreak::none);
    /// Ends run_until after the present event.
    void break_run() { break_ = true; }
    Instant now() const { return state_.now; }

    // ---- for devices
    /// Schedules `device` (>= now, or never); replaces its previous request.
    void schedule(DeviceId device, Instant at);
    /// Sets a wire's level now; listeners are notified at this instant, first in, first out.
    void set_wire(WireId wire, int level);
    int level(WireId wire) const;
    /// Subscribes a listener to changes or unsubscribes it (initially subscribed, except to lazily driven wires).
    void subscribe(WireId wire, DeviceId device, bool wanted);
    bool wanted(WireId wire) const;
    /// True if drive_lazily was called for the wire.
    bool lazy(WireId wire) const { return wires_[index(wire)].lazy_pin >= 0; }
    void report(DeviceId device, std::uint16_t code, std::int64_t a = 0, std::int64_t b = 0);

    // ---- from outside, between runs
    /// Forces a wire to `level` (a stuck line, a manually operated switch) until release.
    void force(WireId wire, int level);
    void release(WireId wire);
    bool forced(WireId wire) const { return wire_state_[index(wire)].forced != 0; }
    /// Executes the events of this very instant (after a port access or a forced wire).
    void settle();

    WireId find_wire(std::string_view name) const;  ///< WireId::none if unknown
    /// First or further name of a wire; empty beyond the last one.
    const std::string& wire_name(WireId wire, std::size_t further = 0) const;
    int wire_bits(WireId wire) const { return wires_[index(wire)].bits; }
    std::size_t wire_count() const { return wires_.size(); }
    const std::string& device_name(DeviceId device) const { return devices_[index(device)].name; }
    Device& device(DeviceId id) { return *devices_[index(id)].device; }
    std::size_t device_count() const { return devices_.size(); }

    /// Conditions since the start except the first `after`, oldest first; at most condition_capacity are kept,
    /// dropped_conditions() counts the others.
    std::vector<Condition> conditions(std::uint64_t after = 0) const;
    std::uint64_t dropped_conditions() const;
    /// Events executed since the start: the cost of a run.
    std::uint64_t events() const { return state_.events; }

    Snapshot snapshot();
    void restore(const Snapshot& snapshot);
    /// Hash of the state; equal for equal simulations.
    std::uint64_t state_hash();
    /// Hash of the histories of wires and conditions; equal for equal histories.
    std::uint64_t trace_hash() const { return state_.trace_hash; }

    /// An observer of every wire change (a recorder), called in phase observers; may be nullptr.
    class WireObserver {
      public:
        virtual ~WireObserver() = default;
        virtual void wire_changed(WireId wire, int level, Instant now) = 0;
    };
    void observe_wires(WireObserver* observer) { observer_ = observer; }

    template <class Id>
    static constexpr std::size_t index(Id id) {
        return static_cast<std::size_t>(id);
    }

  private:
    struct Slot {
        Device* device = nullptr;
        Phase phase = Phase::cards;
        std::string name;
    };
    struct Listener {
        DeviceId device{};
        std::int16_t pin = 0;
    };
    struct Wire {
        std::string name;
        std::vector<Listener> listeners;
        DeviceId lazy_owner{};
        std::int16_t lazy_pin = -1;
        std::int16_t bits = 1;
        std::vector<std::string> also;
    };
    struct WireState {
        std::int32_t level = 0;
        std::int32_t driven = 0;   // level of its driver while forced
        std::uint32_t wants = 0;   // bit i: listener i is subscribed
        std::uint32_t forced = 0;  // as wide as the others: padding would enter the state's hash
    };
    struct Due {
        Instant at = never;
        std::uint64_t order = 0;  // phase in the top byte, then the sequence number of the request

        bool is_before(const Due& other) const { return at < other.at || (at == other.at && order < other.order); }
    };
    struct Change {
        WireId wire{};
        std::uint16_t reserved = 0;  // padding would enter the state's hash
        std::int32_t level = 0;
    };
    struct State {
        Instant now{};
        std::uint64_t sequence = 0;
        std::uint64_t events = 0;
        std::uint64_t trace_hash = 0x9E3779B97F4A7C15ull;
        std::uint64_t condition_count = 0;
    };

    Device& owner_of(WireId wire) { return *devices_[index(wires_[index(wire)].lazy_owner)].device; }
    void find_earliest();
    void deliver();
    void sync_all();
    void change(WireId wire, int level);
    void mix(std::uint64_t value);
    template <class Visit>
    void each_piece(Visit visit, std::span<std::byte> (Device::*of)());
    std::array<std::span<std::byte>, 2> tail();

    std::vector<Slot> devices_;
    std::vector<DeferringDevice*> deferring_;  // subset of devices_, in the same order
    std::vector<Wire> wires_;
    std::vector<Due> due_;
    std::size_t earliest_ = 0;  // index in due_, while known
    bool knows_earliest_ = false;
    std::vector<WireState> wire_state_;
    std::vector<Change> queue_;  // fixed capacity after start; queue_head_ .. queue_size_
    std::size_t queue_head_ = 0;
    std::size_t queue_size_ = 0;
    std::vector<Condition> conditions_;  // ring
    State state_;
    WireObserver* observer_ = nullptr;
    bool break_ = false;
    bool unsettled_ = false;  // wires_never_settle was reported for the present event
    bool started_ = false;
};

}  // namespace motionrack::sim
