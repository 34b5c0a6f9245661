// Catalogue as a page.
#include <fmt/format.h>

#include <algorithm>
#include <tests/fault/catalogue.hpp>

namespace motionrack::faults {

namespace {

/// Returns the text as a table cell: on one line, with `|` escaped.
std::string cell(std::string text) {
    for (std::size_t at = 0; (at = text.find_first_of("|\n", at)) != std::string::npos; ++at)
        text.replace(at, 1, text[at] == '\n' ? " " : "\\|"), ++at;
    return text;
}

/// Converts "--fault X.motor.stall@{at}s" to "`X.motor.stall@{at}s`".
std::string injected(const std::string& option) {
    constexpr std::string_view fault = "--fault ";
    return "`" + (option.rfind(fault, 0) == 0 ? option.substr(fault.size()) : option) + "`";
}

std::string what_is_done(const Fault& fault) {
    std::string out = fault.does;
    for (const std::string& option : fault.inject) out += fmt::format(" {}", injected(option));
    if (!fault.command.empty()) out += " `" + fault.command + "`";
    return out;
}

std::string what_stops(const Fault& fault) {
    return fault.within_ms ? fmt::format("{}; within {:g} ms", fault.stops, *fault.within_ms) : fault.stops;
}

std::string what_is_read(const Fault& fault) {
    std::string out;
    for (const std::string& words : fault.says) out += (out.empty() ? "\"... " : "<br>\"... ") + words + " ...\"";
    for (const std::string& value : fault.shows) out += (out.empty() ? "`" : "<br>`") + value + "`";
    if (out.empty()) out = "nothing";
    return fault.exit == 0 ? out : out + fmt::format("<br>exit code {}", fault.exit);
}

std::string what_is_kept(const Fault& fault) {
    if (!fault.positions_valid) return fault.keeps;
    return fault.keeps + (*fault.positions_valid ? "; positions are valid" : "; positions are not valid");
}

std::string points_text(const std::vector<Point>& points) {
    std::string out;
    for (const Point& point : points) {
        std::string values;
        for (const auto& [name, value] : point.values)
            if (std::none_of(value.begin(), value.end(), [](char c) { return c >= 0 && c < ' '; }))
                values += fmt::format("{}{} `{}`", values.empty() ? "" : ", ", name, value);
        out += (out.empty() ? "" : "; ") + point.name + (values.empty() ? "" : " (" + values + ")");
    }
    return out;
}

bool same_points(const std::vector<Point>& a, const std::vector<Point>& b) {
    return points_text(a) == points_text(b);
}

}  // namespace

std::string catalogue_page(const std::vector<Group>& groups) {
    std::size_t count = 0;
    for (const Group& group : groups) count += group.faults.size();
    std::string out = fmt::format(
        "# Faults\n\n<!-- written by `fault_page`, from tests/fault/catalogue.toml -->\n\n{} faults that parts, cards, "
        "wires, the bus, files, the network and the process can have: effect, required stop and its time limit, "
        "message and kept data. `ctest -L fault` runs each of them at two operating points and checks all of it; "
        "faults of parts, cards and wires in a program, during homing and of stages are injected into a served "
        "machine, too, which raises one alarm with these words. Times are of the simulated world, from the fault to "
        "the last change of any position, unless a line says otherwise. {{name}} is a number or a word that the "
        "operating point has.\n\nFaults are injected by `--fault NAME=VALUE@TIME` of `motionrack run`, `home` and "
        "`frames`, in [Python](../howto/python.md) and [C](c.md), and on the panel: see [wire a "
        "machine](../howto/wire.md#what-if-a-wire-breaks).\n",
        count);
    for (const Group& group : groups) {
        out += fmt::format("\n## {}\n{}\n", group.name, group.about);
        if (!group.setup.is.empty()) out += fmt::format("Run on {}.\n", group.setup.is);
        const bool is_text = group.setup.program.find('\n') != std::string::npos;  // not one placeholder
        if (is_text) out += fmt::format("\n```\n{}```\n\n", group.setup.program);
        if (!group.setup.points.empty()) out += fmt::format("Operating points: {}.\n", points_text(group.setup.points));
        out += "\n| fault | injected | must stop | message | kept |\n|---|---|---|---|---|\n";
        for (const Fault& fault : group.faults) {
            std::string done = what_is_done(fault);
            if (!same_points(fault.setup.points, group.setup.points))
                done += " (" + points_text(fault.setup.points) + ")";
            out += fmt::format("| {} | {} | {} | {} | {} |\n", cell(fault.name), cell(done), cell(what_stops(fault)),
                               cell(what_is_read(fault)), cell(what_is_kept(fault)));
        }
    }
    return out;
}

}  // namespace motionrack::faults
