// Checks that the edges found by a homing search are those of one sound switch. A contact that breaks or sticks
// temporarily causes false edges. Distances count towards the switch, in the unit of the caller.
//
//   away ────┼────────── hysteresis ──────────┼──── towards ──► way
//         released                          acted
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace motionrack {

/// mm or degrees: repeatability of the contacts of a sound switch.
inline constexpr double contacts_repeat = 0.02;

/// An edge that a sound switch would not cause.
struct EdgeConflict {
    bool with_release = false;  ///< relative to the release position; otherwise to the previous activation
    bool beyond = false;        ///< further towards the switch; otherwise before it
    double apart = 0;           ///< distance between the two edges, in the units of the caller (lower bound)
    double limit = 0;           ///< maximum distance for a sound switch, in the same units

    /// "it became active .. beyond the position at which it was released ..", with distances formatted by `text_of`.
    template <typename TextOf>
    std::string text(TextOf text_of) const {
        return text_with(text_of(apart), text_of(limit));
    }

  private:
    std::string text_with(std::string_view distance, std::string_view max_distance) const;
};

class SwitchEdges {
  public:
    /// Begins a search. Without the hysteresis edges are not compared.
    void begin(std::optional<double> hysteresis, double repeats);
    /// Records a release on the way away: at `distance`, or up to `within` before.
    void released(double distance, double within);
    /// Records an activation on the way towards the switch, likewise; compares it with earlier edges of this search.
    std::optional<EdgeConflict> acted(double distance, double within);

  private:
    struct Span {
        double low = 0, high = 0;
    };
    std::optional<EdgeConflict> conflict(const Span& edge, const Span& other, double slack) const;

    std::optional<double> hysteresis_;
    double repeats_ = 0;
    std::optional<Span> acted_;
    std::optional<Span> released_;  ///< contacts that bounce long are released several times, each time further away
};

}  // namespace motionrack
