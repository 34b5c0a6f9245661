// The one stop latch of a rack: whatever must stop the machine sets it, in every state, and only a reset releases it.
//
//   emergency stop, drive alarms, limit switches, watchdogs,       STOP order
//   following errors                                                    │ between runs
//        │ edge, in the kernel, at its tick                             │
//        └──────────────────────────────► trip ◄────────────────────────┘
//                                          ├──► halted(): hosts wait for nothing more, no motion begins
//                                          └──► break_run ──► look(): the reactions, see stop_reactions.hpp
//
//   released ── trip ──► latched ── reset(), no cause is there any more ──► released       (a reset moves nothing)
//
// An axis that its card stops by itself at such an input (a limit switch in its way, the emergency stop) is left to the
// card while it does: then halted() comes when whoever drives has seen it stand, and calls settle().
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/control/limits.hpp>
#include <motionrack/rack/following.hpp>
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
    /// Of a rack that has all its wires, before it starts.
    explicit StopLatch(Rack& rack);

    /// Between runs: somebody drives the machine from now on. An emergency stop or alarm that is there already sets it.
    void arm();
    /// Nobody does: edges are not heard, and it is released.
    void disarm();
    bool armed() const { return state_.armed != 0; }
    /// A search for home goes to limit switches on purpose.
    void heed_limits(bool on) { state_.heeds_limits = on; }

    /// Between runs: the STOP order.
    void order();
    /// An axis, a number in Rack::axes(), stays behind what drives it by more than its limit: in the kernel, at its
    /// tick. Where a stop is in force already its position is lost all the same.
    void stays_behind(std::size_t axis, Instant now);
    /// What sees that.
    FollowingWatch& following() { return following_; }
    /// The contacts for people.
    SafetyContacts& contacts() { return contacts_; }
    /// Whoever drives holds the feed while the door is open; else an open door is a stop order.
    void heed_door(bool on) { state_.heeds_door = on; }
    /// Between runs, in every slice of whoever drives: carries the reactions out.
    void look();
    /// Between runs: whoever drives has seen all axes stand.
    void settle();
    /// Between runs: releases it. Refused while the emergency stop or an alarm is there; nothing is changed then.
    Result<void> reset();

    bool latched() const { return state_.latched != 0; }
    /// That stop requests come from it: see VirtualHost::set_halted_flag.
    const std::atomic<bool>& halted() const { return halted_; }
    /// Somebody asked for the stop, and nothing else did.
    bool is_ordered() const { return cause() == StopSource::stop_order && state_.by_door == 0; }
    /// What set it first, and when; while it is latched.
    StopSource cause() const { return static_cast<StopSource>(state_.cause); }
    Instant at() const { return state_.at; }
    /// Whether whoever drives this axis is to brake it: it is latched, and the card does not stop it by itself.
    bool is_to_brake(char letter) const { return latched() && !is_stopped_by_card(letter); }
    /// How often something has asked for a stop since the rack was made: a reset releases what was there when it was
    /// ordered.
    std::uint64_t trips() const { return state_.trips; }
    /// Whether this source has set it, first or later.
    bool tripped_by(StopSource source) const { return (state_.tripped & bit(source)) != 0; }
    /// False where steps may have been lost (the motor was faster than it can stop without a ramp and was to, or its
    /// pulses ended without one, or its drive failed while it moved), where the axis did not follow, or where its card
    /// was reset. Of pulses that end it is known once all axes were seen to stand. `axis`: 0 .. 5.
    bool keeps_position(int axis) const { return (state_.lost & 1u << axis) == 0 && !ramps_.has_jumped(axis); }

    /// "The emergency stop was pressed at 1.200 s."
    std::string sentence() const;
    /// "The position of X is not trusted any more: steps may have been lost; home again.", by each reason that there
    /// is, or that they are kept.
    std::string position_sentence() const;
    /// "Release it, then reset."
    std::string_view advice() const;

    void on_scheduled(Instant) override {}
    void on_wire(int pin, int level, Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    /// A wire that is watched, the watchdog of a card, or an axis that may stay behind.
    struct Input {
        sim::WireId wire = sim::WireId::none;  ///< none: a watchdog, or an axis
        StopSource source{};
        int active = 0;  ///< the level; of a watchdog the code of its condition
        int direction = 0;
        int card = -1;  ///< number in the rack; -1: the rack's own button
        int axis = -1;  ///< number in Rack::axes(); -1: of no axis
    };
    struct State {
        Instant at{};
        std::uint64_t heard = 0;  ///< conditions of the kernel that were looked at
        std::uint64_t trips = 0;
        std::array<Instant, 2 * control::axis_count> left{};  ///< when an axis' - and + limit switch was left last
        std::int32_t armed = 0, heeds_limits = 1, latched = 0, cause = 0;
        std::int32_t input = -1;  ///< that set it; -1: an order
        std::int32_t behind = 0;  ///< a limit switch behind an axis that moved: its direction
        std::int32_t heeds_door = 1, by_door = 0;
        std::uint32_t tripped = 0, pending = 0;  ///< bits: sources
        std::uint32_t lost = 0, unfollowed = 0;  ///< bits: axes; of these, those with a following error
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

}  // namespace motionrack::rack
