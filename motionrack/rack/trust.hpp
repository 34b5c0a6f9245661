// Whether the positions of a rack's axes still mean places of the machine: one rule for programs that are run and for
// machines that people operate.
//
//   a motor lost steps, was pushed or held ──────────────────────► lost, until the axis is homed or declared
//   an axis that positions by itself does not know where it is ──► lost
//   a card's encoder counter is off from what the motor turned ──► told; the pulses that drive the axis are right
//   a following error above its warning limit ───────────────────► told; above its alarm limit the stop latch says it
//   a stage's card opened its loop ──────────────────────────────► told
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

/// What is wrong with the position of an axis, or with a stage.
struct TrustFinding {
    static constexpr std::size_t no_axis = ~std::size_t{0};
    std::size_t axis = 0;  ///< of Rack::axes(); no_axis: a stage, whose loop was opened
    Instant at{};
    std::string text;            ///< without a full stop
    bool lost = false;           ///< the position is not to be trusted
    bool follows_badly = false;  ///< a following error above its warning limit
};

class TrustWatch {
  public:
    /// Of a rack since its start; encoders count right here and now.
    explicit TrustWatch(Rack& rack);
    /// What an axis has lost so far.
    struct Mark {
        Instant at{};  ///< what came before does not matter
        std::int64_t lost_pulses = 0;
    };
    Mark mark(std::size_t axis) const { return {rack_.kernel().now(), lost_pulses(axis)}; }
    /// An axis was where it says at `from`: it was homed, or declared. What it has lost since is found in the next
    /// look.
    void begin(std::size_t axis, const Mark& from);
    /// What was found since the last look, each once until begin(). `standing`: nothing moves, so counters and rotors
    /// can be compared and axes asked.
    std::vector<TrustFinding> look(bool standing);
    /// At standstill: false where an axis that positions by itself has lost its position; others are told where they
    /// are.
    bool knows_itself(std::size_t axis);

  private:
    struct Watched {
        Mark from{Instant{-1}};
        std::int64_t counted_wrongly = 0;  ///< when it began
        bool counted = false;              ///< its card counts its encoder beside the pulses
        bool lost = false, told_counts = false;
    };
    bool is_counted(std::size_t axis) const;
    std::int64_t lost_pulses(std::size_t axis) const;
    std::int64_t counted_wrongly(std::size_t axis) const;
    void lose(std::size_t axis, Instant at, std::string text, std::vector<TrustFinding>& out);
    void look_at_conditions(std::vector<TrustFinding>& out);
    void look_at(const sim::Condition& condition, std::vector<TrustFinding>& out);
    void look_for_lost(std::size_t axis, const sim::Condition& condition, std::vector<TrustFinding>& out);
    void compare(std::size_t axis, std::vector<TrustFinding>& out);

    Rack& rack_;
    std::vector<Watched> watched_;
    std::uint64_t seen_ = 0;           ///< conditions
    std::vector<TrustFinding> early_;  ///< for the next look
};

}  // namespace motionrack::rack
