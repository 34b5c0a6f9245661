// Fixed and continuous drives: checks everything, then writes the parameters, then the command.
#include <fmt/format.h>

#include <motionrack/cards/mcx314/driver/checks.hpp>
#include <motionrack/cards/mcx314/driver/curves.hpp>
#include <motionrack/cards/mcx314/driver/driver.hpp>

namespace motionrack::mcx314 {

namespace {

constexpr Field manual_bit = field("WR3", "MANLD");
constexpr Field own_decel_bit = field("WR3", "DSNDE");
constexpr Field s_bit = field("WR3", "SACC");

}  // namespace

Result<void> Driver::check_speeds(unsigned axes, const Speeds& speeds) {
    MOTIONRACK_CHECK(check(axes, param::V, speeds.V));
    if (speeds.kind == Curve::constant) return {};
    MOTIONRACK_CHECK(check(axes, param::SV, speeds.SV));
    MOTIONRACK_CHECK(check(axes, param::A, speeds.A));
    if (speeds.D != 0) MOTIONRACK_CHECK(check(axes, param::D, speeds.D));
    if (speeds.kind == Curve::s) MOTIONRACK_CHECK(check(axes, param::K, speeds.K));
    return {};
}

/// Constant speed is a start speed of V: the chip then has no ramp.
void Driver::put_speeds(unsigned axes, const Speeds& speeds) {
    put(axes, param::SV, speeds.kind == Curve::constant ? speeds.V : speeds.SV);
    put(axes, param::V, speeds.V);
    if (speeds.kind == Curve::constant) return;
    put(axes, param::A, speeds.A);
    if (speeds.D != 0) put(axes, param::D, speeds.D);
    if (speeds.kind == Curve::s) put(axes, param::K, speeds.K);
}

CurveData Driver::curve_of(int axis, const Speeds& speeds, std::optional<std::int64_t> pulses) const {
    CurveData curve;
    curve.R = kept(axis).own_range;
    curve.SV = speeds.kind == Curve::constant ? speeds.V : speeds.SV;
    curve.V = speeds.V;
    curve.A = speeds.kind == Curve::constant ? 1 : speeds.A;
    curve.D = speeds.D != 0 ? speeds.D : curve.A;
    if (speeds.kind == Curve::s) curve.K = speeds.K;
    curve.s_curve = speeds.kind == Curve::s;
    curve.asymmetric = speeds.D != 0 && speeds.D != speeds.A;
    curve.AO = written(axis, cmd::AO).value_or(0);
    curve.pulses = pulses;
    return curve;
}

/// Parameters of the next direct drive.
Driver::Speeds Driver::written_speeds(int axis) const {
    const auto last = [&](const Parameter& parameter, std::int64_t otherwise) {
        return written(axis, parameter.code).value_or(otherwise);
    };
    Speeds out{s_bit.test(mode3(axis)) ? Curve::s : Curve::t};
    out.SV = last(param::SV, 1), out.V = last(param::V, 1), out.A = last(param::A, 1);
    out.K = last(param::K, param::K.max);
    if (kept(axis).asymmetric) out.D = last(param::D, out.A);
    return out;
}

/// Restores R, which constant vector speed of an interpolation may have changed.
void Driver::own_range_again(unsigned axes) {
    for (const int i : channels_of(axes))
        if (kept(i).data[cmd::R] != kept(i).own_range) put(1u << i, param::vector_range, kept(i).own_range);
}

/// Adds the data for an end at SV, unless the user has set them.
Result<CurveData> Driver::planned_curve(const char* who, int axis, Speeds speeds,
                                        std::optional<std::int64_t> pulses) const {
    const Kept& own = kept(axis);
    if (own.asymmetric && !written(axis, cmd::D))
        return fail(ErrorKind::refused,
                    fmt::format("{}: {} decelerates with its own D, which is not set. Nothing was written. Call SetD "
                                "first, or SetAsymmetric(.., false).",
                                who, axes_text(1u << axis)));
    if (own.asymmetric) speeds.D = *written(axis, cmd::D);
    CurveData curve = curve_of(axis, speeds, pulses ? std::optional(rules::magnitude(*pulses)) : std::nullopt);
    if (own.manual) curve.dec_point = own.dec_point;
    return own.manual || (own.own_offset && !curve.asymmetric) ? curve : with_slow_end(curve);
}

Result<CurvePlan> Driver::plan(int axis, std::int64_t sv, std::int64_t v, std::int64_t a, std::int64_t k,
                               std::int64_t pulses) const {
    MOTIONRACK_CHECK(check_channel(axis, "plan"));
    const unsigned own = 1u << axis;
    const Speeds speeds{k != 0 ? Curve::s : Curve::t, sv, v, a, 0, k};
    MOTIONRACK_CHECK(check_speeds(own, speeds));
    MOTIONRACK_CHECK(check(own, param::pulses, pulses));
    MOTIONRACK_CHECK(check_initialised(own, "plan"));
    MOTIONRACK_TRY(const CurveData curve, planned_curve("plan", axis, speeds, pulses));
    return plan_drive(curve);
}

Result<void> Driver::start_curve(const char* who, unsigned axes, const Speeds& speeds,
                                 std::optional<std::int64_t> pulses, bool negative) {
    MOTIONRACK_CHECK(check_axes(axes, who));
    MOTIONRACK_CHECK(check_speeds(axes, speeds));
    if (pulses) MOTIONRACK_CHECK(check(axes, param::pulses, *pulses));
    MOTIONRACK_CHECK(check_initialised(axes, who));
    std::array<CurveData, 4> curves;
    for (const int i : channels_of(axes)) {
        MOTIONRACK_TRY(curves[static_cast<std::size_t>(i)], planned_curve(who, i, speeds, pulses));
    }
    MOTIONRACK_CHECK(check_standing(axes, who));
    own_range_again(axes);
    put_speeds(axes, speeds);
    if (pulses) MOTIONRACK_CHECK(Pulse(axes, *pulses));
    for (const int i : channels_of(axes)) put_deceleration(i, curves[static_cast<std::size_t>(i)]);
    if (pulses)
        begin_fixed(axes);
    else
        DriveContinuous(axes, negative);
    return {};
}

/// Writes WR3, and DP or AO, for the next drive.
void Driver::put_deceleration(int axis, const CurveData& curve) {
    const unsigned own = 1u << axis;
    const bool manual = curve.dec_point.has_value();
    if (manual && written(axis, cmd::DP) != curve.dec_point) put(own, param::DP, *curve.dec_point);
    if (!manual && curve.pulses && curve.V > curve.SV && written(axis, cmd::AO) != curve.AO)
        put(own, param::AO, curve.AO);
    const auto word = static_cast<std::uint16_t>(
        s_bit.set(own_decel_bit.set(manual_bit.set(mode3(axis), manual), curve.asymmetric), curve.s_curve));
    if (word != mode3(axis)) write_mode(own, 3, word);
}

/// Stores the start of each axis, then starts all at one tick: axes of one direction with one command; with two
/// directions both commands are held until 25h.
void Driver::begin_fixed(unsigned axes) {
    unsigned minus = 0;
    for (const int i : channels_of(axes)) {
        if (kept(i).negative) minus |= 1u << i;
        kept(i).from = ReadLPS(i);
        kept(i).from_known = true;
    }
    const unsigned plus = axes & ~minus;
    if (plus == 0 || minus == 0) return Drive(axes, plus == 0);
    Hold(axes);
    command(plus, cmd::FIXED_PLUS);
    command(minus, cmd::FIXED_MINUS);
    Start(axes);
}

Result<void> Driver::TCurve_F(unsigned axes, std::int64_t sv, std::int64_t v, std::int64_t a, std::int64_t pulses) {
    return start_curve("TCurve_F", axes, {Curve::t, sv, v, a, 0, 0}, pulses, false);
}
Result<void> Driver::TCurve_C(unsigned axes, std::int64_t sv, std::int64_t v, std::int64_t a, bool negative) {
    return start_curve("TCurve_C", axes, {Curve::t, sv, v, a, 0, 0}, {}, negative);
}
Result<void> Driver::SCurve_F(unsigned axes, std::int64_t sv, std::int64_t v, std::int64_t a, std::int64_t k,
                              std::int64_t pulses) {
    return start_curve("SCurve_F", axes, {Curve::s, sv, v, a, 0, k}, pulses, false);
}
Result<void> Driver::SCurve_C(unsigned axes, std::int64_t sv, std::int64_t v, std::int64_t a, std::int64_t k,
                              bool negative) {
    return start_curve("SCurve_C", axes, {Curve::s, sv, v, a, 0, k}, {}, negative);
}

Result<void> Driver::DriveFixed(unsigned axes) {
    MOTIONRACK_CHECK(check_axes(axes, "DriveFixed"));
    MOTIONRACK_CHECK(check_initialised(axes, "DriveFixed"));
    for (const int i : channels_of(axes))
        for (const Parameter& needed : {param::SV, param::V, param::A, param::pulses})
            if (!written(i, needed.code))
                return fail(ErrorKind::refused,
                            fmt::format("DriveFixed: {} of {} is not set. Nothing was written. Set it first.",
                                        needed.name, axes_text(1u << i)));
    MOTIONRACK_CHECK(check_standing(axes, "DriveFixed"));
    own_range_again(axes);
    for (const int i : channels_of(axes)) {
        const CurveData curve = curve_of(i, written_speeds(i), written(i, cmd::P));
        if (curve.asymmetric || manual_bit.test(mode3(i)) || kept(i).own_offset) continue;
        MOTIONRACK_TRY(const std::int64_t offset, best_offset(curve));
        if (written(i, cmd::AO) != offset) put(1u << i, param::AO, offset);
    }
    begin_fixed(axes);
    return {};
}

// ---- direct commands

void Driver::Drive(unsigned axes, bool negative) {
    note_direction(axes, negative);
    command(axes, negative ? cmd::FIXED_MINUS : cmd::FIXED_PLUS);
}

void Driver::DriveContinuous(unsigned axes, bool negative) {
    note_direction(axes, negative);
    for (const int i : channels_of(axes)) kept(i).from_known = false;
    command(axes, negative ? cmd::CONTINUOUS_MINUS : cmd::CONTINUOUS_PLUS);
}

void Driver::note_direction(unsigned axes, bool negative) {
    for (const int i : channels_of(axes)) kept(i).negative = negative;
}

void Driver::Hold(unsigned axes) {
    command(axes, cmd::HOLD);
}
void Driver::Start(unsigned axes) {
    command(axes, cmd::START);
}
void Driver::SlowStop(unsigned axes) {
    command(axes, cmd::SLOW_STOP);
}
void Driver::QuickStop(unsigned axes) {
    command(axes, cmd::QUICK_STOP);
}

}  // namespace motionrack::mcx314
