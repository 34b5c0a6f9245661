#include <fmt/format.h>

#include "bench.hpp"

namespace howto {

Result<void> contour(mcx314::Driver& card) {
    const unsigned axes = axis_x | axis_y;
    MOTIONRACK_CHECK(card.SetMultiple(axes, 10));
    MOTIONRACK_CHECK(card.SetVectorSpeed(2));  // as fast along the arcs as along the lines
    mcx314::CONTDATA speeds;
    speeds.SV = 10, speeds.V = 100, speeds.A = 10;
    MOTIONRACK_CHECK(card.ContStart(speeds));
    MOTIONRACK_CHECK(card.ContLine(axes, {4500, 0}));
    MOTIONRACK_CHECK(card.ContArc(axes, {1500, 1500}, {0, 1500}, false));
    MOTIONRACK_CHECK(card.ContLine(axes, {0, 1500}));
    MOTIONRACK_CHECK(card.ContArc(axes, {-1500, 1500}, {-1500, 0}, false));
    MOTIONRACK_CHECK(card.ContLine(axes, {-4500, 0}));
    MOTIONRACK_CHECK(card.ContArc(axes, {-1500, -1500}, {0, -1500}, false));
    MOTIONRACK_CHECK(card.ContLine(axes, {0, -1500}));
    MOTIONRACK_CHECK(card.ContArc(axes, {1500, -1500}, {1500, 0}, false));
    MOTIONRACK_TRY(const mcx314::ContOutcome end, card.ContEnd(whole_seconds(60)));
    fmt::print("{} segments, X {}, Y {}\n", end.segments, card.ReadLPS(0), card.ReadLPS(1));
    return {};
}

}  // namespace howto
