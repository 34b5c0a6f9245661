// libFuzzer: any bytes as a sweep file. It is rejected with sorted positions in the text or with the file name. A valid
// sweep varies finite numbers between finite limits and has as many values and points as the file states. A short one
// is prepared for a rack and a program: the text of each point reads back as itself.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <motionrack/sweep/sweep.hpp>
#include <set>
#include <tests/fuzz/require.hpp>

namespace {

using namespace motionrack;
using namespace motionrack::sweep;
using fuzz::require;
using rack::TomlNode;
using rack::TomlType;

constexpr std::int64_t max_prepared = 12;  ///< points: each reads a rack

void check_errors(const std::vector<Error>& errors, std::string_view text) {
    const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
    TextPosition before;
    for (const Error& error : errors) {
        require(!error.message.empty() && error.file == "fuzz", "an error has a sentence and the file", error.text());
        require(error.location.line >= 0 && error.location.line <= lines && error.location.column >= 0,
                "the place of an error is in the text", error.text());
        const bool is_behind =
            std::pair(error.location.line, error.location.column) >= std::pair(before.line, before.column);
        require(is_behind || error.location.line == 0, "errors are in the order of their places", error.text());
        before = error.location;
    }
}

/// Returns the node of the file whose key is at that position.
const TomlNode* node_at(const TomlNode& table, TextPosition key) {
    if (table.type != TomlType::table) return nullptr;
    for (const TomlNode& child : table.children) {
        if (child.key_location == key && (child.type != TomlType::table || child.find("from") != nullptr))
            return &child;
        if (const TomlNode* found = node_at(child, key)) return found;
    }
    return nullptr;
}

double number_of(const TomlNode& node) {
    return node.type == TomlType::integer ? static_cast<double>(node.integer) : node.number;
}

void check_range(const VariedParameter& parameter, const TomlNode& node) {
    const TomlNode *from = node.find("from"), *to = node.find("to"), *steps = node.find("steps");
    require(from != nullptr && to != nullptr, "a range has two ends", parameter.name);
    if (steps == nullptr) {
        require(parameter.range && parameter.values.empty(), "a range without steps is drawn from", parameter.name);
        require(parameter.range->from == number_of(*from) && parameter.range->to == number_of(*to),
                "a range ends where the file says", parameter.name);
        return;
    }
    require(!parameter.range && static_cast<std::int64_t>(parameter.values.size()) == steps->integer,
            "a range has as many values as steps", parameter.name);
    require(
        number_of(parameter.values.front()) == number_of(*from) && number_of(parameter.values.back()) == number_of(*to),
        "the values begin and end where the range does", parameter.name);
}

void check_parameter(const SweepFile& file, const VariedParameter& parameter) {
    require(!parameter.name.empty() && !parameter.path.empty(), "what is varied has a name");
    require(parameter.values.empty() == parameter.range.has_value(), "there are values or a range", parameter.name);
    if (parameter.range)
        require(std::isfinite(parameter.range->from) && std::isfinite(parameter.range->to) &&
                    parameter.range->from != parameter.range->to,
                "a range has two finite ends", parameter.name);
    for (const TomlNode& value : parameter.values) {
        require(value.type != TomlType::number || std::isfinite(value.number), "a value is finite", parameter.name);
        require(value.type != TomlType::table && value.type != TomlType::array && value.type != TomlType::date,
                "a value is a text, a number or a flag", parameter.name);
        require(parameter.kind != ParameterKind::fault || value.type == TomlType::text, "faults are texts");
    }
    const TomlNode* node = node_at(*file.root.find("vary"), parameter.location);
    require(node != nullptr, "what is varied stands in the file", parameter.name);
    if (node->type == TomlType::table) return check_range(parameter, *node);
    const std::size_t count = node->type == TomlType::array ? node->children.size() : 1;
    require(!parameter.range && parameter.values.size() == count, "there are as many values as in the file",
            parameter.name);
}

void check_file(const SweepFile& file) {
    require(!file.settings.program.empty() && !file.parameters.empty(), "a sweep has a program and varies something");
    require(file.parameters.size() <= max_parameters, "not too much is varied");
    std::set<std::string> names;
    std::int64_t combinations = 1;
    for (const VariedParameter& parameter : file.parameters) {
        require(names.insert(parameter.name).second, "nothing is varied twice", parameter.name);
        check_parameter(file, parameter);
        if (combinations <= max_points) combinations *= static_cast<std::int64_t>(parameter.values.size());
    }
    const bool is_random = file.settings.sampling == Sampling::random;
    require(is_random == file.settings.points.has_value(), "a random sweep alone says how many points it has");
    require(file.points() == (is_random ? *file.settings.points : combinations),
            "there are as many points as the file says");
    require(file.points() >= 1 && file.points() <= max_points, "there are some points, and not too many");
}

void check_points(const Sweep& sweep) {
    for (std::int64_t i = 0; i < sweep.points(); ++i) {
        require(sweep.values(i).size() == sweep.parameters().size(), "each parameter has a value");
        for (const TomlNode& value : sweep.values(i))
            require(value.type != TomlType::number || std::isfinite(value.number), "a value that is drawn is finite");
        const std::string text = text_of(sweep.point(i));
        require(sweep.key(i) == key_of(text) && sweep.key(i).size() == 32, "a point's key is that of its text");
        const auto read = read_point(text);
        require(read.has_value(), "the text of a point is read", read ? "" : read.error().text());
        require(text_of(*read) == text, "the text of a point reads back as itself", text);
    }
}

void prepare_file(const SweepFile& file) {
    static const SweepFiles files{
        "r.toml",
        "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n",
        "p.ngc",
        "G21 G90\nG1 X{A} F{B}\no<s> call\nM2\n",
        "",
        "",
        [](const std::string&) -> Result<std::string> { return std::string("o<s> sub\nG1 X1\no<s> endsub\n"); }};
    const SweepReading reading = prepare(file, "fuzz", files);
    require(reading.sweep.has_value() == reading.errors.empty(), "a sweep is prepared, or has errors");
    for (const Error& error : reading.errors)
        require(!error.message.empty() && !error.file.empty(), "an error has a sentence and a file", error.text());
    if (!reading.sweep) return;
    require(reading.sweep->points() == file.points(), "a sweep that is prepared has all its points");
    check_points(*reading.sweep);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const SweepFileReading reading = read_sweep_file(text, "fuzz");
    require(reading.file.has_value() == reading.errors.empty(), "there is a sweep, or there are errors");
    check_errors(reading.errors, text);
    if (!reading.file) return 0;
    check_file(*reading.file);
    if (reading.file->points() <= max_prepared) prepare_file(*reading.file);
    return 0;
}
