// Checks a sweep before any run.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/fault_schedule.hpp>
#include <motionrack/rack/job.hpp>
#include <motionrack/sweep/sweep.hpp>
#include <set>
#include <tuple>

namespace motionrack::sweep {

namespace {

using rack::TomlNode;

constexpr std::size_t program_problems = 20;

}  // namespace

class Preparation {
  public:
    Preparation(SweepFile file, const std::string& name, const SweepFiles& files) : problems_(name), files_(files) {
        sweep_.file_ = std::move(file);
        sweep_.rack_name_ = files.rack_name;
        sweep_.program_name_ = files.program_name;
        sweep_.program_ = files.program;
        sweep_.tools_ = files.tools;
    }

    SweepReading run() {
        if (read_rack() && read_tools()) {
            check_paths();
            if (!problems_.any_errors()) check_points();
        }
        SweepReading out;
        out.errors = problems_.take_errors();
        out.errors.insert(out.errors.end(), others_.begin(), others_.end());
        out.warnings = std::move(warnings_);
        if (out.errors.empty()) out.sweep = std::move(sweep_);
        return out;
    }

  private:
    const std::vector<VariedParameter>& parameters() const { return sweep_.file_.parameters; }

    bool read_rack() {
        rack::RackReading reading = rack::read_rack_text(files_.rack, files_.rack_name);
        warnings_ = std::move(reading.warnings);
        others_ = std::move(reading.errors);
        if (!reading.config) return false;
        reading_ = rack::reader_settings(*reading.config, sweep_.file_.settings.block_delete);
        sweep_.rack_ = *rack::parse_toml(files_.rack, files_.rack_name);
        return true;
    }

    bool read_tools() {
        Result<control::gcode::ToolTable> tools = control::gcode::read_tool_table(files_.tools, files_.tools_name);
        if (tools)
            reading_.tools = std::move(*tools);
        else
            others_.push_back(tools.error());
        if (files_.subprogram)
            reading_.subprogram = [this](const std::string& name) -> Result<std::string> {
                Result<std::string> text = files_.subprogram(name);
                if (text) sweep_.subprograms_[name] = *text;
                return text;
            };
        return tools.has_value();
    }

    /// Names that do not fit the rack or the program.
    void check_paths() {
        TomlNode value;
        value.type = rack::TomlType::flag;
        for (const VariedParameter& parameter : parameters()) {
            TomlNode scratch = sweep_.rack_;
            if (parameter.kind == ParameterKind::rack && !rack::put_value(scratch, parameter.path, value))
                problems_.error(
                    parameter.location,
                    fmt::format("{} cannot be varied: it is a table of the rack file, or below a key that is not a "
                                "table. Write the full name of a key, such as axis.X.max_limit_mm.",
                                parameter.name));
            if (parameter.kind == ParameterKind::text &&
                files_.program.find("{" + parameter.path[1] + "}") == std::string::npos)
                problems_.error(parameter.location, fmt::format("{} has no {{{}}}, so the parameter has no effect.",
                                                                files_.program_name, parameter.path[1]));
        }
    }

    void check_points() {
        const std::int64_t points = sweep_.file_.points();
        for (std::int64_t i = 0; i < points && problems_.wants_hints() && others_.empty(); ++i) {
            const std::vector<TomlNode> values = sweep_.values(i);
            check_rack(values);
            check_program(values);
        }
        if (problems_.any_errors() || !others_.empty()) return;
        // Called subprograms are known only after all texts were read.
        for (std::int64_t i = 0; i < points; ++i) sweep_.keys_.push_back(key_of(text_of(sweep_.point(i))));
    }

    // ---- racks

    void check_rack(const std::vector<TomlNode>& values) {
        const std::vector<rack::TomlLine> lines = sweep_.rack_lines(values);
        const std::string text = rack::toml_of(lines);
        std::string faults;
        for (std::size_t p = 0; p < values.size(); ++p)
            if (parameters()[p].kind == ParameterKind::fault) faults = values[p].text;
        const bool new_rack = racks_.insert(key_of(text)).second, new_faults = faults_.count(faults) == 0;
        if (!new_rack && !new_faults) return;
        const rack::RackReading reading = rack::read_rack_text(text, files_.rack_name);
        for (const Error& error : reading.errors) report(error, lines, values);
        if (!reading.config || !new_faults) return;
        faults_.insert(faults);
        check_faults(*reading.config, values);
    }

    void check_faults(const rack::RackConfig& config, const std::vector<TomlNode>& values) {
        for (std::size_t p = 0; p < values.size(); ++p) {
            if (parameters()[p].kind != ParameterKind::fault) continue;
            rack::Rack rack(config);
            for (const std::string& fault : words_of(values[p].text))
                if (const auto plan = rack::FaultSchedule::create(rack, {fault}); !plan)
                    report(values[p].value_location, plan.error().message);
        }
    }

    /// Reports an error of a point's rack at the responsible position of the sweep file.
    void report(const Error& error, const std::vector<rack::TomlLine>& lines, const std::vector<TomlNode>& values) {
        const auto at = static_cast<std::size_t>(error.location.line - 1);
        const std::string name = at < lines.size() ? lines[at].name : std::string();
        std::string with;
        TextPosition location;
        for (std::size_t p = 0; p < values.size(); ++p) {
            const VariedParameter& parameter = parameters()[p];
            if (parameter.kind != ParameterKind::rack) continue;
            if (parameter.name == name)
                return report(static_cast<std::size_t>(error.location.column) <= name.size() ? parameter.location
                                                                                             : values[p].value_location,
                              error.message);
            with += fmt::format("{}{} = {}", with.empty() ? "" : ", ", parameter.name, value_text(values[p]));
            location = parameter.location;
        }
        const std::string line =
            at < lines.size() ? fmt::format(" at {} = {}", lines[at].name, lines[at].value) : std::string();
        report(location, fmt::format("With {} the rack is wrong{}: {}", with, line, error.message));
    }

    void report(TextPosition location, const std::string& message) {
        if (reported_.insert({location.line, location.column, message}).second) problems_.error(location, message);
    }

    // ---- programs

    void check_program(const std::vector<TomlNode>& values) {
        std::string with;
        for (std::size_t p = 0; p < values.size(); ++p)
            if (parameters()[p].kind == ParameterKind::text)
                with +=
                    fmt::format("{}{} = {}", with.empty() ? "" : ", ", parameters()[p].path[1], value_text(values[p]));
        if (!programs_.insert(with).second) return;
        const control::gcode::ProgramCheck check =
            control::gcode::check_program(sweep_.program_text(values), reading_, program_problems, files_.program_name);
        for (const Error& found : check.problems) {
            Error problem = found;
            if (!with.empty()) problem.message += fmt::format(" (with {})", with);
            others_.push_back(std::move(problem));
        }
    }

    Sweep sweep_;
    rack::Problems problems_;
    const SweepFiles& files_;
    control::gcode::Settings reading_;
    std::vector<Error> others_, warnings_;             // of other files
    std::set<std::string> racks_, programs_, faults_;  // already checked
    std::set<std::tuple<int, int, std::string>> reported_;
};

SweepReading prepare(SweepFile file, const std::string& name, const SweepFiles& files) {
    return Preparation(std::move(file), name, files).run();
}

}  // namespace motionrack::sweep
