// Builds a path with continuous acceleration for all axes from a program: moves are pushed, cubic segments are pulled.
//
//   programmed  ──────┐       tangent  ▔▔▔▔╲
//                     │       of X          ╲▁▁▁▁
//                     │
//   curve       ──────╮       curvature     ▁▁▁╲  ╱▁▁▁
//                     │       of X         ╲╱
//
//   p'(u) = first tangent + sum of the corner changes, each times the completed share of its blend
//
// Each corner of the programmed path is spread over a blend length about it, with the peak in the middle. Blends
// overlap, which makes dense chords smooth.
//
// u is the length of the programmed path: mm of XYZ, or degrees of the axis with the largest rotation where only ABC
// move. Outside of blends the curve is the programmed path, and XYZ move exactly as fast as u. Inside they are a little
// slower, or faster where a long blend reaches over a short one.
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

/// Cubic segment of a curve; x = u - begin, 0 .. length: p(x) = start + tangent x + curvature x^2/2 + curvature_rate
/// x^3/6, for each axis.
struct CubicSegment {
    double begin = 0;   ///< u, from the start of its curve
    double length = 0;  ///< in u, above 0
    Point start = {};
    Point tangent = {};
    Point curvature = {};
    Point curvature_rate = {};
    std::int32_t line = 0;  ///< line of its move; of merged chords, the first one's
    double feed = 0;  ///< the highest du/dt (1/s) at which the XYZ velocity stays within the programmed feed rate;
                      ///< infinity for rapids
    double jerk_share = 1;  ///< share of the axes' jerk for the motion along it
};

Point position_on(const CubicSegment& piece, double x);
Point tangent_on(const CubicSegment& piece, double x);
Point curvature_on(const CubicSegment& piece, double x);
bool is_straight(const CubicSegment& piece);

/// Output of the builder: a segment of a curve, or the standstill that ends a curve.
struct PathElement {
    bool rest = false;
    CubicSegment piece;              ///< the segment, if not rest
    double seconds = 0;              ///< rest: duration of the dwell; 0 for a stop
    double corner_tolerance_mm = 0;  ///< rest: largest distance of XYZ from the sides of the corner if the next curve
                                     ///< starts before this one ends
    std::int32_t line = 0;           ///< rest: line of the move that ends here, or of the dwell
    Point at = {};                   ///< rest: position of the standstill
};

/// Builds curves from moves. Allocates nothing after construction. The output depends only on the moves and flushes,
/// not on when it is pulled.
///
///     for (const Move& move : program) {
///         while (!builder.has_room() && builder.pull(item)) use(item);
///         builder.push(move);
///     }
///     builder.flush();
///     while (builder.pull(item)) use(item);
///
/// Tolerance of XYZ to the programmed path: the tolerance_mm of the move, but at least half a pulse of the finest axis.
/// On moves with exact_path or exact_stop it is half a pulse. Rotary axes: the angle that moves a point 100 mm from the
/// axis by this tolerance, at least half a pulse.
///
/// The path stops at exact_stop, at dwells, and between moves of XYZ and of ABC only. It stops where exact_path changes
/// direction (see tangent_angle_rad), where the path turns by more than 120 degrees, and where a blend would be too
/// short.
class PathBuilder {
  public:
    PathBuilder(const MachineLimits& limits, const Point& start);

    /// Returns false until enough is pulled, at the latest until pull() returns false.
    bool has_room() const { return segments_.has_room(); }

    /// Adds a move that starts where the last one ended; all its numbers are finite, and feed rates above 0. Requires
    /// has_room(). Skips moves shorter than a thousandth of a pulse and adds their distance to the next one.
    void push(const Move& move);

    /// Ends the path here with a standstill. Requires has_room().
    void flush();

    /// Returns the next element; false if none is final yet.
    bool pull(PathElement& item);

  private:
    bool next_turn();
    void begin_curve(const MergedSegment& segment);
    void add_corner(const MergedSegment& segment);
    void add_line(const MergedSegment& line);
    void begin_arc(const MergedSegment& arc, const MergedSegment& next);
    void add_arc_corner();
    CornerBlend& add_turn(double u, const Point& at, const Point& tangent);
    double junction_step(const MergedSegment& arc, const MergedSegment& neighbour, bool tangent) const;

    bool next_piece(CubicSegment& piece);
    void place_turns();
    void add_event(double u);
    void fill(CubicSegment& piece, double end);
    void end_curve(PathElement& item);

    SegmentMerger segments_;
    CornerBlends turns_;
    bool begun_ = false;                ///< a curve was begun; the members below describe it
    MergedSegment last_;                ///< segment whose corners were added last
    double u_end_ = 0;                  ///< u at the end of last_
    JerkReduction ease_in_, ease_out_;  ///< jerk reduction of the first and the last line of the curve
    double eased_from_ = 0;             ///< u from which ease_out_ applies
    bool in_arc_ = false;               ///< last_ is an arc with further corners
    ArcControlPolygon arc_;
    ArcControlPoint corner_ = {};  ///< next corner of arc_
    double arc_begin_ = 0;

    // output of segments
    static constexpr std::size_t max_events = 512;
    std::array<double, max_events> events_ = {};  ///< ends of segments, ascending
    std::size_t first_event_ = 0, past_event_ = 0;
    std::int64_t placed_ = 0;  ///< number of blends whose knots are in events_
    std::int64_t alive_ = 0;   ///< number of the first blend that ends behind the cursor
    std::int64_t edge_ = 0;    ///< number of the last corner before the cursor
    double cursor_ = 0;
};

}  // namespace motionrack::control
