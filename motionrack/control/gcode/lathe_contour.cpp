// The contour of a lathe cycle: corners, direction, offset.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/control/gcode/cutter_geometry.hpp>
#include <motionrack/control/gcode/lathe_cycle.hpp>
#include <motionrack/control/gcode/plane_point.hpp>

namespace motionrack::control::gcode {

namespace {

/// Maximum distance between equal points, mm.
constexpr double same_place = 1e-6;
/// Sine of the smallest angle that counts as a corner.
constexpr double no_corner = 1e-6;

CutterPath path_of(const ContourSegment& piece, double distance, bool& fits) {
    CutterPath path;
    fits = true;
    if (piece.arc())
        fits = offset_arc(piece.from, piece.to, piece.centre, piece.turns, distance, path);
    else
        path = offset_line(piece.from, piece.to, distance);
    return path;
}

ContourSegment piece_of(const CutterPath& path, std::int32_t line) {
    ContourSegment piece;
    piece.from = path.start;
    piece.to = path.end;
    piece.turns = path.turns;
    piece.centre = path.centre;
    piece.line = line;
    return piece;
}

/// Inserts the fillet between two segments: tangent to both. Its centre is the intersection of both offsets by its
/// radius.
std::string round_corner(ContourSegment& before, ContourSegment& after, ContourSegment& fillet) {
    std::string too_large =
        fmt::format("the {1} of {2:.6g} does not fit into the corner at the end of line {0}; reduce it", before.line,
                    before.chamfer ? "chamfer" : "fillet", before.corner);
    bool fits_before = false, fits_after = false;
    const CutterPath plain_before = path_of(before, 0, fits_before), plain_after = path_of(after, 0, fits_after);
    const double sine = cross(plain_before.direction_out, plain_after.direction_in);
    if (std::fabs(sine) < no_corner)
        return fmt::format(
            "the contour has no corner for A or C at the end of line {}: it continues in the same direction",
            before.line);
    const double side = sine > 0 ? before.corner : -before.corner;
    CutterPath left = path_of(before, side, fits_before), right = path_of(after, side, fits_after);
    if (!fits_before || !fits_after) return too_large;
    const CornerJoinPoint junction = join_corner(left, right, before.to, side);
    if (junction.kind != CornerJoin::meeting) return too_large;
    const auto foot = [&](const CutterPath& path, const CutterPath& plain) {
        if (path.arc) return path.centre + (junction.at - path.centre) * (plain.radius_in / path.radius_in);
        return junction.at - left_of(path.direction_in) * side;
    };
    const PlanePoint from = foot(left, plain_before), to = foot(right, plain_after);
    CutterPath shorter_before = plain_before, shorter_after = plain_after;
    if (!trim(shorter_before, before.from, from) || !trim(shorter_after, to, after.to)) return too_large;
    fillet = {};
    fillet.from = from;
    fillet.to = to;
    fillet.line = before.line;
    if (!before.chamfer) {
        fillet.centre = junction.at;
        fillet.turns = sine > 0 ? 1 : -1;
    }
    before.to = from;
    after.from = to;
    return {};
}

}  // namespace

std::string insert_fillets(std::vector<ContourSegment>& contour) {
    std::vector<ContourSegment> out;
    for (std::size_t i = 0; i < contour.size(); ++i) {
        ContourSegment& piece = contour[i];
        if (piece.corner > 0 && i + 1 == contour.size())
            return fmt::format("line {} is the contour's last one: it has no corner for A and C", piece.line);
        ContourSegment fillet;
        if (piece.corner > 0)
            if (std::string fault = round_corner(piece, contour[i + 1], fillet); !fault.empty()) return fault;
        const bool rounded = piece.corner > 0;
        piece.corner = 0;
        out.push_back(piece);
        if (rounded) out.push_back(fillet);
    }
    contour = std::move(out);
    return {};
}

std::string make_monotone(std::vector<ContourSegment>& contour, char axis) {
    std::vector<ContourSegment> out;
    for (const ContourSegment& piece : contour) {
        const auto goes_back = [&] {
            return fmt::format(
                "the contour reverses along {} in line {}, but it must be monotonic; split it, or cut this part by "
                "separate lines",
                axis, piece.line);
        };
        if (piece.to.first < piece.from.first - same_place) return goes_back();
        if (!piece.arc()) {
            out.push_back(piece);
            continue;
        }
        const PlanePoint a = piece.from - piece.centre, b = piece.to - piece.centre;
        const double radius = length(a);
        const std::array<bool, 4> passed = extremes_passed(a, b, piece.turns > 0);
        const std::array<PlanePoint, 4> at = {PlanePoint{radius, 0}, PlanePoint{0, radius}, PlanePoint{-radius, 0},
                                              PlanePoint{0, -radius}};
        const auto inside = [&](std::size_t i) {
            return passed[i] && length(at[i] - a) > same_place && length(at[i] - b) > same_place;
        };
        if (length(a - b) < same_place || inside(0) || inside(2)) return goes_back();
        ContourSegment part = piece;
        for (const std::size_t i : {1u, 3u}) {
            if (!inside(i)) continue;
            part.to = piece.centre + at[i];
            out.push_back(part);
            part.from = part.to;
            part.to = piece.to;
        }
        out.push_back(part);
    }
    contour = std::move(out);
    return {};
}

std::string offset_contour(const std::vector<ContourSegment>& contour, double distance,
                           std::vector<ContourSegment>& beside) {
    beside.clear();
    if (distance == 0) {
        beside = contour;
        return {};
    }
    const auto no_room = [&](const ContourSegment& piece) {
        return fmt::format(
            "line {1} of the contour is too tight for an offset of {0:.6g}; reduce the offset, or make the contour "
            "wider there",
            distance, piece.line);
    };
    std::vector<CutterPath> paths;
    for (const ContourSegment& piece : contour) {
        bool fits = false;
        paths.push_back(path_of(piece, distance, fits));
        if (!fits) return no_room(piece);
    }
    PlanePoint from = paths.front().start;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const bool last = i + 1 == paths.size();
        const CornerJoinPoint junction = last ? CornerJoinPoint{CornerJoin::straight_on, paths[i].end}
                                              : join_corner(paths[i], paths[i + 1], contour[i].to, distance);
        if (junction.kind == CornerJoin::none) return no_room(contour[i]);
        const PlanePoint to = junction.kind == CornerJoin::around ? paths[i].end : junction.at;
        if (!trim(paths[i], from, to)) return no_room(contour[i]);
        beside.push_back(piece_of(paths[i], contour[i].line));
        from = to;
        if (junction.kind != CornerJoin::around) continue;
        ContourSegment around;
        around.from = to;
        around.to = from = paths[i + 1].start;
        around.centre = contour[i].to;
        around.turns = -1;
        around.line = contour[i].line;
        beside.push_back(around);
    }
    return {};
}

}  // namespace motionrack::control::gcode
