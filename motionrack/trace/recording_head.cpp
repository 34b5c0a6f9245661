// Head of a recording as JSON and back.
#include <fmt/format.h>

#include <motionrack/trace/recording_parts.hpp>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>

namespace motionrack::trace {

namespace {

using HeadJson = nlohmann::ordered_json;

const char* name_of(SignalKind kind) {
    switch (kind) {
        case SignalKind::steps:
            return "steps";
        case SignalKind::counts:
            return "counts";
        case SignalKind::levels:
            break;
    }
    return "levels";
}

SignalKind kind_of(const std::string& name) {
    if (name == "steps") return SignalKind::steps;
    if (name == "counts") return SignalKind::counts;
    if (name == "levels") return SignalKind::levels;
    throw std::runtime_error("unknown kind");
}

/// Returns a path that cannot leave its group.
std::string path_of(const HeadJson& json) {
    std::string path = json.at("path");
    if (path.empty() || path.front() == '/' || path.find("..") != std::string::npos ||
        path.find('\0') != std::string::npos)
        throw std::runtime_error("no path");
    return path;
}

/// Calls `field(name, member)` for the plain fields, in file order; `head` is read or written.
template <class Head, class Field>
void each_field_of_head(Head& head, Field field) {
    field("version", head.version);
    field("program_name", head.program_name);
    field("rack_name", head.rack_name);
    field("rack_file", head.rack_file);
    field("block_delete", head.block_delete);
    field("stream", head.stream);
    field("tools", head.tools);
    field("subprograms", head.subprograms);
    field("live", head.live);
}
template <class Axis, class Field>
void each_field_of_axis(Axis& axis, Field field) {
    field("name", axis.name);
    field("unit", axis.unit);
    field("servo", axis.servo);
    each_number_of_axis(axis, field);
}

/// Writes fields into an object, or reads them; each is required.
auto into(HeadJson& json) {
    return [&json](const char* name, const auto& value) { json[name] = value; };
}
auto out_of(const HeadJson& json) {
    return [&json](const char* name, auto& value) { value = json.at(name).get<std::decay_t<decltype(value)>>(); };
}

}  // namespace

const char* value_column(SignalKind kind) {
    switch (kind) {
        case SignalKind::steps:
            return "direction";
        case SignalKind::counts:
            return "count";
        case SignalKind::levels:
            break;
    }
    return "value";
}

std::string axis_folder(std::string_view name) {
    std::string out;
    for (const char c : name) out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return out;
}

std::string head_json(const RecordingHead& head) {
    HeadJson json = HeadJson::object();
    each_field_of_head(head, into(json));
    json["sample_period_ticks"] = head.sample_period.count();
    json["inputs"] = HeadJson::array();
    for (const RecordedInput& input : head.inputs)
        json["inputs"].push_back({{"at_ticks", input.at.count()}, {"text", input.text}});
    json["axes"] = HeadJson::array();
    for (const RecordedAxis& axis : head.axes)
        each_field_of_axis(axis, into(json["axes"].emplace_back(HeadJson::object())));
    json["signals"] = HeadJson::array();
    for (const RecordedSignal& signal : head.signals) {
        json["signals"].push_back({{"name", signal.name},
                                   {"path", signal.path},
                                   {"kind", name_of(signal.kind)},
                                   {"unit", signal.unit},
                                   {"initial", signal.initial}});
        if (signal.scale != 1) json["signals"].back()["scale"] = signal.scale;
    }
    return json.dump(-1, ' ', false, HeadJson::error_handler_t::replace);
}

Result<RecordingHead> head_from_json(std::string_view text) {
    RecordingHead head;
    try {
        const HeadJson json = HeadJson::parse(text);
        each_field_of_head(head, out_of(json));
        head.sample_period = Duration{json.at("sample_period_ticks").get<std::int64_t>()};
        for (const HeadJson& input : json.at("inputs"))
            head.inputs.push_back({Instant{input.at("at_ticks").get<std::int64_t>()}, input.at("text")});
        for (const HeadJson& axis : json.at("axes")) {
            each_field_of_axis(head.axes.emplace_back(), out_of(axis));
            if (head.axes.back().name.size() != 1) throw std::runtime_error("no axis");
        }
        for (const HeadJson& signal : json.at("signals"))
            head.signals.push_back({signal.at("name"), path_of(signal), kind_of(signal.at("kind")), signal.at("unit"),
                                    signal.at("initial"), signal.value("scale", 1.0)});
        if (head.axes.size() > 6 || head.sample_period <= Duration{0}) throw std::runtime_error("no head");
    } catch (const std::bad_alloc&) {
        throw;  // not an error of the recording
    } catch (const std::exception&) {
        return fail(ErrorKind::invalid_input, "The recording is damaged: its description of the run cannot be read.");
    }
    return head;
}

}  // namespace motionrack::trace
