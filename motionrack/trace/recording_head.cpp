// A recording's head as JSON and back.
#include <fmt/format.h>

#include <motionrack/trace/recording_parts.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace motionrack::trace {

namespace {

using Json = nlohmann::ordered_json;

const char* name_of(SignalKind kind) {
    switch (kind) {
        case SignalKind::steps: return "steps";
        case SignalKind::counts: return "counts";
        case SignalKind::levels: break;
    }
    return "levels";
}

SignalKind kind_of(const std::string& name) {
    if (name == "steps") return SignalKind::steps;
    if (name == "counts") return SignalKind::counts;
    if (name == "levels") return SignalKind::levels;
    throw std::runtime_error("unknown kind");
}

/// A path that cannot lead out of its group.
std::string path_of(const Json& json) {
    const std::string path = json.at("path");
    if (path.empty() || path.front() == '/' || path.find("..") != std::string::npos || path.find('\0') != std::string::npos)
        throw std::runtime_error("no path");
    return path;
}

RecordedAxis axis_of(const Json& json) {
    RecordedAxis axis;
    axis.name = json.at("name");
    if (axis.name.size() != 1) throw std::runtime_error("no axis");
    axis.unit = json.at("unit");
    axis.servo = json.at("servo");
    axis.pulses_per_unit = json.at("pulses_per_unit");
    axis.counts_per_unit = json.at("counts_per_unit");
    axis.origin = json.at("origin");
    axis.min_position = json.at("min_position");
    axis.max_position = json.at("max_position");
    axis.max_speed = json.at("max_speed");
    axis.max_accel = json.at("max_acceleration");
    return axis;
}

}  // namespace

std::string axis_folder(std::string_view name) {
    std::string out;
    for (const char c : name) out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return out;
}

std::string head_json(const RecordingHead& head) {
    Json json = {{"version", head.version}, {"program_name", head.program_name}, {"rack_name", head.rack_name}, {"rack_file", head.rack_file},
                 {"block_delete", head.block_delete}, {"stream", head.stream}, {"tools", head.tools}, {"subprograms", head.subprograms},
                 {"live", head.live}, {"sample_period_ticks", head.sample_period.count()}};
    json["inputs"] = Json::array();
    for (const RecordedInput& input : head.inputs) json["inputs"].push_back({{"at_ticks", input.at.count()}, {"text", input.text}});
    json["axes"] = Json::array();
    for (const RecordedAxis& axis : head.axes)
        json["axes"].push_back({{"name", axis.name}, {"unit", axis.unit}, {"servo", axis.servo}, {"pulses_per_unit", axis.pulses_per_unit},
                                {"counts_per_unit", axis.counts_per_unit}, {"origin", axis.origin}, {"min_position", axis.min_position},
                                {"max_position", axis.max_position}, {"max_speed", axis.max_speed}, {"max_acceleration", axis.max_accel}});
    json["signals"] = Json::array();
    for (const RecordedSignal& signal : head.signals)
        json["signals"].push_back({{"name", signal.name}, {"path", signal.path}, {"kind", name_of(signal.kind)}, {"unit", signal.unit}, {"initial", signal.initial}});
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<RecordingHead> head_from_json(std::string_view text) {
    RecordingHead head;
    try {
        const Json json = Json::parse(text);
        head.version = json.at("version");
        head.program_name = json.at("program_name");
        head.rack_name = json.at("rack_name");
        head.rack_file = json.at("rack_file");
        head.block_delete = json.at("block_delete");
        head.stream = json.at("stream");
        head.tools = json.at("tools");
        head.subprograms = json.at("subprograms").get<std::map<std::string, std::string>>();
        head.live = json.at("live");
        head.sample_period = Duration{json.at("sample_period_ticks").get<std::int64_t>()};
        for (const Json& input : json.at("inputs")) head.inputs.push_back({Instant{input.at("at_ticks").get<std::int64_t>()}, input.at("text")});
        for (const Json& axis : json.at("axes")) head.axes.push_back(axis_of(axis));
        for (const Json& signal : json.at("signals"))
            head.signals.push_back({signal.at("name"), path_of(signal), kind_of(signal.at("kind")), signal.at("unit"), signal.at("initial")});
        if (head.axes.size() > 6 || head.sample_period <= Duration{0}) throw std::runtime_error("no head");
    } catch (const std::exception&) {
        return fail(Trouble::bad_input, "The recording is damaged: what it says of its run cannot be read.");
    }
    return head;
}

}  // namespace motionrack::trace
