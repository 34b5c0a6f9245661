// A program's path as a curve that all axes can follow without a jump of acceleration: moves go in, cubic pieces come
// out.
//
//   programmed  ──────┐       tangent  ▔▔▔▔╲
//                     │       of X          ╲▁▁▁▁
//                     │
//   curve       ──────╮       curvature     ▁▁▁╲  ╱▁▁▁
//                     │       of X         ╲╱
//
//   p'(u) = first tangent + sum of the turns, each times how much of its spread is done
//
// Each turn of the programmed path is spread over a width about its corner, steepest in its middle. Widths overlap:
// that is what makes dense chords smooth.
//
// u is the length of the programmed path: mm of XYZ, or degrees of the axis that turns most where only ABC move. Where
// no turn is spread the curve is the programmed path and XYZ run as fast as u does; elsewhere a little slower, or,
// where a wide turn reaches over a narrow one, faster.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/move.hpp>
#include <motionrack/control/path/arc_control_polygon.hpp>
#include <motionrack/control/path/corner_blends.hpp>
#include <motionrack/control/path/segment_merger.hpp>

namespace motionrack::control {

/// A cubic piece of a curve; x = u - begin, 0 .. length: p(x) = start + tangent x + curvature x^2/2 + curvature_rate
/// x^3/6, axis by axis.
struct CubicSegment {
    double begin = 0;   ///< u, from the beginning of its curve
    double length = 0;  ///< of u, above 0
    Point start = {};
    Point tangent = {};
    Point curvature = {};
    Point curvature_rate = {};
    std::int32_t line = 0;  ///< of the move on which the piece lies; of merged chords, the first one's
    double feed = 0;  ///< greatest du/dt, 1/s, at which XYZ nowhere on it exceed the programmed feed; infinity: as fast
                      ///< as the axes can
    double jerk_share = 1;  ///< of the axes' jerk, which the motion along it takes
};

Point position_on(const CubicSegment& piece, double x);
Point tangent_on(const CubicSegment& piece, double x);
Point bend_on(const CubicSegment& piece, double x);
bool is_straight(const CubicSegment& piece);

/// What comes out: a piece of a curve, or the rest that ends a curve.
struct PathElement {
    bool rest = false;
    CubicSegment piece;              ///< if not rest
    double seconds = 0;              ///< rest: the dwell; 0 for a stop
    double corner_tolerance_mm = 0;  ///< rest: how far XYZ may be here from the corner's sides, if the next curve
                                     ///< begins a little before this one ends
    std::int32_t line = 0;           ///< rest: of the move that ends here, or of the dwell
    Point at = {};                   ///< rest: where
};

/// Makes curves of moves. Allocates nothing after it is made. What comes out depends on the moves and flushes only, not
/// on when it is pulled.
///
///     for (const Move& move : program) {
///         while (!builder.has_room() && builder.pull(item)) use(item);
///         builder.push(move);
///     }
///     builder.flush();
///     while (builder.pull(item)) use(item);
///
/// How far XYZ may be from the programmed path: a move's tolerance_mm, at least half a pulse of the finest axis; half a
/// pulse on moves with exact_path or exact_stop. Rotary axes: as many degrees as turn a point 100 mm from the axis by
/// this tolerance, at least half a pulse.
///
/// Rests: at exact_stop, at dwells, between moves of XYZ and of ABC alone, where exact_path does not meet its next move
/// in the same direction (see tangent_angle_rad), where the path turns by more than 120 degrees, and where a turn would
/// have no width to speak of.
class PathBuilder {
  public:
    PathBuilder(const MachineLimits& limits, const Point& start);

    /// False until enough is pulled: at the latest when pull() gives nothing more.
    bool has_room() const { return spans_.has_room(); }

    /// Adds a move that begins where the last one ended; all its numbers are finite, and feeds above 0. Needs
    /// has_room(). A move that is shorter than a thousandth of a pulse is left out, and what it moved is added to what
    /// follows.
    void push(const Move& move);

    /// The path ends here at rest, for now. Needs has_room().
    void flush();

    /// The next item; false if none can be told yet.
    bool pull(PathElement& item);

  private:
    bool next_turn();
    void begin_curve(const MergedSegment& span);
    void add_corner(const MergedSegment& span);
    void add_line(const MergedSegment& line);
    void begin_arc(const MergedSegment& arc, const MergedSegment& next);
    void add_arc_corner();
    CornerBlend& add_turn(double u, const Point& at, const Point& tangent);
    double joint_step(const MergedSegment& arc, const MergedSegment& neighbour, bool tangent) const;

    bool next_piece(CubicSegment& piece);
    void place_turns();
    void add_event(double u);
    void fill(CubicSegment& piece, double end);
    void end_curve(PathElement& item);

    SegmentMerger spans_;
    CornerBlends turns_;
    bool begun_ = false;                ///< there is a curve, of which this is known:
    MergedSegment last_;                ///< the span whose turns were made last
    double u_end_ = 0;                  ///< where it ends
    JerkReduction ease_in_, ease_out_;  ///< of its first and of its last line
    double eased_from_ = 0;             ///< where this one begins
    bool in_arc_ = false;               ///< of the last span there are more turns
    ArcControlPolygon arc_;
    ArcControlPoint corner_ = {};  ///< the next of arc_
    double arc_begin_ = 0;

    // pieces
    static constexpr std::size_t max_events = 512;
    std::array<double, max_events> events_ = {};  ///< where pieces end, rising
    std::size_t first_event_ = 0, past_event_ = 0;
    std::int64_t placed_ = 0;  ///< turns whose knots are in events_
    std::int64_t alive_ = 0;   ///< first turn whose width reaches beyond the cursor
    std::int64_t edge_ = 0;    ///< the turn after which the cursor is
    double cursor_ = 0;
};

}  // namespace motionrack::control
