// Reads a sweep file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/rack/fault_schedule.hpp>
#include <motionrack/sweep/sweep_fields.hpp>
#include <sstream>

namespace motionrack::sweep {

namespace {

using rack::TomlNode;
using rack::TomlType;

bool is_scalar(const TomlNode& node) {
    return node.type == TomlType::text || node.type == TomlType::integer || node.type == TomlType::number ||
           node.type == TomlType::flag;
}
bool is_range(const TomlNode& node) {
    return node.type == TomlType::table &&
           (node.find("from") != nullptr || node.find("to") != nullptr || node.find("steps") != nullptr);
}

bool is_word(std::string_view text) {
    return !text.empty() && text.size() <= 32 && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    });
}

class Reader {
  public:
    Reader(SweepFile& file, rack::Problems& problems) : file_(file), problems_(problems) {}

    void read() {
        static constexpr std::array<std::string_view, 2> sections = {"sweep", "vary"};
        for (const TomlNode& node : file_.root.children) {
            const bool known = std::find(sections.begin(), sections.end(), node.key) != sections.end();
            if (!known) {
                const std::string hint = rack::did_you_mean(node.key, sections);
                problems_.error(node.key_location,
                                fmt::format("A sweep file has no section {}{}", rack::in_quotes(node.key),
                                            hint.empty() ? ": it has sweep, vary." : hint));
            } else if (node.type != TomlType::table) {
                problems_.error(
                    node.value_location,
                    fmt::format("{} is {}, but must be a table; write [{}] on a line of its own and its keys below.",
                                node.key, rack::type_name(node.type), node.key));
            }
        }
        const TomlNode *sweep = file_.root.find("sweep"), *vary = file_.root.find("vary");
        if (sweep == nullptr) problems_.error({1, 1}, "Section [sweep] is missing: it names the program and the rack.");
        if (vary == nullptr)
            problems_.error(
                {1, 1},
                "Section [vary] is missing: it names the varied parameters, such as \"axis.X.max_accel_mm_s2\" = "
                "[500, 1000].");
        if (sweep != nullptr && sweep->type == TomlType::table) read_sweep(*sweep);
        if (vary != nullptr && vary->type == TomlType::table) read_vary(*vary);
    }

  private:
    void read_sweep(const TomlNode& node) {
        SweepSettings& settings = file_.settings;
        const auto refused = rack::read_fields(node, sweep_fields, &settings, {"[sweep]", "", "", {}}, problems_);
        random_ = settings.sampling == Sampling::random;
        if (!refused.empty()) return;
        if (random_ && !settings.points)
            problems_.error(node.location_of("sampling"),
                            "A random sweep needs points = NUMBER: the number of random points.");
        if (!random_ && settings.points)
            problems_.error(node.location_of("points"),
                            "points is the number of random points, but this sweep takes all combinations; write "
                            "sampling = \"random\", or leave points out.");
    }

    void read_vary(const TomlNode& vary) {
        for (const TomlNode& node : vary.children) {
            const std::vector<std::string> path = rack::toml_path(node.key);
            // "axis.X.max_limit_mm" with and without quotes are equivalent.
            if (!path.empty() && rack::toml_name(path) == node.key)
                descend(node, path);
            else
                descend(node, {node.key});
        }
        if (vary.children.empty())
            problems_.error(
                vary.key_location,
                "Nothing is varied; write, for example, \"axis.X.max_accel_mm_s2\" = [500, 1000] below [vary].");
        if (file_.parameters.size() > max_parameters)
            problems_.error(file_.parameters[max_parameters].location,
                            fmt::format("{} parameters are varied; the limit is {}. Leave some out.",
                                        file_.parameters.size(), max_parameters));
        if (problems_.any_errors()) return;
        if (const std::int64_t points = file_.points(); points > max_points)
            problems_.error(vary.key_location,
                            fmt::format("The sweep has {} points; the limit is {}; take fewer steps, or "
                                        "sampling = \"random\" with points.",
                                        points == std::numeric_limits<std::int64_t>::max() ? "far more than 10^18"
                                                                                           : std::to_string(points),
                                        max_points));
    }

    void descend(const TomlNode& node, const std::vector<std::string>& path) {
        if (node.type != TomlType::table || is_range(node)) return add(node, path);
        if (node.children.empty())
            return problems_.error(node.key_location,
                                   fmt::format("{} is an empty table; give a list of values, or from, to and steps.",
                                               rack::toml_name(path)));
        for (const TomlNode& child : node.children) {
            std::vector<std::string> deeper = path;
            deeper.push_back(child.key);
            descend(child, deeper);
        }
    }

    void add(const TomlNode& node, const std::vector<std::string>& path) {
        VariedParameter parameter;
        parameter.name = rack::toml_name(path);
        parameter.path = path;
        parameter.location = node.key_location;
        if (path.size() == 1 && path[0] == "fault") parameter.kind = ParameterKind::fault;
        if (path[0] == "text") parameter.kind = ParameterKind::text;
        for (const VariedParameter& other : file_.parameters)
            if (other.name == parameter.name)
                return problems_.error(node.key_location,
                                       fmt::format("{} is varied twice; leave one out.", parameter.name));
        if (parameter.kind == ParameterKind::text && (path.size() != 2 || !is_word(path[1])))
            return problems_.error(node.key_location,
                                   fmt::format("{} is not a text of the program: write \"text.NAME\" "
                                               "for {{NAME}}, up to 32 letters, digits and '_'.",
                                               rack::in_quotes(parameter.name)));
        if (is_range(node) ? !read_range(node, parameter) : !read_values(node, parameter)) return;
        file_.parameters.push_back(std::move(parameter));
    }

    bool read_values(const TomlNode& node, VariedParameter& parameter) {
        const auto wrong = [&](TextPosition location, std::string_view what) {
            problems_.error(location,
                            fmt::format("{} {}; write a list of values, or {{ from = 1, to = 2, steps = 5 }}.",
                                        parameter.name, what));
            return false;
        };
        if (is_scalar(node))
            parameter.values = {node};
        else if (node.type == TomlType::array)
            parameter.values = node.children;
        else
            return wrong(node.value_location, fmt::format("is {}", rack::type_name(node.type)));
        if (parameter.values.empty()) return wrong(node.value_location, "has no values");
        if (static_cast<std::int64_t>(parameter.values.size()) > max_steps)
            return wrong(node.value_location,
                         fmt::format("has {} values, more than {}", parameter.values.size(), max_steps));
        bool good = true;
        for (const TomlNode& value : parameter.values)
            good = (is_scalar(value) ? check_value(value, parameter)
                                     : wrong(value.value_location,
                                             fmt::format("has {} in its list", rack::type_name(value.type)))) &&
                   good;
        return good;
    }

    bool check_value(const TomlNode& value, const VariedParameter& parameter) {
        const auto refuse = [&](const std::string& what) {
            problems_.error(value.value_location, what);
            return false;
        };
        if (value.type == TomlType::number && !std::isfinite(value.number))
            return refuse(fmt::format("{} has {} in its list, which is not a finite number.", parameter.name,
                                      rack::number_text(value.number)));
        if (parameter.kind == ParameterKind::text && value.type == TomlType::text &&
            (value.text.size() > 1000 || value.text.find_first_of("\r\n") != std::string::npos))
            return refuse(fmt::format("Value {} of {} is invalid: a text must have at most 1000 bytes and no line end.",
                                      rack::in_quotes(value.text), parameter.name));
        if (parameter.kind != ParameterKind::fault) return true;
        if (value.type != TomlType::text)
            return refuse(
                fmt::format("fault has {} in its list, but faults are texts: \"X.limit_plus=0@1.5s\", several of them "
                            "with blanks between; \"\" for none.",
                            rack::type_name(value.type)));
        if (const auto faults = rack::read_faults(words_of(value.text)); !faults) return refuse(faults.error().message);
        return true;
    }

    bool read_range(const TomlNode& node, VariedParameter& parameter) {
        RangeSettings settings;
        TomlNode table = node;
        table.key_location = node.value_location;
        if (!rack::read_fields(table, range_fields, &settings, {parameter.name, "", "", {}}, problems_).empty())
            return false;
        const auto refuse = [&](TextPosition location, const std::string& what) {
            problems_.error(location, what);
            return false;
        };
        if (parameter.kind == ParameterKind::fault)
            return refuse(node.value_location,
                          "'fault' takes no range (from, to); give a list of texts: [\"\", \"X.limit_plus=0@1.5s\"].");
        if (settings.from == settings.to)
            return refuse(node.location_of("to"),
                          fmt::format("from and to of {} are both {}; give two numbers, or a list of one.",
                                      parameter.name, rack::number_text(settings.to)));
        if (!settings.steps && !random_)
            return refuse(node.value_location,
                          fmt::format("{} has no steps: give the number of values from {} to {}.", parameter.name,
                                      rack::number_text(settings.from), rack::number_text(settings.to)));
        const NumberRange range{settings.from, settings.to, settings.integer};
        if (range.integer && (range.from != std::floor(range.from) || range.to != std::floor(range.to)))
            return refuse(node.value_location,
                          fmt::format("{} is an integer, but from and to are {} and {}; they must be whole numbers.",
                                      parameter.name, rack::number_text(range.from), rack::number_text(range.to)));
        if (const double numbers = std::fabs(range.to - range.from) + 1;
            range.integer && settings.steps && static_cast<double>(*settings.steps) > numbers)
            return refuse(node.location_of("steps"),
                          fmt::format("{} has {} steps, but its range has only {} whole numbers.", parameter.name,
                                      *settings.steps, rack::number_text(numbers)));
        if (!settings.steps) {
            parameter.range = range;
            return true;
        }
        for (std::int64_t i = 0; i < *settings.steps; ++i) {
            TomlNode& value = parameter.values.emplace_back();
            value.value_location = node.value_location;
            value.type = TomlType::number;
            const double part = static_cast<double>(i) / static_cast<double>(*settings.steps - 1);
            value.number = i == 0                     ? range.from
                           : i == *settings.steps - 1 ? range.to
                                                      : tidied(range.from + (range.to - range.from) * part, range);
        }
        return true;
    }

    SweepFile& file_;
    rack::Problems& problems_;
    bool random_ = false;
};

}  // namespace

bool VariedParameter::numeric() const {
    return range || std::all_of(values.begin(), values.end(), [](const TomlNode& value) {
               return value.type == TomlType::integer || value.type == TomlType::number;
           });
}

std::int64_t SweepFile::points() const {
    if (settings.sampling == Sampling::random) return settings.points.value_or(0);
    std::int64_t out = 1;
    for (const VariedParameter& parameter : parameters)
        if (__builtin_mul_overflow(out, static_cast<std::int64_t>(parameter.values.size()), &out))
            return std::numeric_limits<std::int64_t>::max();
    return out;
}

double tidied(double value, const NumberRange& range) {
    const double span = std::fabs(range.to - range.from);
    double scale = 1;
    for (double unit = 1; !range.integer && unit > span / 10'000 && scale < 1e15; unit /= 10) scale *= 10;
    const double rounded = std::floor(value * scale + 0.5) / scale;
    return std::clamp(rounded, std::min(range.from, range.to), std::max(range.from, range.to));
}

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream in(text);
    in.exceptions(std::ios::badbit);  // otherwise a failed allocation would look like the end of the text
    std::vector<std::string> out;
    for (std::string word; in >> word;) out.push_back(word);
    return out;
}

std::string value_text(const TomlNode& value) {
    switch (value.type) {
        case TomlType::text:
            return value.text;
        case TomlType::flag:
            return value.flag ? "true" : "false";
        case TomlType::integer:
            return std::to_string(value.integer);
        default:
            return rack::number_text(value.number);
    }
}

SweepFileReading read_sweep_file(std::string_view text, const std::string& name) {
    SweepFileReading out;
    Result<TomlNode> root = rack::parse_toml(text, name);
    if (!root) {
        out.errors.push_back(root.error());
        return out;
    }
    SweepFile file;
    file.root = std::move(*root);
    rack::Problems problems(name);
    Reader(file, problems).read();
    if (!problems.any_errors()) out.file = std::move(file);
    out.errors = problems.take_errors();
    return out;
}

}  // namespace motionrack::sweep
