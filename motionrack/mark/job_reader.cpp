// Reads a marking job, section by section.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/mark/job_check.hpp>
#include <motionrack/mark/job_fields.hpp>

namespace motionrack::mark {

namespace {

using rack::TomlNode;
using rack::TomlType;

bool is_number(const TomlNode& node) {
    return node.type == TomlType::number || node.type == TomlType::integer;
}
double decimal_field(const TomlNode& node) {
    return node.type == TomlType::integer ? static_cast<double>(node.integer) : node.number;
}

/// Reads the key profile = [[0, 50], [0.5, 120]]: pairs of a time in s and a velocity.
void read_profile(const TomlNode& table, BeltSettings& belt, rack::Problems& problems) {
    const TomlNode* profile = table.find("profile");
    if (profile == nullptr) return;
    if (profile->type != TomlType::array || profile->children.empty() || profile->children.size() > 10'000)
        return problems.error(profile->value_location,
                              "'profile' must be an array of 1 to 10000 pairs [seconds, velocity].");
    for (const TomlNode& pair : profile->children) {
        if (pair.type != TomlType::array || pair.children.size() != 2 || !is_number(pair.children[0]) ||
            !is_number(pair.children[1]))
            return problems.error(pair.value_location, "A point of 'profile' must be a pair [seconds, velocity].");
        belt.profile.push_back({decimal_field(pair.children[0]), decimal_field(pair.children[1])});
    }
    if (table.find("velocity_mm_s") != nullptr || table.find("velocity_deg_s") != nullptr)
        problems.error(profile->key_location, "A velocity and a 'profile' are both given; leave one out.");
    if (const auto track = parts::Conveyor::make({.profile = belt.profile}); !track)
        problems.error(profile->value_location, track.error().message);
}

/// Reads a key such as part_positions_mm = [0, 40, 95]: increasing belt distances.
void read_at(const TomlNode& table, std::string_view key, PartsSettings& parts, rack::Problems& problems) {
    const TomlNode* at = table.find(key);
    if (at == nullptr) return;
    const auto wrong = [&](TextPosition location) {
        problems.error(location,
                       fmt::format("'{}' must be an array of 1 to 10000 numbers that rise, from 0 to 1e6.", key));
    };
    if (at->type != TomlType::array || at->children.empty() || at->children.size() > 10'000)
        return wrong(at->value_location);
    for (const TomlNode& node : at->children) {
        const double value = is_number(node) ? decimal_field(node) : -1;
        if (!(value >= 0 && value <= 1e6) || (!parts.at.empty() && value <= parts.at.back()))
            return wrong(node.value_location);
        parts.at.push_back(value);
    }
    for (const char* other : {"count", "spacing_mm", "spacing_deg"})
        if (table.find(other) != nullptr)
            problems.error(table.location_of(other),
                           fmt::format("With '{}' the parts' positions are known; leave '{}' out.", key, other));
}

/// Reads one section into its member of the job.
class SectionReader {
  public:
    SectionReader(MarkingJob& job, std::string unit, rack::Problems& problems)
        : job_(job), unit_(std::move(unit)), problems_(problems) {}

    void read(const TomlNode& node, std::string_view name) {
        const auto* info = std::find_if(fields::sections.begin(), fields::sections.end(),
                                        [&](const fields::SectionInfo& s) { return s.name == name; });
        const std::string array = rack::with_unit(info->array.key, unit_);
        const std::string_view also[] = {array};
        const rack::FormerKey former[] = {{info->array.old_key, info->array.key}};
        const std::size_t arrays = array.empty() ? 0 : 1;
        const rack::Section section{fmt::format("[{}]", name), unit_, "", {also, arrays}, {former, arrays}};
        rack::read_fields(node, info->fields, object(node, name), section, problems_);
        if (name == "belt" || name == "table") read_profile(node, job_.belt, problems_);
        if (name == "parts") read_at(node, array, *job_.parts, problems_);
    }

  private:
    void* object(const TomlNode& node, std::string_view name) {
        if (name == "drawing") return &job_.drawings.emplace_back();
        if (name == "optics") return &job_.optics;
        if (name == "lens") return &job_.lens.emplace();
        if (name == "galvo") return &job_.galvo;
        if (name == "laser") return &job_.laser;
        if (name == "pace") return &job_.pace;
        if (name == "fly") return &job_.fly;
        if (name == "parts") return &job_.parts.emplace();
        if (name == "sender") return &job_.sender;
        job_.belt.rotary = name == "table";
        job_.belt.location = node.key_location;
        return &job_.belt;
    }

    MarkingJob& job_;
    std::string unit_;
    rack::Problems& problems_;
};

}  // namespace

parts::ConveyorSettings MarkingJob::track() const {
    parts::ConveyorSettings out;
    out.rotary = belt.rotary;
    out.direction_deg = belt.direction_deg;
    out.centre_mm = {belt.centre_x_mm, belt.centre_y_mm};
    out.profile = belt.profile.empty() ? std::vector<parts::VelocityPoint>{{0, belt.velocity}} : belt.profile;
    out.counts_per_unit = belt.counts_per_unit;
    out.slip = belt.slip;
    out.jitter_counts = belt.jitter_counts;
    return out;
}

double MarkingJob::sense() const {
    const std::vector<parts::VelocityPoint> profile = track().profile;
    return std::any_of(profile.begin(), profile.end(), [](const parts::VelocityPoint& p) { return p.velocity < 0; })
               ? -1
               : 1;
}

JobRead read_job(std::string_view text, const std::string& file) {
    const Result<TomlNode> root = rack::parse_toml(text, file);
    if (!root) return {std::nullopt, {root.error()}};
    rack::Problems problems(file);
    MarkingJob job;
    job.file = file;
    std::vector<std::string_view> names;
    for (const fields::SectionInfo& section : fields::sections) names.push_back(section.name);
    SectionReader reader(job, root->find("table") != nullptr ? "deg" : "mm", problems);
    for (const TomlNode& node : root->children) {
        const bool known = std::find(names.begin(), names.end(), node.key) != names.end();
        const bool many = node.key == "drawing" && node.type == TomlType::array;
        if (!known || (!many && node.type != TomlType::table)) {
            const std::string hint = rack::did_you_mean(node.key, names);
            problems.error(node.key_location,
                           fmt::format("Unknown section {}{}", rack::in_quotes(node.key), hint.empty() ? "." : hint));
            continue;
        }
        if (!many) reader.read(node, node.key);
        for (const TomlNode& each : many ? node.children : std::vector<TomlNode>{}) {
            if (each.type == TomlType::table)
                reader.read(each, node.key);
            else
                problems.error(each.value_location, "'drawing' must be a section [drawing] or several [[drawing]].");
        }
    }
    if (!problems.any_errors()) check_job(*root, job, problems);
    if (problems.any_errors()) return {std::nullopt, problems.take_errors()};
    return {std::move(job), {}};
}

}  // namespace motionrack::mark
