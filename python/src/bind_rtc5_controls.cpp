// RTC5 control commands in Python, generated from the card's table.
#include <fmt/format.h>

#include <algorithm>
#include <python/src/rtc5.hpp>

namespace motionrack::python {

namespace {

using rtc5::ControlAnswer;
using rtc5::ControlCommand;

py::object number(const ControlCommand& command, double value) {
    if (!command.whole_answers) return py::float_(value);
    return py::int_(static_cast<std::int64_t>(value));
}

py::object answer_of(const ControlCommand& command, const ControlAnswer& answer) {
    if (answer.empty()) return py::none();
    if (answer.size() == 1) return number(command, answer[0]);
    py::tuple out(answer.size());
    for (std::size_t i = 0; i < answer.size(); ++i) out[i] = number(command, answer[i]);
    return out;
}

std::string answer_type(const ControlCommand& command) {
    if (command.answers == 0) return "None";
    const std::string one = command.whole_answers ? "int" : "float";
    if (command.answers == 1) return one;
    std::string out = "tuple[" + one;
    for (std::size_t i = 1; i < command.answers; ++i) out += ", " + one;
    return out + "]";
}

std::string doc_of(const ControlCommand& command) {
    std::vector<std::string> parameters;
    for (const rtc5::ControlParam& param : command.params())
        parameters.push_back(fmt::format("{}: {}", param.name, param.whole ? "int" : "float"));
    std::string meaning(command.meaning);
    meaning[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(meaning[0])));
    return fmt::format("{}\n\n{}.{}{}{} Source: {}.", signature(command.name, parameters, answer_type(command)),
                       meaning, command.ranges(), command.asks ? " Takes the time of a query." : "",
                       parameters.empty() ? "" : " Refused out of range; nothing is changed.", command.source);
}

}  // namespace

std::vector<double> numbers_given(std::string_view command, const std::vector<std::string_view>& names,
                                  const py::args& by_place, const py::kwargs& by_name) {
    const auto number_of = [&](const py::handle& given) {
        if (!PyNumber_Check(given.ptr()))
            throw py::type_error(
                fmt::format("{}: {} is not a number; nothing was done", command, py::repr(given).cast<std::string>()));
        return py::float_(py::reinterpret_borrow<py::object>(given)).cast<double>();
    };
    std::vector<double> out;
    for (const py::handle each : by_place) out.push_back(number_of(each));
    std::vector<bool> known(by_name.size() > 0 ? names.size() : 0);
    for (const auto& [key, value] : by_name) {
        const auto name = key.cast<std::string>();
        const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
        if (at >= names.size() || at < by_place.size())
            throw py::type_error(
                fmt::format("{}: parameter {} is unknown, or was given twice; nothing was done", command, name));
        out.resize(std::max(out.size(), at + 1));
        out[at] = number_of(value);
        known[at] = true;
    }
    for (std::size_t i = by_place.size(); i < out.size(); ++i)
        if (!known[i]) throw py::type_error(fmt::format("{}: {} was not given; nothing was done", command, names[i]));
    return out;
}

std::string signature(std::string_view name, const std::vector<std::string>& parameters, std::string_view answer) {
    std::string out = fmt::format("{}(self: motionrack._core.Rtc5", name);
    for (const std::string& parameter : parameters) out += ", " + parameter;
    return out + fmt::format(") -> {}", answer);
}

void bind_rtc5_controls(Rtc5Class& c) {
    py::options options;
    options.disable_function_signatures();
    for (const ControlCommand& command : rtc5::control_commands()) {
        std::vector<std::string_view> names;
        for (const rtc5::ControlParam& param : command.params()) names.push_back(param.name);
        c.def(
            std::string(command.name).c_str(),
            [&command, names](Rtc5& self, const py::args& by_place, const py::kwargs& by_name) {
                const std::vector<double> given = numbers_given(command.name, names, by_place, by_name);
                rtc5::Refusal refusal = rtc5::Refusal::parameter;
                const auto run = [&](rtc5::Engine& engine) -> Result<ControlAnswer> {
                    MOTIONRACK_CHECK(command.check(given));
                    refusal = command.refusal;
                    return command.run(engine, given);
                };
                return answer_of(command, command.asks ? ask(self, run, refusal) : order(self, run, refusal));
            },
            doc_of(command).c_str());
    }
}

}  // namespace motionrack::python
