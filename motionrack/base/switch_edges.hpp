// Are the edges that a search for home has found those of one sound switch? A contact that breaks or sticks for a while
// makes edges where there are none. Ways are counted towards the switch, in the unit of whoever searches.
//
//   away ────┼────────── hysteresis ──────────┼──── towards ──► way
//         released                          acted
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace motionrack {

/// mm or degrees: the contacts of a sound switch act at the same place to that.
inline constexpr double contacts_repeat = 0.02;

/// An edge that a sound switch would not have.
struct EdgeConflict {
    bool with_release = false;  ///< with the place where it was released; else where it had acted before
    bool beyond = false;        ///< farther towards the switch than that, else before it
    double apart = 0;           ///< at least
    double limit = 0;           ///< what a sound switch explains

    /// "it acted .. beyond the place where it was released, ..", ways as `text_of` writes them.
    template <typename TextOf>
    std::string text(TextOf text_of) const {
        return said(text_of(apart), text_of(limit));
    }

  private:
    std::string said(std::string_view way, std::string_view most) const;
};

class SwitchEdges {
  public:
    /// A search begins. Without the hysteresis nothing is compared.
    void begin(std::optional<double> hysteresis, double repeats);
    /// On the way away: at `way`, or up to `within` before on that way.
    void released(double way, double within);
    /// On the way towards it, likewise; compared with what was seen before in this search.
    std::optional<EdgeConflict> acted(double way, double within);

  private:
    struct Span {
        double low = 0, high = 0;
    };
    std::optional<EdgeConflict> conflict(const Span& edge, const Span& other, double slack) const;

    std::optional<double> hysteresis_;
    double repeats_ = 0;
    std::optional<Span> acted_;
    std::optional<Span> released_;  ///< contacts that bounce for long are released several times, ever farther away
};

}  // namespace motionrack
