// One list of fields per struct, used for reading and writing.
#include <limits>
#include <motionrack/trace/report_json.hpp>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

namespace motionrack::trace {

namespace {

using ReportJson = nlohmann::json;

/// Writes fields into an object, or reads them.
class Fields {
  public:
    Fields(ReportJson& json, bool reading) : json_(json), reading_(reading) {}

    template <class T>
    Fields& operator()(const char* name, T& value) {
        if (!reading_) {
            json_[name] = to(value);
        } else if (const auto found = json_.find(name); found != json_.end()) {
            from(*found, value);
        }
        return *this;
    }
    /// Reads a field under its name in earlier recordings.
    template <class T>
    Fields& former(const char* name, T& value) {
        return reading_ ? (*this)(name, value) : *this;
    }

  private:
    // Non-finite values become null.
    ReportJson to(double& value) const { return value - value == 0 ? ReportJson(value) : ReportJson(); }
    ReportJson to(float& value) const {
        return value - value == 0 ? ReportJson(static_cast<double>(value)) : ReportJson();
    }
    ReportJson to(std::string& value) const { return value; }
    ReportJson to(bool& value) const { return value; }
    ReportJson to(int& value) const { return value; }
    ReportJson to(std::int64_t& value) const { return value; }
    template <class T>
    ReportJson to(std::optional<T>& value) const {
        return value ? to(*value) : ReportJson();
    }
    template <class T, std::size_t n>
    ReportJson to(std::array<T, n>& values) const {
        ReportJson out = ReportJson::array();
        for (T& value : values) out.push_back(to(value));
        return out;
    }
    template <class T>
    ReportJson to(std::vector<T>& values) const {
        ReportJson out = ReportJson::array();
        for (T& value : values) out.push_back(to(value));
        return out;
    }
    template <class T>
    ReportJson to(T& value) const {
        ReportJson out = ReportJson::object();
        Fields fields(out, false);
        fields_of(value, fields);
        return out;
    }

    void from(ReportJson& json, double& value) const {
        value = json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
    }
    void from(ReportJson& json, float& value) const {
        value = json.is_null() ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(json.get<double>());
    }
    void from(ReportJson& json, std::string& value) const { value = json.get<std::string>(); }
    void from(ReportJson& json, bool& value) const { value = json.get<bool>(); }
    void from(ReportJson& json, int& value) const { value = json.get<int>(); }
    void from(ReportJson& json, std::int64_t& value) const { value = json.get<std::int64_t>(); }
    template <class T>
    void from(ReportJson& json, std::optional<T>& value) const {
        value.reset();
        if (!json.is_null()) from(json, value.emplace());
    }
    template <class T, std::size_t n>
    void from(ReportJson& json, std::array<T, n>& values) const {
        for (std::size_t i = 0; i < n; ++i) from(json.at(i), values[i]);
    }
    template <class T>
    void from(ReportJson& json, std::vector<T>& values) const {
        if (!json.is_array()) throw std::runtime_error("a list was expected");
        values.clear();
        values.reserve(json.size());
        for (ReportJson& each : json) from(each, values.emplace_back());
    }
    template <class T>
    void from(ReportJson& json, T& value) const {
        Fields fields(json, true);
        fields_of(value, fields);
    }

    ReportJson& json_;
    bool reading_;
};

void fields_of(ReportVerdict& v, Fields& f) {
    f("ok", v.ok)("text", v.text);
}
void fields_of(ReportNumber& v, Fields& f) {
    f("label", v.label)("value", v.value)("unit", v.unit);
}
void fields_of(ReportAxis& v, Fields& f) {
    f("name", v.name)("unit", v.unit)("servo", v.servo)("min_position", v.min_position)("max_position", v.max_position);
    f("max_velocity", v.max_velocity)("max_accel", v.max_accel)("pulses_sent", v.pulses_sent)("pulses_net",
                                                                                              v.pulses_net);
    f("pulse_counter", v.pulse_counter)("encoder_counts", v.encoder_counts)("expected_counts", v.expected_counts)(
        "lost_steps", v.lost_steps);
    f("peak_velocity", v.peak_velocity)("peak_accel", v.peak_accel)("peak_velocity_step", v.peak_velocity_step)(
        "planned_end", v.planned_end)("actual_end", v.actual_end);
}
void fields_of(ReportSegment& v, Fields& f) {
    f("points", v.points)("traverse", v.rapid)("line", v.line);
}
void fields_of(ReportMaxDeviation& v, Fields& f) {
    f("mm", v.mm)("seconds", v.seconds)("line", v.line)("at", v.at);
}
void fields_of(ReportStop& v, Fields& f) {
    f("seconds", v.seconds)("line", v.line)("at", v.at)("text", v.text);
}
void fields_of(ReportMove& v, Fields& f) {
    f("line", v.line)("text", v.text)("kind", v.kind)("length", v.length)("unit", v.unit)("start", v.start)("duration",
                                                                                                            v.duration);
    f("entry_velocity", v.entry_velocity)("peak_velocity", v.peak_velocity)("exit_velocity", v.exit_velocity)(
        "deviation_mm", v.deviation_mm);
}
void fields_of(ReportWarning& v, Fields& f) {
    f("seconds", v.seconds)("line", v.line)("text", v.text);
}
void fields_of(ReportPicture& v, Fields& f) {
    f("title", v.title)("words", v.words)("svg", v.svg)("wide", v.wide);
}
void fields_of(ReportTable& v, Fields& f) {
    f("title", v.title)("caption", v.caption)("heads", v.heads)("rows", v.rows);
}
void fields_of(ReportSeries& v, Fields& f) {
    f("title", v.title)("look", v.style)("values", v.values)("limits_name", v.limits_name)("limits", v.limits);
}
void fields_of(ReportSource& v, Fields& f) {
    f("title", v.title)("text", v.text);
}
void fields_of(ReportData& v, Fields& f) {
    f("title", v.title)("program_kind", v.program_kind)("program_name", v.program_name)("rack_name", v.rack_name)(
        "verdict", v.verdict);
    f("numbers", v.numbers)("axes", v.axes)("tolerance_mm", v.tolerance_mm)("planned", v.planned);
    f.former("worst", v.max_deviation)("max_deviation", v.max_deviation)("stop", v.stop);
    f("moves", v.moves)("warnings", v.warnings)("pictures", v.pictures)("pictures_hint", v.pictures_hint)("tables",
                                                                                                          v.tables);
    f("series", v.series)("source", v.source)("notes", v.notes);
}

}  // namespace

std::string report_json(const ReportData& data) {
    ReportJson json = ReportJson::object();
    Fields fields(json, false);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): the same list reads and writes; nothing is changed here
    fields_of(const_cast<ReportData&>(data), fields);
    return json.dump(-1, ' ', false, ReportJson::error_handler_t::replace);
}

Result<ReportData> report_from_json(std::string_view text) {
    ReportData data;
    try {
        ReportJson json = ReportJson::parse(text);
        Fields fields(json, true);
        fields_of(data, fields);
    } catch (const std::bad_alloc&) {
        throw;  // not an error of the recording
    } catch (const std::exception&) {
        return fail(ErrorKind::invalid_input, "The recording is damaged: its report cannot be read.");
    }
    return data;
}

}  // namespace motionrack::trace
