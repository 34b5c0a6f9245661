// Checks constraints between the keys of a job.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/mark/job_check.hpp>
#include <motionrack/mark/stroke_font.hpp>

namespace motionrack::mark {

namespace {

using rack::TomlNode;

/// Reports an error if a value (us) is not a multiple of the card's step (us).
void check_steps(const TomlNode& root, std::string_view section, std::string_view key, double value, double step,
                 rack::Problems& problems) {
    if (value / step == std::floor(value / step)) return;
    problems.error(root.find(section)->location_of(key),
                   fmt::format("'{}' is {} us; the card has steps of {} us.", key, rack::number_text(value),
                               rack::number_text(step)));
}

void check_drawings(const TomlNode& root, const MarkingJob& job, rack::Problems& problems) {
    const TomlNode* node = root.find("drawing");
    if (job.drawings.empty())
        return problems.error(node != nullptr ? node->key_location : TextPosition{1, 1}, "A job needs a [drawing].");
    for (std::size_t i = 0; i < job.drawings.size(); ++i) {
        const TomlNode& table = node->type == rack::TomlType::array ? node->children[i] : *node;
        const DrawingSource& d = job.drawings[i];
        const int sources = (d.svg ? 1 : 0) + (d.gcode ? 1 : 0) + (d.text ? 1 : 0);
        if (sources != 1)
            problems.error(table.key_location,
                           fmt::format("A drawing needs one of svg, gcode and text, but has {}.", sources));
        if (!d.text) continue;
        const PartsSettings parts = job.parts.value_or(PartsSettings{});
        for (const std::int64_t number : {parts.number(0), parts.number(parts.size() - 1)})
            if (const auto text = numbered(*d.text, number); !text) {
                problems.error(table.location_of("text"), text.error().message);
                break;
            }
    }
}

void check_pace(const TomlNode& root, const MarkingJob& job, rack::Problems& problems) {
    for (const auto& [key, value] :
         {std::pair{"jump_delay_us", job.pace.jump_delay_us}, std::pair{"mark_delay_us", job.pace.mark_delay_us},
          std::pair{"polygon_delay_us", job.pace.polygon_delay_us}})
        check_steps(root, "pace", key, value, 10, problems);
    for (const auto& [key, value] :
         {std::pair{"laser_on_us", job.pace.laser_on_us}, std::pair{"laser_off_us", job.pace.laser_off_us}})
        check_steps(root, "pace", key, value, 0.5, problems);
    check_steps(root, "fly", "tracking_error_us", job.fly.tracking_error_us, 10, problems);
}

bool is_stationary(const MarkingJob& job) {
    const auto profile = job.track().profile;
    return std::all_of(profile.begin(), profile.end(), [](const parts::VelocityPoint& p) { return p.velocity == 0; });
}
bool turns_back(const MarkingJob& job) {
    const auto profile = job.track().profile;
    return std::any_of(profile.begin(), profile.end(),
                       [&](const parts::VelocityPoint& p) { return p.velocity * job.sense() < 0; });
}

void check_fly(const TomlNode& root, const MarkingJob& job, rack::Problems& problems) {
    const FlySettings& fly = job.fly;
    const auto wrong = [&](std::string_view key, std::string message) {
        problems.error(root.find("fly")->location_of(key), std::move(message));
    };
    const double simulated = fly.simulated_velocity.value_or(job.belt.profile.empty() ? job.belt.velocity : 0);
    if (fly.mode == FlyMode::simulated && simulated == 0)
        wrong("mode",
              "The simulated encoder needs a constant velocity above or below 0: that of [belt] or [table], or, with a "
              "profile, simulated_velocity in [fly]; or use mode encoder.");
    if (fly.simulated_velocity && fly.mode != FlyMode::simulated)
        wrong(job.belt.rotary ? "simulated_velocity_deg_s" : "simulated_velocity_mm_s",
              "The simulated encoder's velocity is given, but the mode is another one; use mode simulated or leave it "
              "out.");
    if (fly.mode == FlyMode::mcbsp && fly.tracking_error_us != 0)
        wrong("tracking_error_us",
              "The card compensates tracking errors of encoders only, not of a McBSP source; use offset_us, which is "
              "exact at constant velocity.");
    if (fly.wait_mode == WaitMode::none) return;
    const double quarter = job.belt.direction_deg / 90;
    if (job.belt.rotary)
        wrong("wait_mode", "Waits need a belt; on a table mark [parts] one after the other.");
    else if (fly.mode == FlyMode::off)
        wrong("wait_mode", "Waits need a correction that follows the part; choose a mode.");
    else if (is_stationary(job) || turns_back(job))
        wrong("wait_mode", "Waits need a moving belt that never reverses.");
    else if (fly.mode == FlyMode::mcbsp && quarter != std::floor(quarter))
        wrong("wait_mode",
              "The words of a belt that goes neither along X nor Y have two values of 16 bits, and wait_for_mcbsp sees "
              "them only while the correction is on; use mode encoder.");
}

void check_parts(const TomlNode& root, const MarkingJob& job, rack::Problems& problems) {
    if (!job.parts) return;
    const PartsSettings& parts = *job.parts;
    const TomlNode& table = *root.find("parts");
    const std::string unit = job.belt.rotary ? "deg" : "mm";
    const auto location = [&](const char* key) {
        return table.find(key + unit) != nullptr ? table.location_of(key + unit) : table.key_location;
    };
    if (parts.at.empty() && parts.count > 1 && parts.spacing == 0)
        problems.error(location("spacing_"),
                       fmt::format("{} parts need a 'spacing_{}' above 0, or their positions in 'at_{}'.", parts.count,
                                   unit, unit));
    if (job.fly.mode == FlyMode::mcbsp)
        problems.error(table.key_location,
                       "McBSP words have absolute positions, which no command zeroes at a start, so only the first of "
                       "several parts would be correct; use mode encoder, or one part without [parts].");
    if (is_stationary(job) || turns_back(job))
        problems.error(
            table.key_location,
            "Parts need a moving belt or table that never reverses; give [belt] or [table] such a velocity.");
    if (parts.start == PartStart::equidistant && (!parts.at.empty() || parts.track_delay != 0))
        problems.error(table.location_of("start"),
                       fmt::format("Equidistant parts need no sensor: the first begins at once, the others after "
                                   "'spacing_{}'; leave 'part_positions_{}' and 'track_delay_{}' out.",
                                   unit, unit, unit));
}

}  // namespace

void check_job(const TomlNode& root, const MarkingJob& job, rack::Problems& problems) {
    check_drawings(root, job, problems);
    if (root.find("belt") != nullptr && root.find("table") != nullptr)
        problems.error(root.find("table")->key_location, "A job has a [belt] or a [table], not both.");
    if (job.belt.counts_per_unit == 0) problems.error(job.belt.location, "An encoder needs counts other than 0.");
    if (job.sender.bits_per_mm == 0) problems.error(root.location_of("sender"), "A sender needs bits other than 0.");
    check_pace(root, job, problems);
    check_fly(root, job, problems);
    check_parts(root, job, problems);
    if (job.lens) {
        if (const auto good = sim::check(job.lens->lens()); !good)
            problems.error(root.location_of("lens"), good.error().message);
        if (root.find("optics") != nullptr && root.find("optics")->find("bits_per_mm") != nullptr)
            problems.error(root.find("optics")->location_of("bits_per_mm"),
                           "With a [lens], bits_per_mm belongs there.");
    }
}

}  // namespace motionrack::mark
