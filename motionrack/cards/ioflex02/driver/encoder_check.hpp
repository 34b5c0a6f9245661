// Diagnosis of encoder faults, with line and position, from the card's counts of edges, index pulses and illegal
// transitions.
//
//   index    |        |        |     |          |          a grid of counts_per_index
//                              ^ extra          ^ counts lost: one or more lines are dirty between the two
//
// Requires polls at intervals in which an axis makes less than 65,536 edges. An index pulse is located best with at
// most one pulse between two polls. Positions are raw counts (AxisDetail::position_of converts them).
#pragma once

#include <cstdint>
#include <motionrack/cards/ioflex02/driver/flex2pos.hpp>
#include <string>
#include <vector>

namespace motionrack::ioflex02 {

enum class EncoderFault : std::uint8_t {
    illegal,         ///< A and B changed simultaneously `number` times, last at `to`
    line_a_missing,  ///< A was constant while B changed `number` times, between `from` and `to`
    line_b_missing,  ///< B was constant while A changed
    index_missing,   ///< `number` index pulses were missing between `from` and `to`
    index_extra,     ///< an index pulse at `to` outside the grid
    counts_lost,     ///< `number` counts too few from one index pulse to the next
    counts_extra,    ///< `number` counts too many
    backwards,       ///< counted against the move: A and B are swapped, or one of them is inverted
    too_many_edges   ///< `number` edges more than the move's counts need: noise
};

struct Finding {
    EncoderFault fault{};
    std::int64_t number = 0;
    std::int64_t from = 0;  ///< positions, raw counts
    std::int64_t to = 0;
};

/// Message of a finding; positions are given as axis positions of `now`. `axis`: its name.
std::string describe(const Finding& finding, const AxisDetail& now, const std::string& axis);

struct EncoderCheckSettings {
    std::int64_t counts_per_index = 0;  ///< counts from one index pulse to the next, >= 0; 0: the index is ignored
    std::int64_t tolerance = 1;         ///< counts, >= 0: maximum distance of an index pulse from its grid
    int edges_alone =
        64;  ///< > 0: fault threshold for edges of one line while the other is constant, or beyond the need of a move
};

class EncoderCheck {
  public:
    explicit EncoderCheck(const EncoderCheckSettings& settings = {}) : settings_(settings) {}

    /// Returns the findings since the last poll; the first poll only initialises.
    std::vector<Finding> update(const AxisDetail& now);
    /// Checks a move in one direction of about `counts` counts (signed, more than 8) from `before` to `now`: the
    /// direction of counting, and the number of surplus edges.
    std::vector<Finding> check_move(const AxisDetail& before, const AxisDetail& now, std::int64_t counts) const;

  private:
    void look_at_lines(const AxisDetail& now, std::vector<Finding>& out);
    void look_at_index(const AxisDetail& now, std::vector<Finding>& out);
    void index_came(std::int64_t at, std::vector<Finding>& out);
    std::int64_t off_grid(std::int64_t from, std::int64_t to) const;
    void report_spacing(std::int64_t from, std::int64_t to, std::vector<Finding>& out);

    EncoderCheckSettings settings_;
    bool begun_ = false;
    AxisDetail last_;
    // lines
    std::int64_t a_alone_ = 0, b_alone_ = 0;  // edges of one line since the last edge of the other
    std::int64_t alone_from_ = 0;
    bool reported_alone_ = false;
    // index
    bool index_known_ = false, doubtful_known_ = false;
    std::int64_t index_ = 0;     // position of the last good or expected index pulse
    std::int64_t doubtful_ = 0;  // an index off the grid: extra, or preceded by lost counts
};

}  // namespace motionrack::ioflex02
