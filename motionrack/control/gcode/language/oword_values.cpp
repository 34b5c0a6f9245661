// Evaluates the values of an O word.
#include <fmt/format.h>

#include <motionrack/control/gcode/language/expression_parser.hpp>
#include <motionrack/control/gcode/language/machine_parameters.hpp>
#include <motionrack/control/gcode/language/oword_values.hpp>
#include <motionrack/control/gcode/number.hpp>

namespace motionrack::control::gcode {

std::optional<OWordFault> evaluate_values(const OWordLocation& location, std::size_t max_values,
                                          Interpreter& interpreter, std::vector<double>& values) {
    const MachineParameters known(interpreter);
    ExpressionParser reader(location.text, known);
    const char* at = location.text.data() + location.rest;
    const char* end = location.text.data() + location.text.size();
    for (;;) {
        while (at < end && is_blank(*at)) ++at;
        const auto column = static_cast<std::size_t>(at - location.text.data());
        if (at == end || *at != '[') {
            if (is_rest_empty(location.text, column)) return std::nullopt;
            return OWordFault{column, fmt::format("{} takes values in brackets, e.g. [#1 + 2], and comments",
                                                  name_of(location.word))};
        }
        if (values.size() == max_values)
            return OWordFault{column, max_values == 1 ? fmt::format("{} takes one value", name_of(location.word))
                                                      : fmt::format("a call has at most {} arguments", max_values)};
        double value = 0;
        if (!reader.value(at, value)) return OWordFault{reader.fault_at(), reader.fault()};
        values.push_back(value);
    }
}

std::optional<OWordFault> evaluate_condition(const OWordLocation& location, Interpreter& interpreter, double& value) {
    std::vector<double> values;
    if (std::optional<OWordFault> fault = evaluate_values(location, 1, interpreter, values)) return fault;
    if (values.empty())
        return OWordFault{location.column,
                          fmt::format("{} needs a value in brackets, e.g. [#1 LT 5]", name_of(location.word))};
    value = values.front();
    return std::nullopt;
}

}  // namespace motionrack::control::gcode
