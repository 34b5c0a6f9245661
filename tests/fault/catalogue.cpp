// Reads the catalogue.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/toml_reader.hpp>
#include <tests/fault/catalogue.hpp>
#include <tests/text_of.hpp>

namespace motionrack::faults {

namespace {

using rack::TomlNode;
using rack::TomlType;

std::string text_in(const TomlNode& node) {
    if (node.type == TomlType::integer) return std::to_string(node.integer);
    if (node.type == TomlType::number) return rack::number_text(node.number);
    return node.text;
}

std::vector<std::string> texts_in(const TomlNode& node) {
    if (node.type != TomlType::array) return {text_in(node)};
    std::vector<std::string> out;
    for (const TomlNode& child : node.children) out.push_back(text_in(child));
    return out;
}

Point point_of(const TomlNode& node) {
    Point out;
    for (const TomlNode& entry : node.children) {
        if (entry.key == "name")
            out.name = entry.text;
        else if (entry.key == "test")
            out.test = entry.text;
        else
            out.values[entry.key] = text_in(entry);
    }
    return out;
}

/// Reads the key if it belongs to a setup.
bool take(Setup& setup, const TomlNode& entry) {
    if (entry.key == "by")
        setup.by = entry.text;
    else if (entry.key == "machine")
        setup.is = entry.text;
    else if (entry.key == "rack")
        setup.rack = entry.text;
    else if (entry.key == "program")
        setup.program = entry.text;
    else if (entry.key == "served")
        setup.served = entry.flag;
    else if (entry.key == "points") {
        setup.points.clear();
        for (const TomlNode& point : entry.children) setup.points.push_back(point_of(point));
    } else {
        return false;
    }
    return true;
}

/// Reads the key if it belongs to a fault.
bool take(Fault& fault, const TomlNode& entry) {
    if (entry.key == "name")
        fault.name = entry.text;
    else if (entry.key == "does")
        fault.does = entry.text;
    else if (entry.key == "inject")
        fault.inject = texts_in(entry);
    else if (entry.key == "before")
        fault.before = entry.text;
    else if (entry.key == "command")
        fault.command = entry.text;
    else if (entry.key == "after")
        fault.after = entry.text;
    else if (entry.key == "stops")
        fault.stops = entry.text;
    else if (entry.key == "within_ms")
        fault.within_ms = entry.type == TomlType::integer ? static_cast<double>(entry.integer) : entry.number;
    else if (entry.key == "says")
        fault.says = texts_in(entry);
    else if (entry.key == "shows")
        fault.shows = texts_in(entry);
    else if (entry.key == "keeps")
        fault.keeps = entry.text;
    else if (entry.key == "positions_valid")
        fault.positions_valid = entry.flag;
    else if (entry.key == "exit")
        fault.exit = static_cast<int>(entry.integer);
    else if (entry.key == "alarms")
        fault.alarms = texts_in(entry);
    else if (entry.key == "state")
        fault.state = entry.text;
    else
        return false;
    return true;
}

Result<Fault> fault_of(const TomlNode& node, const Setup& of_group) {
    Fault out;
    out.setup = of_group;
    for (const TomlNode& entry : node.children)
        if (!take(out, entry) && !take(out.setup, entry))
            return fail(ErrorKind::invalid_input, fmt::format("A fault has no key {}.", rack::in_quotes(entry.key)),
                        entry.key_location);
    for (const std::string* needed : {&out.name, &out.does, &out.stops, &out.keeps})
        if (needed->empty())
            return fail(ErrorKind::invalid_input,
                        fmt::format("The fault {} needs name, does, stops and keeps.", rack::in_quotes(out.name)),
                        node.key_location);
    const auto& points = out.setup.points;
    if (points.size() != 2 || points[0].name == points[1].name || points[0].name.empty() || points[1].name.empty())
        return fail(ErrorKind::invalid_input,
                    fmt::format("The fault {} has {} operating points; it needs two, with names.",
                                rack::in_quotes(out.name), points.size()),
                    node.key_location);
    return out;
}

}  // namespace

std::string Fault::at_point(std::string text, const Point& point) {
    for (const auto& [name, value] : point.values) {
        const std::string place = "{" + name + "}";
        for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + value.size()))
            text.replace(at, place.size(), value);
    }
    return text;
}

bool Fault::is_served() const {
    const bool of_parts = std::all_of(inject.begin(), inject.end(),
                                      [](const std::string& option) { return option.rfind("--fault ", 0) == 0; });
    const bool of_stage = setup.by == "frames" && !alarms_when_served().empty();
    return of_parts && (setup.by == "run" || setup.by == "home" || of_stage);
}

std::string Fault::state_when_served() const {
    if (!state.empty()) return state;
    return within_ms && setup.by != "frames" ? "error stop" : "standstill";
}

std::vector<std::string> Fault::alarms_when_served() const {
    const std::string of_stage = "opened its loop";
    if (!alarms.empty()) return alarms;
    if (setup.by == "frames" && std::find(says.begin(), says.end(), of_stage) != says.end()) return {of_stage};
    if (setup.by == "frames" || exit == 0 || says.empty()) return {};
    return {says.front()};
}

Result<std::vector<Group>> read_catalogue(const std::filesystem::path& file) {
    const std::string text = text_of(file);
    if (text.empty()) return fail(ErrorKind::io, fmt::format("{} cannot be read.", file.string()));
    MOTIONRACK_TRY(const TomlNode all, rack::parse_toml(text, file.string()));
    std::vector<Group> out;
    const TomlNode* groups = all.find("group");
    if (groups == nullptr) return fail(ErrorKind::invalid_input, fmt::format("{} has no [[group]].", file.string()));
    for (const TomlNode& node : groups->children) {
        Group group;
        for (const TomlNode& entry : node.children) {
            if (entry.key == "name")
                group.name = entry.text;
            else if (entry.key == "about")
                group.about = entry.text;
            else if (entry.key != "fault" && !take(group.setup, entry))
                return fail(ErrorKind::invalid_input, fmt::format("A group has no key {}.", rack::in_quotes(entry.key)),
                            entry.key_location, file.string());
        }
        if (const TomlNode* faults = node.find("fault"))
            for (const TomlNode& fault : faults->children) {
                MOTIONRACK_TRY(Fault one, fault_of(fault, group.setup));
                group.faults.push_back(std::move(one));
            }
        out.push_back(std::move(group));
    }
    return out;
}

}  // namespace motionrack::faults
