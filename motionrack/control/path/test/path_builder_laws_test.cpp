// Laws of the curve, for random programs: it is smooth, stays near the path and is never faster than u.
// MOTIONRACK_SEED=N picks the first program, MOTIONRACK_PROGRAMS=N how many there are.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <motionrack/control/path/test/path_builder_support.hpp>
#include <tests/environment.hpp>
#include <tests/goes_on.hpp>

namespace motionrack::control {
namespace {

using namespace curve_test;

double max_component(const Point& a) {
    double max = 0;
    for (const double x : a) max = std::max(max, std::fabs(x));
    return max;
}

double difference(const Point& a, const Point& b) {
    double max = 0;
    for (int i = 0; i < axis_count; ++i) max = std::max(max, std::fabs(a[i] - b[i]));
    return max;
}

struct Case {
    std::uint64_t seed;
    std::vector<Move> moves;
    std::vector<PathElement> items;
};

/// Checks `everyday` random programs, or the number that the environment sets. If that is fewer, continues up to
/// `everyday` until `shown` returns true: the law was tested.
template <class Shown, class Check>
void for_programs(std::uint64_t everyday, Shown shown, Check check) {
    const std::uint64_t first = seed_from_environment(), count = cases("MOTIONRACK_PROGRAMS", everyday);
    for (std::uint64_t seed = first; goes_on(seed - first, count, everyday, shown()); ++seed) {
        SCOPED_TRACE("MOTIONRACK_SEED=" + std::to_string(seed));
        ProgramMaker maker(seed);
        Case one = {seed, maker.program(1 + maker.one_of(12)), {}};
        one.items = curve_of(one.moves);
        check(one);
        if (::testing::Test::HasFailure()) return;
    }
}

template <class Check>
void for_random_programs(Check check) {
    const auto shown = [] { return true; };
    for_programs(1000, shown, check);
}

/// At least one program must use more than this share of its tolerance; otherwise the law was not tested.
constexpr double used_share = 0.5;

TEST(PathLaws, PositionTangentAndCurvatureAreContinuousAtJunctions) {
    for_random_programs([](const Case& one) {
        const CubicSegment* last = nullptr;
        for (const PathElement& item : one.items) {
            if (!item.rest && last) {
                const CubicSegment& piece = item.piece;
                const double x = last->length;
                const double bends = max_component(curvature_on(piece, piece.length)) + max_component(piece.curvature) +
                                     max_component(last->curvature);
                ASSERT_DOUBLE_EQ(last->begin + x, piece.begin) << "line " << piece.line;
                ASSERT_LE(difference(position_on(*last, x), piece.start), 1e-9) << "line " << piece.line;
                ASSERT_LE(difference(tangent_on(*last, x), piece.tangent), 1e-9 * (1 + max_component(piece.tangent)))
                    << "line " << piece.line << " u " << piece.begin << " length " << x << " after " << last->line;
                ASSERT_LE(difference(curvature_on(*last, x), piece.curvature), 1e-9 * (1 + bends))
                    << "line " << piece.line << " u " << piece.begin << " lengths " << x << " " << piece.length;
            }
            last = item.rest ? nullptr : &item.piece;
        }
    });
}

bool same(const PathElement& a, const PathElement& b) {
    if (a.rest || b.rest) return a.rest == b.rest && a.seconds == b.seconds && a.line == b.line && a.at == b.at;
    const CubicSegment &p = a.piece, &q = b.piece;
    return p.begin == q.begin && p.length == q.length && p.start == q.start && p.tangent == q.tangent &&
           p.curvature == q.curvature && p.curvature_rate == q.curvature_rate && p.line == q.line && p.feed == q.feed;
}

TEST(PathLaws, SegmentsAreTheSameWheneverTheyAreFetched) {
    for_random_programs([](const Case& one) {
        ProgramMaker chance(one.seed);
        PathBuilder builder(machine(), Point{});
        std::size_t count = 0;
        PathElement item;
        const auto pull = [&] {
            if (!builder.pull(item)) return false;
            EXPECT_LT(count, one.items.size());
            EXPECT_TRUE(count < one.items.size() && same(item, one.items[count])) << "item " << count;
            ++count;
            return true;
        };
        const int eagerness = chance.one_of(4);
        for (const Move& move : one.moves) {
            while (!builder.has_room() && pull()) continue;
            ASSERT_TRUE(builder.has_room());
            builder.push(move);
            for (int i = chance.one_of(1 + 4 * eagerness); i > 0; --i) pull();
        }
        while (!builder.has_room() && pull()) continue;
        builder.flush();
        while (pull()) continue;
        ASSERT_EQ(count, one.items.size());
    });
}

TEST(PathLaws, AMoveMakesFewSegments) {
    for_random_programs([](const Case& one) {
        std::vector<int> count(one.moves.size() + 1);
        for (const CubicSegment& piece : pieces_of(one.items)) ++count[static_cast<std::size_t>(piece.line)];
        const std::vector<Geometry> paths = paths_of(one.moves);
        for (std::size_t i = 0; i < paths.size(); ++i) {
            // three knots per corner blend; the blends of up to 8 corners on either side may extend over a move
            const double turned = std::fabs(paths[i].sweep) * std::sqrt(std::sqrt(1 + paths[i].radius / half_pulse));
            ASSERT_LE(count[i + 1], 100 + 3 * turned) << "line " << i + 1;
        }
    });
}

TEST(PathLaws, PathsStartAndEndAtTheEndsOfTheProgram) {
    for_random_programs([](const Case& one) {
        Point at = {};
        const CubicSegment* last = nullptr;
        for (const PathElement& item : one.items) {
            if (item.rest) {
                if (last) {
                    ASSERT_LE(difference(position_on(*last, last->length), item.at), 1e-9) << item.line;
                }
                at = item.at;
            } else if (!last) {
                ASSERT_EQ(item.piece.start, at);
                ASSERT_EQ(item.piece.begin, 0);
            }
            last = item.rest ? nullptr : &item.piece;
        }
        ASSERT_TRUE(one.items.empty() || one.items.back().rest);
        if (!one.moves.empty()) {
            ASSERT_LE(difference(at, one.moves.back().end), 1.1e-9);
        }
    });
}

/// Returns the programmed velocity on a move, mm/s (degrees/s).
double programmed(const Move& move, const Geometry& path) {
    if (move.kind == MoveKind::rapid) return std::numeric_limits<double>::infinity();
    if (move.feed_mode == FeedMode::units_per_second) return move.feed;
    return move.feed * (path.length + 4e-6);  // includes skipped moves before it
}

TEST(PathLaws, TheProgrammedFeedIsNeverExceeded) {
    for_random_programs([](const Case& one) {
        const std::vector<Geometry> paths = paths_of(one.moves);
        for (const CubicSegment& piece : pieces_of(one.items)) {
            const std::size_t i = static_cast<std::size_t>(piece.line - 1);
            const double feed = programmed(one.moves[i], paths[i]);
            // lines of skipped moves have no direction of their own
            if (feed == std::numeric_limits<double>::infinity() || piece.length < 2e-6) continue;
            const double grown = paths[i].radius_growth * (1 + paths[i].radius / paths[i].length);
            const double spiral = grown * grown;  // lengths of spirals are nominal
            const bool rotary = paths[i].shape == PathShape::rotary;
            for (int k = 0; k <= 8; ++k) {
                const Point tangent = tangent_on(piece, piece.length * k / 8);
                const double velocity = rotary ? max_component(tangent) : xyz_size(tangent);
                ASSERT_LE(piece.feed * velocity, feed * (1 + 1e-8 + spiral))
                    << "line " << piece.line << " u " << piece.begin << " + " << piece.length;
                ASSERT_GT(piece.feed, 0);
            }
        }
    });
}

TEST(PathLaws, ThePathStaysWithinTheTolerance) {
    double max_error = 0;
    const auto shown = [&max_error] { return max_error > used_share; };
    for_programs(1000, shown, [&max_error](const Case& one) {
        const std::vector<Geometry> paths = paths_of(one.moves);
        for (const CubicSegment& piece : pieces_of(one.items)) {
            for (int k = 0; k < 4; ++k) {
                const Point p = position_on(piece, piece.length * k / 4);
                double best = std::numeric_limits<double>::infinity();
                const int first = std::max(0, piece.line - 12),
                          past = std::min(static_cast<int>(paths.size()), piece.line + 45);
                for (int i = first; i < past; ++i) {
                    const Move& move = one.moves[static_cast<std::size_t>(i)];
                    const bool exact = move.path != PathControl::continuous;
                    const double tolerance = exact ? half_pulse : std::max(move.tolerance_mm, half_pulse);
                    const Geometry& path = paths[static_cast<std::size_t>(i)];
                    best = std::min(best, distance_to(path, p[0], p[1], p[2]) / tolerance);
                }
                max_error = std::max(max_error, best);
                ASSERT_LE(best, 1 + 1e-6)
                    << "line " << piece.line << " u " << piece.begin << " + " << piece.length * k / 4;
            }
        }
    });
    RecordProperty("worst", std::to_string(max_error));
    EXPECT_GT(max_error, used_share);
}

/// Returns the smallest share of the tolerances, XYZ and ABC together, within which a point lies on a line.
double part_of_tolerances(const Geometry& line, const Point& at, double tolerance, double rotary) {
    const auto part = [&](double s) {
        double square = 0, max_rotary = 0;
        for (int i = 0; i < axis_count; ++i) {
            const double off = at[i] - (line.start[i] + s * (line.end[i] - line.start[i]));
            if (i < 3)
                square += off * off;
            else
                max_rotary = std::max(max_rotary, std::fabs(off) / rotary);
        }
        return std::max(max_rotary, std::sqrt(square) / tolerance);
    };
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (part(a) < part(b) ? high : low) = part(a) < part(b) ? b : a;
    }
    return part(low);
}

TEST(PathLaws, RotaryAxesStayWithinTheirToleranceAtTheSamePosition) {
    double max_error = 0;
    const auto shown = [&max_error] { return max_error > used_share; };
    for_programs(300, shown, [&max_error](const Case& one) {
        const std::vector<Geometry> paths = paths_of(one.moves);
        for (const CubicSegment& piece : pieces_of(one.items)) {
            double best = std::numeric_limits<double>::infinity();
            const int first = std::max(0, piece.line - 12),
                      past = std::min(static_cast<int>(paths.size()), piece.line + 45);
            const Point at = position_on(piece, 0.3 * piece.length);
            bool arcs = false;
            for (int i = first; i < past && !arcs; ++i) {
                const Move& move = one.moves[static_cast<std::size_t>(i)];
                const Geometry& path = paths[static_cast<std::size_t>(i)];
                arcs = path.shape == PathShape::arc;
                const bool exact = move.path != PathControl::continuous;
                const double tolerance = exact ? half_pulse : std::max(move.tolerance_mm, half_pulse);
                const double rotary = std::max(exact ? 0.0 : move.tolerance_mm / 100 * 180 / pi, half_pulse);
                best = std::min(best, part_of_tolerances(path, at, tolerance, rotary));
            }
            if (arcs) continue;
            max_error = std::max(max_error, best);
            ASSERT_LE(best, 1 + 1e-6) << "line " << piece.line << " u " << piece.begin;
        }
    });
    EXPECT_GT(max_error, used_share);
}

}  // namespace
}  // namespace motionrack::control
