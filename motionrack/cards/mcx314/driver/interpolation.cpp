// Lines and arcs: checks everything, then writes speeds of the first axis, finish points, centres and WR5, then the
// command.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/mcx314/driver/checks.hpp>
#include <motionrack/cards/mcx314/driver/curves.hpp>
#include <motionrack/cards/mcx314/driver/driver.hpp>

namespace motionrack::mcx314 {

namespace {

// R of the second and third axis for R of the first: a pulse of two axes is sqrt(2), of three sqrt(3) pulses long.
constexpr double two_axes_factor = 1.41421356237309503, three_axes_factor = 1.73205080756887719;
constexpr double min_off_circle = 3;

std::int64_t times(std::int64_t range, double factor) {
    return static_cast<std::int64_t>(static_cast<double>(range) * factor + 0.5);
}

bool is_zero(const FourAxes& values, unsigned axes) {
    for (const int i : channels_of(axes))
        if (values[i] != 0) return false;
    return true;
}

Result<void> check_arc_tolerance(double part) {
    if (part >= 0 && part <= 1) return {};
    return fail(
        ErrorKind::refused,
        fmt::format("set_arc_tolerance: {} is out of range; it must be 0 to 1. The tolerance was not changed.", part));
}

}  // namespace

// ---- direct register access

void Driver::write_path_mode(std::uint16_t word) {
    const PlainRegisters plain(*this);
    port_.write(reg::WR5, word);
    path_mode_ = word;
}

void Driver::SetInterpolationAxes(int first, int second, int third, bool constant_vector, bool interrupt_at_junctions) {
    unsigned word = field("WR5", "AX1").set(0, static_cast<unsigned>(first));
    word = field("WR5", "AX2").set(word, static_cast<unsigned>(second));
    word = field("WR5", "AX3").set(word, static_cast<unsigned>(third < 0 ? 0 : third));
    word = field("WR5", "LSPD").set(word, constant_vector ? 1 : 0);
    path_axes_ = 1u << first | 1u << second | (third < 0 ? 0 : 1u << third);
    write_path_mode(field("WR5", "CIINT").set(word, interrupt_at_junctions));
}

Result<void> Driver::Line(const Finish* ends, int count) {
    for (int i = 0; i < count; ++i) {
        MOTIONRACK_CHECK(check_channel(ends[i].axis, "Line"));
        MOTIONRACK_CHECK(check(1u << ends[i].axis, param::finish, ends[i].pulses));
    }
    for (int i = 0; i < count; ++i) put(1u << ends[i].axis, param::finish, ends[i].pulses);
    pieces_ = {};
    command(0, count == 3 ? cmd::LINE3 : cmd::LINE2);
    return {};
}

Result<void> Driver::Arc(const Finish (&ends)[2], bool clockwise) {
    for (const Finish& end : ends) {
        MOTIONRACK_CHECK(check_channel(end.axis, "Arc"));
        MOTIONRACK_CHECK(check(1u << end.axis, param::finish, end.pulses));
        MOTIONRACK_CHECK(check(1u << end.axis, param::C, end.centre));
    }
    for (const Finish& end : ends) {
        put(1u << end.axis, param::finish, end.pulses);
        put(1u << end.axis, param::C, end.centre);
    }
    pieces_ = {};
    command(0, clockwise ? cmd::ARC_CW : cmd::ARC_CCW);
    return {};
}

void Driver::EnableDeceleration(bool on) {
    command(0, on ? cmd::DECELERATION_ON : cmd::DECELERATION_OFF);
}
void Driver::ClearInterpolationInterrupt() {
    command(0, cmd::INTERPOLATION_INTERRUPT_CLEAR);
}

void Driver::EnableInterpolationInterrupts(bool junctions, bool patterns) {
    write_path_mode(field("WR5", "BPINT").set(field("WR5", "CIINT").set(path_mode_, junctions), patterns));
}

// ---- points and settings

Result<void> Driver::SetFP(unsigned axes, std::int64_t finish) {
    MOTIONRACK_CHECK(write(axes, param::finish, finish));
    for (const int i : channels_of(axes)) kept(i).finish = finish;
    return {};
}

Result<void> Driver::SetCP(unsigned axes, std::int64_t centre) {
    MOTIONRACK_CHECK(write(axes, param::C, centre));
    for (const int i : channels_of(axes)) kept(i).centre = centre;
    return {};
}

Result<void> Driver::set_arc_tolerance(double part) {
    MOTIONRACK_CHECK(check_arc_tolerance(part));
    arc_tolerance_ = part;
    return {};
}

Result<void> Driver::SetVectorSpeed(int axes_count) {
    if (axes_count < 1 || axes_count > 3)
        return fail(
            ErrorKind::refused,
            fmt::format("SetVectorSpeed: {} axes; it must be 1 (off), 2 or 3. Nothing was changed.", axes_count));
    vector_axes_ = axes_count;
    return {};
}

// ---- checks

Result<void> Driver::check_count(const char* who, unsigned axes, int count) {
    MOTIONRACK_CHECK(check_axes(axes, who));
    if (channels_of(axes).count == count) return {};
    return fail(ErrorKind::refused, fmt::format("{}: the axis mask {} is {}, but it must name {}. Nothing was written.",
                                                who, axes, axes_text(axes),
                                                count == 2 ? "two axes: xy 3, xz 5, xu 9, yz 6, yu 10, zu 12"
                                                           : "three axes: xyz 7, xyu 11, xzu 13, yzu 14"));
}

/// Checks that finish points and centres are in range and consistent.
Result<void> Driver::check_piece(const char* who, const Piece& piece) const {
    for (const int i : channels_of(piece.axes)) {
        MOTIONRACK_CHECK(check(1u << i, param::finish, piece.finish[static_cast<std::size_t>(i)]));
        if (piece.arc) MOTIONRACK_CHECK(check(1u << i, param::C, piece.centre[static_cast<std::size_t>(i)]));
    }
    if (!piece.arc) {
        if (!is_zero(piece.finish, piece.axes)) return {};
        return fail(ErrorKind::refused,
                    fmt::format("{}: every finish point of {} is 0. Nothing was written. Give P, or call SetFP first.",
                                who, axes_text(piece.axes)));
    }
    const ChannelList list = channels_of(piece.axes);
    const auto h = static_cast<std::size_t>(list.channel[0]), v = static_cast<std::size_t>(list.channel[1]);
    const double cx = static_cast<double>(piece.centre[h]), cy = static_cast<double>(piece.centre[v]);
    const double fx = static_cast<double>(piece.finish[h]) - cx, fy = static_cast<double>(piece.finish[v]) - cy;
    const double radius = std::sqrt(cx * cx + cy * cy), reach = std::sqrt(fx * fx + fy * fy);
    if (radius == 0)
        return fail(ErrorKind::refused,
                    fmt::format("{}: the centre is the start, so the radius is 0. Nothing was written. Give C, or call "
                                "SetCP first.",
                                who));
    const double allowed = std::max(min_off_circle, arc_tolerance_ * radius);
    if (std::fabs(reach - radius) <= allowed) return {};
    const rules::ArcEnd end =
        rules::end_of_arc(piece.centre[h], piece.centre[v], piece.finish[h], piece.finish[v], piece.clockwise);
    return fail(
        ErrorKind::refused,
        fmt::format(
            "{}: the finish point ({}, {}) is {:.1f} pulses from the centre, but the start is {:.1f}; at most {:.1f} "
            "pulses of difference are allowed. Nothing was written. The chip would end at ({}, {}).",
            who, piece.finish[h], piece.finish[v], reach, radius, allowed, end.first, end.second));
}

/// The points of a call: those in the data, or all those stored by SetFP and SetCP.
Driver::Piece Driver::piece_of(unsigned axes, const FourAxes& finish, const FourAxes* centre, bool clockwise) const {
    Piece piece{axes, centre != nullptr, clockwise, finish, centre ? *centre : FourAxes{}, {}, vector_axes_};
    const bool use_kept = is_zero(centre ? *centre : finish, axes);
    for (const int i : channels_of(axes)) {
        if (use_kept) piece.finish[i] = kept_[i].finish.value_or(0);
        if (use_kept && centre) piece.centre[i] = kept_[i].centre.value_or(0);
    }
    return piece;
}

std::int64_t Driver::basic_pulses(const Piece& piece) {
    if (piece.arc) {
        const ChannelList list = channels_of(piece.axes);
        const auto h = static_cast<std::size_t>(list.channel[0]), v = static_cast<std::size_t>(list.channel[1]);
        return rules::end_of_arc(piece.centre[h], piece.centre[v], piece.finish[h], piece.finish[v], piece.clockwise)
            .basic_pulses;
    }
    std::int64_t max_finish = 0;
    for (const int i : channels_of(piece.axes)) max_finish = std::max(max_finish, rules::magnitude(piece.finish[i]));
    return max_finish;
}

// ---- start

/// Writes R of the axes for constant vector speed, WR5, points and the command of one segment.
void Driver::put_piece(const Piece& piece) {
    const ChannelList list = channels_of(piece.axes);
    const int vector_axes = std::min(piece.vector_axes, list.count);
    const std::int64_t range = kept(list.channel[0]).own_range;
    if (vector_axes >= 2) put(1u << list.channel[1], param::vector_range, times(range, two_axes_factor));
    if (vector_axes >= 3) put(1u << list.channel[2], param::vector_range, times(range, three_axes_factor));
    for (int n = 0; n < list.count; ++n) {
        const int i = list.channel[static_cast<std::size_t>(n)];
        put(1u << i, param::finish, piece.finish[static_cast<std::size_t>(i)]);
        if (piece.arc) put(1u << i, param::C, piece.centre[static_cast<std::size_t>(i)]);
    }
    unsigned word = field("WR5", "AX1").set(path_mode_, static_cast<unsigned>(list.channel[0]));
    word = field("WR5", "AX2").set(word, static_cast<unsigned>(list.channel[1]));
    word = field("WR5", "AX3").set(word, list.count > 2 ? static_cast<unsigned>(list.channel[2]) : 0);
    write_path_mode(field("WR5", "LSPD").set(word, vector_axes == 3 ? 3 : vector_axes == 2 ? 1 : 0));
    pieces_[0] = pieces_[1];
    pieces_[1] = piece;
    command(0,
            piece.arc ? (piece.clockwise ? cmd::ARC_CW : cmd::ARC_CCW) : (list.count == 3 ? cmd::LINE3 : cmd::LINE2));
}

/// Present position of the axes of a segment.
void Driver::read_start(Piece& piece) {
    for (const int i : channels_of(piece.axes)) piece.from[static_cast<std::size_t>(i)] = ReadLPS(i);
}

Result<void> Driver::start_piece(const char* who, Piece piece, const Speeds& speeds) {
    const int first = channels_of(piece.axes).channel[0];
    const unsigned own = 1u << first;
    MOTIONRACK_CHECK(check_speeds(own, speeds));
    MOTIONRACK_CHECK(check_piece(who, piece));
    MOTIONRACK_CHECK(check_initialised(own, who));
    CurveData curve = curve_of(first, speeds, basic_pulses(piece));
    if (speeds.kind != Curve::constant && kept(first).manual) {
        curve.dec_point = kept(first).dec_point;
    } else if (speeds.kind != Curve::constant && piece.arc) {
        MOTIONRACK_TRY(curve.dec_point, best_dec_point(curve));
    } else if (speeds.kind != Curve::constant && (curve.asymmetric || !kept(first).own_offset)) {
        MOTIONRACK_TRY(curve, with_slow_end(curve));
    }
    MOTIONRACK_CHECK(check_free(piece.axes, who));
    abandon_path();
    own_range_again(own);
    put_speeds(own, speeds);
    put_deceleration(first, curve);
    EnableDeceleration(speeds.kind != Curve::constant);
    read_start(piece);
    path_axes_ = piece.axes;
    put_piece(piece);
    return {};
}

Result<void> Driver::line(const char* who, const LINEDATA& data, unsigned axes, int count, Curve kind) {
    MOTIONRACK_CHECK(check_count(who, axes, count));
    return start_piece(who, piece_of(axes, data.P, nullptr, false), {kind, data.SV, data.V, data.A, data.D, data.K});
}

Result<void> Driver::circle(const char* who, const CIRCLEDATA& data, unsigned axes, bool clockwise, Curve kind) {
    MOTIONRACK_CHECK(check_count(who, axes, 2));
    return start_piece(who, piece_of(axes, data.P, &data.C, clockwise), {kind, data.SV, data.V, data.A, data.D, 0});
}

Result<void> Driver::Line2D_C(const LINEDATA& data, unsigned axes) {
    return line("Line2D_C", data, axes, 2, Curve::constant);
}
Result<void> Driver::Line2D_T(const LINEDATA& data, unsigned axes) {
    return line("Line2D_T", data, axes, 2, Curve::t);
}
Result<void> Driver::Line2D_S(const LINEDATA& data, unsigned axes) {
    return line("Line2D_S", data, axes, 2, Curve::s);
}
Result<void> Driver::Line3D_C(const LINEDATA& data, unsigned axes) {
    return line("Line3D_C", data, axes, 3, Curve::constant);
}
Result<void> Driver::Line3D_T(const LINEDATA& data, unsigned axes) {
    return line("Line3D_T", data, axes, 3, Curve::t);
}
Result<void> Driver::Line3D_S(const LINEDATA& data, unsigned axes) {
    return line("Line3D_S", data, axes, 3, Curve::s);
}
Result<void> Driver::CircleCW_C(const CIRCLEDATA& data, unsigned axes) {
    return circle("CircleCW_C", data, axes, true, Curve::constant);
}
Result<void> Driver::CircleCCW_C(const CIRCLEDATA& data, unsigned axes) {
    return circle("CircleCCW_C", data, axes, false, Curve::constant);
}
Result<void> Driver::CircleCW_T(const CIRCLEDATA& data, unsigned axes) {
    return circle("CircleCW_T", data, axes, true, Curve::t);
}
Result<void> Driver::CircleCCW_T(const CIRCLEDATA& data, unsigned axes) {
    return circle("CircleCCW_T", data, axes, false, Curve::t);
}

Result<rules::ArcEnd> Driver::arc_end(const CIRCLEDATA& data, unsigned axes, bool clockwise) const {
    MOTIONRACK_CHECK(check_count("arc_end", axes, 2));
    const Piece piece = piece_of(axes, data.P, &data.C, clockwise);
    MOTIONRACK_CHECK(check_piece("arc_end", piece));
    const ChannelList list = channels_of(axes);
    const auto h = static_cast<std::size_t>(list.channel[0]), v = static_cast<std::size_t>(list.channel[1]);
    return rules::end_of_arc(piece.centre[h], piece.centre[v], piece.finish[h], piece.finish[v], clockwise);
}

}  // namespace motionrack::mcx314
