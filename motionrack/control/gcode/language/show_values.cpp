// (DEBUG,text) and (PRINT,text): the text with the values of its parameters.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/control/gcode/interpreter.hpp>
#include <motionrack/control/gcode/language/machine_parameters.hpp>
#include <motionrack/control/gcode/number.hpp>

namespace motionrack::control::gcode {

namespace {

/// Reads the format for the following values: %d, %f, %.4f, %lf. Returns its length; 0 for other text.
std::size_t format_at(std::string_view text, int& decimals) {
    if (text.starts_with("%d")) {
        decimals = 0;
        return 2;
    }
    if (text.starts_with("%f") || text.starts_with("%lf")) {
        decimals = 6;
        return text[1] == 'f' ? 2 : 3;
    }
    if (text.size() >= 4 && text.starts_with("%.") && is_digit(text[2]) && text[3] == 'f') {
        decimals = text[2] - '0';
        return 4;
    }
    return 0;
}

/// Returns the end of the parameter name that starts with the '#' at 0: digits, or up to '>'.
std::size_t end_of_parameter(std::string_view text) {
    if (text.size() > 1 && text[1] == '<') {
        const std::size_t close = text.find('>');
        return close == std::string_view::npos ? text.size() : close + 1;
    }
    std::size_t end = 1;
    while (end < text.size() && is_digit(text[end])) ++end;
    return end;
}

}  // namespace

/// Makes the texts of DEBUG and PRINT comments with the values after the assignments of the line and before its motion,
/// as LinuxCNC.
void Interpreter::show_values() {
    std::vector<std::string>& shown = state_.steps.shown();
    shown.clear();
    for (const Comment& comment : block().comments)
        shown.push_back(comment.values ? substitute_values(comment.text) : std::string());
}

/// Replaces parameters by their values; one without a value becomes ######, as in LinuxCNC.
std::string Interpreter::substitute_values(std::string_view text) const {
    const MachineParameters known(*this);
    std::string out;
    int decimals = 6;
    while (!text.empty()) {
        std::size_t length = format_at(text, decimals);
        if (length == 0 && text[0] == '#') {
            length = end_of_parameter(text);
            const std::string_view name = text.substr(0, length);
            ExpressionParser reader(name, known);
            const char* at = name.data();
            double value = 0;
            out += reader.value(at, value) ? fmt::format("{:.{}f}", value, decimals) : "######";
        } else if (length == 0) {
            length = 1;
            out += text[0];
        }
        text.remove_prefix(length);
    }
    return out;
}

}  // namespace motionrack::control::gcode
