#include <fmt/format.h>

#include <cmath>
#include <motionrack/control/gcode/number.hpp>
#include <motionrack/grbl/input_parser.hpp>
#include <motionrack/grbl/line_rules.hpp>
#include <motionrack/grbl/numbers.hpp>
#include <motionrack/grbl/sender_settings.hpp>

namespace motionrack::grbl {

namespace {

bool take_number(std::string_view& text, double& value) {
    const char* at = text.data();
    const control::gcode::Number number = control::gcode::scan_number(at, text.data() + text.size());
    if (number.fault != control::gcode::NumberFault::none) return false;
    text.remove_prefix(static_cast<std::size_t>(at - text.data()));
    value = number.value;
    return true;
}

bool take_equals(std::string_view& text) {
    if (text.empty() || text[0] != '=') return false;
    text.remove_prefix(1);
    return true;
}

}  // namespace

void SenderSettings::list() const {
    answers_.put(settings_text(machine_.rack().config(), own_, settings_.axes));
}

void SenderSettings::list_startup_lines() const {
    for (std::size_t i = 0; i < startup_lines_.size(); ++i)
        answers_.put(fmt::format("$N{}={}\r\n", i, startup_lines_[i]));
}

void SenderSettings::list_build() const {
    answers_.put(fmt::format("[VER:1.1h.20190830:{}]\r\n[OPT:V,{},{}]\r\n", build_text_, planner_blocks, max_waiting));
}

int SenderSettings::store(std::string_view text) {
    double number = 0, value = 0;
    if (!take_number(text, number)) return error_bad_number;
    if (!take_equals(text)) return error_unknown;
    if (!take_number(text, value)) return error_bad_number;
    if (!text.empty() || number != std::floor(number) || number < 0 || number > 255) return error_unknown;
    if (!control()) return error_locked;
    const SettingResult changed =
        change_setting(machine_.rack().config(), own_, settings_.axes, static_cast<int>(number), value);
    if (changed.note.empty()) return changed.error;
    if (changed.error != error_none)
        answers_.push(changed.note);
    else if (settings_.on_setting)
        settings_.on_setting(changed.note);
    return changed.error;
}

int SenderSettings::store_startup_line(std::string_view text) {
    double number = 0;
    if (!take_number(text, number)) return error_bad_number;
    if (!take_equals(text) || (number != 0 && number != 1)) return error_unknown;
    if (!control()) return error_locked;
    control::gcode::Interpreter trial = gcode_.interpreter();
    if (const auto read = trial.line(text, 0); !read) return static_cast<int>(read.error().status);
    if (starts_something(trial)) {
        answers_.push(
            "Not stored: a startup line runs at each reset, and a reset starts no motion, spindle, coolant or output");
        return error_unsupported;
    }
    startup_lines_[number == 0 ? 0 : 1] = text;
    return error_none;
}

int SenderSettings::restore(const std::string& text) {
    if (text.size() != 6 || text.compare(0, 5, "$RST=") != 0) return error_unknown;
    const char what = text[5];
    if (what != '$' && what != '#' && what != '*') return error_unknown;
    if (!control()) return error_locked;
    if (what != '#') own_ = SessionSettingValues();
    if (what != '$' && !machine_.programs().clear_offsets()) return error_not_idle;
    if (what == '*') {
        startup_lines_ = {};
        build_text_.clear();
    }
    if (settings_.on_setting) settings_.on_setting(fmt::format("{}: settings of the Grbl port are restored", text));
    return error_none;
}

}  // namespace motionrack::grbl
