// Continuous interpolation: one segment runs, one is queued, and one is held back until it is known whether it is the
// last.
//
//   chip   |== 1 ==|== 2 ==|== 3 ==|            3Ch before 1: no deceleration at a junction
//   given  1  2    3       End                  3Bh once 3 is queued: only the last one decelerates, at its DP
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/cards/mcx314/driver/checks.hpp>
#include <motionrack/cards/mcx314/driver/curves.hpp>
#include <motionrack/cards/mcx314/driver/driver.hpp>

namespace motionrack::mcx314 {

namespace {

constexpr double max_chain_rate = 2e6;  // maximum pulses/s of continuous interpolation
constexpr Duration poll_period_of_chains = microseconds(20);

}  // namespace

Result<void> Driver::check_chain_speed(int axis, std::int64_t v) const {
    const double rate = static_cast<double>(v) * multiple(axis);
    if (rate <= max_chain_rate) return {};
    return fail(
        ErrorKind::refused,
        fmt::format("V = {} of {} is {:.0f} pulses/s, but continuous interpolation makes at most {:.0f}. Nothing "
                    "was written.",
                    v, axes_text(1u << axis), rate, max_chain_rate));
}

Result<void> Driver::ContStart(const CONTDATA& data) {
    const Speeds speeds{data.A == 0 ? Curve::constant : Curve::t, data.SV, data.V, data.A, data.D, 0};
    MOTIONRACK_CHECK(check_speeds(axis_x, speeds));
    if (chain_.open && chain_.running && status().interpolating())
        return fail(ErrorKind::refused,
                    "ContStart: the previous chain still runs. Nothing was written. Call ContEnd or stop it first.");
    chain_ = {};
    chain_.open = true;
    chain_.speeds = speeds;
    return {};
}

Result<void> Driver::ContLine(unsigned axes, const FourAxes& finish, std::int64_t v, Duration timeout) {
    MOTIONRACK_CHECK(check_axes(axes, "ContLine"));
    const int count = channels_of(axes).count == 3 ? 3 : 2;
    MOTIONRACK_CHECK(check_count("ContLine", axes, count));
    return add_to_chain("ContLine", Piece{axes, false, false, finish, {}, {}, vector_axes_}, v, timeout);
}

Result<void> Driver::ContArc(unsigned axes, const FourAxes& finish, const FourAxes& centre, bool clockwise,
                             std::int64_t v, Duration timeout) {
    MOTIONRACK_CHECK(check_count("ContArc", axes, 2));
    return add_to_chain("ContArc", Piece{axes, true, clockwise, finish, centre, {}, vector_axes_}, v, timeout);
}

Result<void> Driver::add_to_chain(const char* who, const Piece& piece, std::int64_t v, Duration timeout) {
    if (!chain_.open)
        return fail(ErrorKind::refused,
                    fmt::format("{}: no chain is open. Nothing was written. Call ContStart first.", who));
    const int generator = chain_.pending_piece ? chain_.generator : channels_of(piece.axes).channel[0];
    MOTIONRACK_CHECK(check_piece(who, piece));
    MOTIONRACK_CHECK(check_initialised(1u << generator | 1u << channels_of(piece.axes).channel[0], who));
    if (v != 0) {
        MOTIONRACK_CHECK(check(1u << generator, param::V, v));
        if (chain_.speeds.kind == Curve::constant)
            return fail(ErrorKind::refused, fmt::format("{}: a chain of constant speed cannot change the speed. "
                                                        "Nothing was written. Give ContStart an acceleration.",
                                                        who));
    }
    MOTIONRACK_CHECK(check_chain_speed(generator, v != 0 ? v : chain_.speeds.V));
    if (chain_.pending_piece) {
        MOTIONRACK_CHECK(give_pending_piece(false, timeout));
    } else {
        MOTIONRACK_CHECK(check_free(piece.axes, who));
        chain_.generator = generator;
    }
    chain_.pending_piece = piece;
    chain_.pending_v = v;
    return {};
}

/// Starts the chain with the held-back segment, or queues it behind the running one.
Result<void> Driver::give_pending_piece(bool last, Duration timeout) {
    const int generator = chain_.generator;
    const unsigned own = 1u << generator;
    Piece piece = *chain_.pending_piece;
    if (!chain_.running) {
        MOTIONRACK_CHECK(check_free(piece.axes, "ContLine"));
        if (pattern_.axes != 0) close_pattern();
        if (chain_.pending_v != 0) chain_.speeds.V = chain_.pending_v;
        const bool ramps = chain_.speeds.kind == Curve::t;
        CurveData curve = curve_of(generator, chain_.speeds, basic_pulses(piece));
        if (ramps) curve.dec_point = param::DP.max;
        if (ramps && last) {
            MOTIONRACK_TRY(curve.dec_point, best_dec_point(curve));
        }
        own_range_again(own);
        put_speeds(own, chain_.speeds);
        put_deceleration(generator, curve);
        EnableDeceleration(ramps && last);
        read_start(piece);
        pieces_ = {};
        path_axes_ = 0;
        chain_.running = true;
    } else {
        MOTIONRACK_CHECK(wait_for_junction(timeout));
        if (chain_.next_v != 0) put(own, param::V, chain_.speeds.V = chain_.next_v);
        if (last) aim_at_end(piece);
        chain_.next_v = chain_.pending_v;
        read_start(piece);  // reads the start of an axis that joins the chain here; the others are already moving
        for (const int i : channels_of(chain_.axes)) piece.from[i] = chain_.at[i];
    }
    path_axes_ |= piece.axes;
    put_piece(piece);
    note_end(piece);
    ++chain_.segments;
    chain_.pending_piece.reset();
    return {};
}

/// End of the chain after this segment, for the positions on arcs.
void Driver::note_end(const Piece& piece) {
    chain_.axes |= piece.axes;
    const ChannelList list = channels_of(piece.axes);
    const auto h = static_cast<std::size_t>(list.channel[0]), v = static_cast<std::size_t>(list.channel[1]);
    FourAxes moved = piece.finish;
    if (piece.arc) {
        const rules::ArcEnd end =
            rules::end_of_arc(piece.centre[h], piece.centre[v], piece.finish[h], piece.finish[v], piece.clockwise);
        moved[h] = end.first;
        moved[v] = end.second;
    }
    for (const int i : channels_of(piece.axes)) chain_.at[i] = piece.from[i] + moved[i];
}

/// The last segment must contain the deceleration to SV: if it is too short, the speed is reduced before it.
void Driver::aim_at_end(const Piece& piece) {
    if (chain_.speeds.kind != Curve::t) return;
    const unsigned own = 1u << chain_.generator;
    const std::int64_t length = basic_pulses(piece);
    const CurveData curve = curve_of(chain_.generator, chain_.speeds, length);
    auto fits = [&](std::int64_t v) { return fall_pulses(curve, v) < length; };
    if (!fits(chain_.speeds.V)) {
        std::int64_t low = std::min(curve.SV, chain_.speeds.V),
                     high = chain_.speeds.V;  // the largest speed that fits: [low, high)
        while (high - low > 1) {
            const std::int64_t middle = (low + high) / 2;
            (fits(middle) ? low : high) = middle;
        }
        put(own, param::V, chain_.speeds.V = low);
    }
    if (chain_.pending_v != 0 && !fits(chain_.pending_v)) chain_.pending_v = 0;
    const std::int64_t top = std::max(chain_.speeds.V, chain_.pending_v);
    put(own, param::DP, std::max<std::int64_t>(0, length - fall_pulses(curve, top) - 1));
}

/// Waits for CNEXT. `may_end`: the end of the chain is accepted as well.
Result<void> Driver::wait_for_junction(Duration timeout, bool may_end) {
    const Instant end = later(interrupt_.now(), timeout);
    while (true) {
        const MainStatus main = status();
        if (main.can_queue()) return {};
        if (!main.interpolating()) {
            const std::string why = error_text(path_axes_);
            if (may_end && why.empty()) return {};
            chain_.open = chain_.running = false;
            if (!why.empty()) return fail(ErrorKind::machine, "The chain was stopped. " + why);
            return fail(
                ErrorKind::machine,
                fmt::format("Segment {} of the chain came too late: the axes stand at its start. Lower the speed, or "
                            "give longer segments.",
                            chain_.segments + 1));
        }
        if (interrupt_.stop_requested()) {
            SlowStop(path_axes_);
            chain_.open = chain_.running = false;
            MOTIONRACK_CHECK(wait_until_stopped(path_axes_, timeout));
            return fail(ErrorKind::stopped, "The chain was stopped on request.");
        }
        if (interrupt_.now() >= end)
            return fail(
                ErrorKind::machine,
                fmt::format("The running segment of the chain did not end within {:.3f} s; it was not stopped. Wait "
                            "longer, or stop the axes.",
                            to_seconds(timeout)));
        doze(0, poll_period_of_chains);
    }
}

Result<ContOutcome> Driver::ContEnd(Duration timeout) {
    if (!chain_.open || !chain_.pending_piece)
        return fail(
            ErrorKind::refused,
            "ContEnd: no chain with a segment is open. Nothing was written. Call ContStart and ContLine first.");
    const bool first = !chain_.running;
    const std::int64_t length = basic_pulses(*chain_.pending_piece);
    MOTIONRACK_CHECK(give_pending_piece(true, timeout));
    const bool ramps = chain_.speeds.kind == Curve::t;
    const CurveData curve = curve_of(chain_.generator, chain_.speeds, length);
    ContOutcome outcome{chain_.segments, ramps ? std::min(curve.SV, curve.V) : curve.V};
    if (ramps && first) {
        CurveData alone = curve;
        alone.dec_point = written(chain_.generator, cmd::DP);
        MOTIONRACK_TRY(const CurvePlan plan, plan_drive(alone));
        outcome.end_speed = plan.end_v;
    } else if (ramps) {
        EnableDeceleration(true);
        MOTIONRACK_CHECK(wait_for_junction(timeout, true));
        // The last segment is running: it may have begun faster than requested.
        const std::int64_t speed = ReadCV(chain_.generator);
        if (chain_.next_v != 0) put(1u << chain_.generator, param::V, chain_.speeds.V = chain_.next_v);
        if (fall_pulses(curve, speed) >= length) {
            put(1u << chain_.generator, param::DP, 0);
            outcome.end_speed = speed_after_fall(curve, speed, length);
        }
    }
    const unsigned axes = path_axes_;
    chain_.open = chain_.running = false;
    MOTIONRACK_CHECK(wait_until_done(axes, timeout));
    return outcome;
}

}  // namespace motionrack::mcx314
