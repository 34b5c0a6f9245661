// The stop latch of a rack: every cause of a stop sets it, in every state, and only a reset releases it.
//
//   emergency stop, drive alarms, limit switches, watchdogs,       STOP command
//   following errors                                                    │ between runs
//        │ edge, in the kernel, at its tick                             │
//        └──────────────────────────────► trip ◄────────────────────────┘
//                                          ├──► halted(): hosts stop waiting, no motion starts
//                                          └──► break_run ──► poll(): the reactions, see stop_reactions.hpp
//
//   released ── trip ──► latched ── reset(), no cause left ──► released       (a reset moves nothing)
//
// A card may stop an axis itself at such an input (a limit switch in its direction, the emergency stop). The axis is
// left to the card meanwhile, and halted() follows when the driver has seen standstill and calls settle().
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/control/limits.hpp>
#include <motionrack/rack/following_watch.hpp>
#include <motionrack/rack/ramp_watch.hpp>
#include <motionrack/rack/safety_contacts.hpp>
#include <motionrack/rack/stop_source.hpp>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

class Rack;
struct RunningAxis;

class StopLatch final : public sim::Device {
  public:
    /// Call when the rack has all its wires, before it starts.
    explicit StopLatch(Rack& rack);

    /// Arms the latch when a driver takes over the machine. An active emergency stop or alarm sets it immediately. Call
    /// between runs.
    void arm();
    /// Disarms the latch: ignores edges and releases it. Call when the machine has no driver.
    void disarm();
    bool armed() const { return state_.armed != 0; }
    /// Sets whether an axis (index in Rack::axes()) searches for home, and so may run into its own limit switches.
    /// Those of all other axes still set the latch.
    void search(std::size_t axis, bool on);

    /// Sets the latch for a STOP command. Call between runs.
    void stop();
    /// Sets the latch for an axis (index in Rack::axes()) above its following-error limit; called in the kernel, at
    /// that tick. Its position becomes invalid even if a stop is already in force.
    void stays_behind(std::size_t axis, Instant now);
    /// Following-error supervision.
    FollowingWatch& following() { return following_; }
    /// Operator safety contacts.
    SafetyContacts& contacts() { return contacts_; }
    /// Sets the reaction to an open door. true (default): the latch is set as for a STOP command; false: the driver
    /// holds the feed instead.
    void heed_door(bool on) { state_.heeds_door = on; }
    /// Executes the reactions. Call between runs, in every slice of the driver.
    void poll();
    /// Call between runs when the driver has seen all axes at standstill.
    /// `failed`: a motion has failed. Then the axes may have been stopped without a stop in force, because a switch
    /// that was active before the motion began does not set the latch.
    void settle(bool failed = false);
    /// Releases the latch. Call between runs. Refused, without any change, while the emergency stop or an alarm is
    /// active.
    Result<void> reset();

    bool latched() const { return state_.latched != 0; }
    /// Flag that makes the latch a source of stop requests: see VirtualHost::set_halted_flag.
    const std::atomic<bool>& halted() const { return halted_; }
    /// Returns true if stop commands were the only cause.
    bool is_ordered() const { return cause() == StopSource::stop_command && state_.by_door == 0; }
    /// First cause, and its instant; valid while latched. A stop command is replaced by the first other cause.
    StopSource cause() const { return static_cast<StopSource>(state_.cause); }
    Instant at() const { return state_.at; }
    /// Returns true if the driver of this axis must decelerate it: the latch is set, and the card does not stop the
    /// axis by itself.
    bool is_to_brake(char letter) const { return latched() && !is_stopped_by_card(letter); }
    /// Number of stop requests since the rack was created. A reset releases only the stops requested before it was
    /// commanded.
    std::uint64_t trips() const { return state_.trips; }
    /// Returns true if this source has requested a stop since the latch was last released, whether or not it was the
    /// first cause.
    bool tripped_by(StopSource source) const { return (state_.tripped & bit(source)) != 0; }
    /// Returns false if step loss is possible, if the axis did not follow, or if its card was reset. Step loss is
    /// possible after a stop without a ramp at a velocity above the start-stop rate, or if the drive failed in motion.
    /// For pulses that end, the result is final when all axes have been seen at standstill. `axis`: 0 .. 5.
    bool keeps_position(int axis) const { return (state_.lost & 1u << axis) == 0 && !ramps_.has_jumped(axis); }

    /// Returns "The emergency stop was pressed at 1.200 s."
    std::string sentence() const;
    /// Returns a sentence on the invalid positions for each reason, or that the positions are kept.
    std::string position_sentence() const;
    /// Returns "Release it, then reset."
    std::string_view advice() const;

    void on_scheduled(Instant) override {}
    void on_wire(int pin, int level, Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    /// A monitored wire, the watchdog of a card, or an axis with following-error supervision.
    struct Input {
        sim::WireId wire = sim::WireId::none;  ///< none: a watchdog or an axis
        StopSource source{};
        int active = 0;  ///< active level; for a watchdog its condition code
        int direction = 0;
        int card = -1;  ///< index in the rack; -1: the rack's own button
        int axis = -1;  ///< index in Rack::axes(); -1: no axis
    };
    struct State {
        Instant at{};
        std::uint64_t evaluated = 0;  ///< kernel conditions already evaluated
        std::uint64_t trips = 0;
        std::array<Instant, 2 * control::axis_count> left{};  ///< when each - and + limit switch was last left
        std::int32_t armed = 0, latched = 0, cause = 0;
        std::uint32_t searching = 0;  ///< bits: axes that are being homed
        std::int32_t input = -1;      ///< input that set the latch; -1: a command
        std::int32_t behind = 0;      ///< direction of a limit switch opposite to the motion of its axis
        std::int32_t heeds_door = 1, by_door = 0;
        std::uint32_t tripped = 0, pending = 0;  ///< bits: sources
        std::uint32_t lost = 0, unfollowed = 0;  ///< bits: axes; `unfollowed`: those with a following error
    };
    static constexpr std::uint32_t bit(StopSource source) { return 1u << static_cast<unsigned>(source); }

    void look_at_watchdogs();
    bool is_active(const Input& input) const;
    Instant& left_at(const Input& input);
    bool trips(const Input& input, Instant now);
    bool left_to_card(const Input& input, Instant now) const;
    bool is_stopped_by_card(char letter) const;
    bool is_behind(const Input& input, Instant now) const;
    bool is_on_card(const RunningAxis& axis, const Input& input) const;
    void trip(StopSource source, int input, Instant now);
    void note_lost(StopSource source, const Input* input, Instant now);
    std::string input_text() const;

    Rack& rack_;
    sim::Kernel& kernel_;
    sim::DeviceId id_{};
    FollowingWatch following_;
    RampWatch ramps_;
    SafetyContacts contacts_;
    std::vector<Input> inputs_;
    bool has_watchdogs_ = false;
    State state_{};
    std::atomic<bool> halted_{false};
};

/// Errors: refused while the latch is set: "`what`: The emergency stop was pressed at 1.200 s. Nothing was moved. ..."
Result<void> check_released(const StopLatch& latch, std::string_view what);

}  // namespace motionrack::rack
