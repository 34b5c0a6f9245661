// What is wrong with an encoder, which line, and where: from the card's counts of edges, index pulses and illegal
// transitions.
//
//   index    |        |        |     |          |          a grid of counts_per_index
//                              ^ extra          ^ counts lost: one or more lines are dirty between the two
//
// Looks must come often enough that an axis makes less than 65,536 edges between two of them; an index pulse is placed
// best when there is not more than one between two looks. Places are raw counts (AxisDetail::position_of makes
// positions of them).
#pragma once

#include <cstdint>
#include <motionrack/cards/ioflex02/driver/flex2pos.hpp>
#include <string>
#include <vector>

namespace motionrack::ioflex02 {

enum class EncoderFault : std::uint8_t {
    illegal,         ///< A and B changed at once `number` times, the last time at `to`
    line_a_missing,  ///< A stood still while B changed `number` times, between `from` and `to`
    line_b_missing,  ///< B stood still while A changed
    index_missing,   ///< `number` index pulses did not come between `from` and `to`
    index_extra,     ///< an index pulse at `to` that is not one of the grid
    counts_lost,     ///< from one index pulse to the next there are `number` counts too few
    counts_extra,    ///< `number` counts too many
    backwards,       ///< it counted against the move: A and B are swapped, or one of them is inverted
    too_many_edges   ///< `number` edges more than the counts of the move need: noise
};

struct Finding {
    EncoderFault fault{};
    std::int64_t number = 0;
    std::int64_t from = 0;  ///< places, raw counts
    std::int64_t to = 0;
};

/// A sentence; places are told as positions of `now`. `axis`: its name.
std::string describe(const Finding& finding, const AxisDetail& now, const std::string& axis);

struct EncoderCheckSettings {
    std::int64_t counts_per_index =
        0;                       ///< counts from one index pulse to the next, >= 0; 0: the index is not looked at
    std::int64_t tolerance = 1;  ///< counts, >= 0, that an index pulse may be off its grid
    int edges_alone =
        64;  ///< > 0: edges of one line while the other stands still, or more than a move needs, until that is a fault
};

class EncoderCheck {
  public:
    explicit EncoderCheck(const EncoderCheckSettings& settings = {}) : settings_(settings) {}

    /// What has come to light since the look before; the first look only begins.
    std::vector<Finding> look(const AxisDetail& now);
    /// After a move in one direction of about `counts` counts (signed, more than 8) from `before` to `now`: did it
    /// count that way, with hardly more edges than it needs?
    std::vector<Finding> check_move(const AxisDetail& before, const AxisDetail& now, std::int64_t counts) const;

  private:
    void look_at_lines(const AxisDetail& now, std::vector<Finding>& out);
    void look_at_index(const AxisDetail& now, std::vector<Finding>& out);
    void index_came(std::int64_t at, std::vector<Finding>& out);
    std::int64_t off_grid(std::int64_t from, std::int64_t to) const;
    void tell_spacing(std::int64_t from, std::int64_t to, std::vector<Finding>& out);

    EncoderCheckSettings settings_;
    bool begun_ = false;
    AxisDetail last_;
    // lines
    std::int64_t a_alone_ = 0, b_alone_ = 0;  // edges of one line since the last one of the other
    std::int64_t alone_from_ = 0;
    bool told_alone_ = false;
    // index
    bool index_known_ = false, doubtful_known_ = false;
    std::int64_t index_ = 0;     // place of the last good one, or of one that should have been
    std::int64_t doubtful_ = 0;  // an index off the grid: extra, or counts were lost before it
};

}  // namespace motionrack::ioflex02
