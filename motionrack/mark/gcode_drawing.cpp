// Converts the moves of the G-code interpreter to strokes.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/gcode/program_reader.hpp>
#include <motionrack/mark/gcode_drawing.hpp>

namespace motionrack::mark {

namespace {

using control::Move;
using control::MoveKind;

/// Returns the angle of an arc around its centre, radians. The sign of `move.turns` is the direction; its magnitude is
/// one more than the number of full turns.
double sweep_of(const Move& move, Spot from, Spot to) {
    const Spot c{move.centre_first, move.centre_second};
    double sweep = atan2(to.y - c.y, to.x - c.x) - atan2(from.y - c.y, from.x - c.x);
    const bool closed = std::fabs(from.x - to.x) < 1e-9 && std::fabs(from.y - to.y) < 1e-9;
    if (closed) sweep = 0;
    const double sense = move.turns > 0 ? 1 : -1;
    while (sweep * sense <= 0) sweep += sense * 2 * pi;
    while (sweep * sense > 2 * pi + 1e-12) sweep -= sense * 2 * pi;
    return sweep + sense * 2 * pi * (std::abs(move.turns) - 1);
}

}  // namespace

Result<Drawing> read_gcode(std::string_view text, const std::string& file) {
    control::gcode::Settings settings;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        auto& limits = settings.limits[axis];
        limits = {.present = true,
                  .min_position = -1e5,
                  .max_position = 1e5,
                  .max_velocity = 1e5,
                  .max_accel = 1e6,
                  .pulses_per_unit = 1};
    }
    control::gcode::ProgramReader reader(text, settings, file);
    Drawing out;
    Spot at;
    bool down = false;
    std::size_t count = 0;
    for (;;) {
        const auto step = reader.next();
        if (!step) return tl::unexpected<Error>(static_cast<const Error&>(step.error()));
        if (*step == nullptr) return out;
        if ((*step)->kind != control::gcode::CanonCallKind::move || (*step)->move.kind == MoveKind::dwell) continue;
        const Move& move = (*step)->move;
        const Spot to{move.end[0], move.end[1]};
        if (move.kind == MoveKind::rapid) {
            down = false;
        } else {
            const bool is_arc = move.kind == MoveKind::arc;
            if (is_arc && (move.first != 0 || move.second != 1))
                return fail(ErrorKind::invalid_input,
                            "An arc outside the XY plane cannot be marked. Nothing was marked; use G17.",
                            {move.line, 0}, file);
            if (++count > max_elements)
                return fail(ErrorKind::invalid_input,
                            fmt::format("More than {} lines and arcs. Nothing was marked.", max_elements),
                            {move.line, 0}, file);
            if (is_arc || to.x != at.x || to.y != at.y) {
                if (!down) out.strokes.push_back({at, {}});
                down = true;
                out.strokes.back().elements.push_back(
                    is_arc ? Element{to, {move.centre_first, move.centre_second}, sweep_of(move, at, to)}
                           : Element{to});
            }
        }
        at = to;
    }
}

}  // namespace motionrack::mark
