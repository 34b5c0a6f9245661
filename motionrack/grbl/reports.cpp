#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/grbl/machine_view.hpp>
#include <motionrack/grbl/reports.hpp>
#include <utility>

namespace motionrack::grbl {

namespace {

// Number of status reports between repetitions of a field: in motion, and at standstill.
struct Every {
    int busy, idle;
};
constexpr Every offset_every = {30, 10}, overrides_every = {20, 10};

bool is_busy(State state) {
    return state == State::run || state == State::hold || state == State::jog || state == State::home ||
           state == State::door;
}

constexpr double mm_per_inch = 25.4;

}  // namespace

std::string Reports::state_text(State now) const {
    switch (now) {
        case State::idle:
            return "Idle";
        case State::run:
            return "Run";
        case State::hold:
            return is_moving(from_.machine) ? "Hold:1" : "Hold:0";
        case State::jog:
            return "Jog";
        case State::alarm:
            return "Alarm";
        case State::door:
            return is_moving(from_.machine) ? "Door:2" : "Door:0";
        case State::check:
            return "Check";
        case State::home:
            return "Home";
        case State::sleep:
            return "Sleep";
    }
    return "";
}

/// Returns "1.000,2.000,3.000" in mm or inches ($13); degrees are not converted.
std::string Reports::values(const control::Point& point) const {
    std::string out;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(from_.settings.axes); ++axis) {
        const bool inches = from_.own.inches != 0 && axis < 3;
        double value = inches ? point[axis] / mm_per_inch : point[axis];
        if (std::fabs(value) < (inches ? 0.00005 : 0.0005)) value = 0;  // no "-0.000"
        out += fmt::format("{}{:.{}f}", axis == 0 ? "" : ",", value, inches ? 4 : 3);
    }
    return out;
}

void Reports::answer_request() {
    if (!std::exchange(status_wanted_, false)) return;
    const State now = from_.state.now();
    const operate::Status& status = from_.machine.status();
    const unsigned shown = static_cast<unsigned>(from_.own.report);
    const control::Point& offset = from_.gcode.interpreter().frame().offset;
    control::Point position = {};
    for (const operate::AxisStatus& axis : status.axes)
        position[static_cast<std::size_t>(from_.machine.rack().config().axis(axis.letter)->index())] = axis.commanded;
    const bool machine_places = (shown & 1) != 0;
    if (!machine_places)
        for (std::size_t axis = 0; axis < position.size(); ++axis) position[axis] -= offset[axis];
    answers_.put(fmt::format("<{}|{}Pos:{}", state_text(now), machine_places ? 'M' : 'W', values(position)));
    if ((shown & 2) != 0) answers_.put(fmt::format("|Bf:{},{}", from_.gcode.free_blocks(), from_.reader.free_bytes()));
    if (const auto n_word = from_.gcode.executed_n_word(); now == State::run && n_word)
        answers_.put(fmt::format("|Ln:{}", *n_word));
    const double feed = from_.own.inches != 0 ? feed_now(from_.machine) / mm_per_inch : feed_now(from_.machine);
    answers_.put(fmt::format("|FS:{:.{}f},{:.0f}", feed, from_.own.inches != 0 ? 1 : 0, spindle_rpm()));
    answers_.put(pins());
    answers_.put(counted_reports(now));
    answers_.put(">\r\n");
}

bool Reports::report_probe() {
    const control::ProbeReport& probe = from_.machine.stream().last_probe();
    const bool probed = std::exchange(probes_reported_, probe.count) != probe.count;
    if (probed && probe.begun) answers_.put(probe_text());
    return probed;
}

/// Returns the report of the work offset or of the overrides: after a change, and periodically; never both at once.
std::string Reports::counted_reports(State now) {
    const control::Point& offset = from_.gcode.interpreter().frame().offset;
    const Overrides overrides_now = from_.overrides.now();
    if (offset != std::exchange(reported_offset_, offset)) until_offset_ = 0;
    if (overrides_now != std::exchange(reported_overrides_, overrides_now)) until_overrides_ = 0;
    std::string accessories_now = accessories();
    if (accessories_now != std::exchange(reported_accessories_, accessories_now)) until_overrides_ = 0;
    std::string out;
    if (until_offset_ > 0) {
        --until_offset_;
    } else {
        until_offset_ = (is_busy(now) ? offset_every.busy : offset_every.idle) - 1;
        if (until_overrides_ == 0) until_overrides_ = 1;
        out += "|WCO:" + values(offset);
    }
    if (until_overrides_ > 0) {
        --until_overrides_;
    } else {
        until_overrides_ = (is_busy(now) ? overrides_every.busy : overrides_every.idle) - 1;
        out += fmt::format("|Ov:{},{},{}", overrides_now.feed, overrides_now.rapid, overrides_now.spindle);
        if (!accessories_now.empty()) out += "|A:" + accessories_now;
    }
    return out;
}

/// Returns the active pins: P, probe contact; axis letters, limit switches; R, emergency stop, which a Grbl has at its
/// reset pin.
std::string Reports::pins() const {
    std::string out;
    if (const Result<double> probe = from_.machine.wires().get("probe"); probe && *probe != 0) out += 'P';
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(from_.settings.axes); ++axis)
        if (limit_active(from_.machine, control::axis_letters[axis])) out += control::axis_letters[axis];
    if (contact_open(from_.machine, "estop")) out += 'R';
    return out.empty() ? out : "|Pn:" + out;
}

std::string Reports::accessories() const {
    using control::gcode::Spindle;
    const operate::Status& status = from_.machine.status();
    std::string out;
    if (status.spindle != Spindle::off && !from_.overrides.is_spindle_stopped())
        out += status.spindle == Spindle::clockwise ? 'S' : 'C';
    if (status.flood) out += 'F';
    if (status.mist) out += 'M';
    return out;
}

double Reports::spindle_rpm() const {
    const operate::Status& status = from_.machine.status();
    if (status.spindle == control::gcode::Spindle::off || from_.overrides.is_spindle_stopped() ||
        status.spindle_rpm == 0)
        return 0;
    return std::max(from_.own.min_rpm,
                    std::min(from_.own.max_rpm, status.spindle_rpm * from_.overrides.spindle_percent() / 100));
}

std::string Reports::parser_state() const {
    using control::gcode::Spindle;
    const control::gcode::ModalState& modes = from_.gcode.interpreter().modes();
    std::string out =
        fmt::format("[GC:G{} G{} G{} G{} G{} G{}", from_.gcode.motion_mode(),
                    modes.system < 6 ? fmt::format("{}", 54 + modes.system) : fmt::format("59.{}", modes.system - 5),
                    17 + modes.plane, modes.inch ? 20 : 21, modes.incremental ? 91 : 90, modes.inverse_time ? 93 : 94);
    out += modes.spindle == Spindle::off ? " M5" : modes.spindle == Spindle::clockwise ? " M3" : " M4";
    if (modes.mist) out += " M7";
    if (modes.flood) out += " M8";
    if (!modes.mist && !modes.flood) out += " M9";
    const double feed = modes.inverse_time ? 0 : modes.feed * 60;
    const bool inches = from_.own.inches != 0;
    out += fmt::format(" T{} F{:.{}f} S{:.0f}]\r\n", std::max(0, modes.tool_selected),
                       inches ? feed / mm_per_inch : feed, inches ? 1 : 0, modes.speed_rpm);
    return out;
}

std::string Reports::parameters() const {
    const control::gcode::WorkFrame& frame = from_.gcode.interpreter().frame();
    std::string out;
    for (std::size_t system = 0; system < control::gcode::grbl_work_system_count; ++system)
        out += fmt::format("[G{}:{}]\r\n", 54 + system, values(frame.work[system]));
    out += fmt::format("[G28:{}]\r\n[G30:{}]\r\n[G92:{}]\r\n", values(frame.g28), values(frame.g30), values(frame.g92));
    const bool inches = from_.own.inches != 0;
    out += fmt::format("[TLO:{:.{}f}]\r\n", inches ? frame.tool[2] / mm_per_inch : frame.tool[2], inches ? 4 : 3);
    return out + probe_text();
}

/// Returns "[PRB:..]": machine coordinates of the last contact, then 1 for a contact or 0 for none.
std::string Reports::probe_text() const {
    const control::gcode::WorkFrame& frame = from_.gcode.interpreter().frame();
    return fmt::format("[PRB:{}:{}]\r\n", values(frame.probe), frame.probe_hit ? 1 : 0);
}

}  // namespace motionrack::grbl
