// The job file's sections as tables of fields.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/mark/gcode_drawing.hpp>
#include <motionrack/mark/job.hpp>
#include <motionrack/mark/svg.hpp>
#include <motionrack/mark/text.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::mark {

namespace {

using rack::absent_means;
using rack::Field;
using rack::field;
using rack::TomlNode;
using rack::TomlType;
using rack::with_choices;

constexpr std::size_t most_segments = 5'000'000;
constexpr double greatest_mm = 1e5;

constexpr std::array<std::string_view, 2> anchors = {"centre", "origin"};
constexpr std::array<std::string_view, 4> modes = {"off", "encoder", "simulated", "mcbsp"};

constexpr std::array<Field, 10> drawing_fields = {
    absent_means(field<&DrawingSource::svg>("svg", 1, 1000, "", "SVG file"), "one of the three"),
    absent_means(field<&DrawingSource::gcode>("gcode", 1, 1000, "", "part program"), "one of the three"),
    absent_means(field<&DrawingSource::text>("text", 1, 10'000, "", "text in a single-stroke font"), "one of the three"),
    field<&DrawingSource::height_mm>("height_mm", 0.01, 1000, "mm", "height of the text's capitals"),
    absent_means(field<&DrawingSource::width_mm>("width_mm", 0.001, 10'000, "mm", "the drawing is made so wide"), "as it is"),
    field<&DrawingSource::scale>("scale", 1e-6, 1e6, "", "makes the drawing larger"),
    field<&DrawingSource::rotate_deg>("rotate_deg", -3600, 3600, "deg", "turns it, counter-clockwise"),
    field<&DrawingSource::x_mm>("x_mm", -1000, 1000, "mm", "where its anchor is"),
    field<&DrawingSource::y_mm>("y_mm", -1000, 1000, "mm", "where its anchor is"),
    with_choices(field<&DrawingSource::anchor>("anchor", 0, 0, "", "its centre or its own origin"), anchors),
};
constexpr std::array<Field, 3> optics_fields = {
    field<&Optics::bits_per_mm>("bits_per_mm", 1, 1e6, "bits/mm", "without lens and ct5"),
    absent_means(field<&Optics::ct5>("ct5", 1, 1000, "", "correction file of the card"), "made from the lens"),
    field<&Optics::correction>("correction", 0, 1, "", "false: no table in the card"),
};
constexpr std::array<Field, 6> lens_fields = {
    field<&LensData::f1_mm>("f1_mm", 1, 10'000, "mm", "image height for the angle"),
    field<&LensData::f2_mm>("f2_mm", -1e5, 1e5, "mm", "its square"),
    field<&LensData::f3_mm>("f3_mm", -1e5, 1e5, "mm", "its cube"),
    field<&LensData::f4_mm>("f4_mm", -1e5, 1e5, "mm", "its fourth power"),
    field<&LensData::calibration_deg>("calibration_deg", 1, 22, "deg", "mechanical deflection at 96 % of the range"),
    field<&LensData::bits_per_mm>("bits_per_mm", 1, 1e6, "bits/mm", "K"),
};
constexpr std::array<Field, 5> galvo_fields = {
    field<&parts::GalvoSettings::ideal>("ideal", 0, 1, "", "mirrors without lag"),
    field<&parts::GalvoSettings::dead_us>("dead_us", 0, 10'000, "us", "dead time, rounded down to 10 us"),
    field<&parts::GalvoSettings::natural_hz>("natural_hz", 10, 20'000, "Hz", "natural frequency"),
    field<&parts::GalvoSettings::damping>("damping", 0.1, 10, "", "1: no overshoot"),
    field<&parts::GalvoSettings::greatest_speed>("greatest_speed", 1, 1e9, "bits/ms", "speed limit"),
};
constexpr std::array<Field, 3> laser_fields = {
    field<&parts::LaserSettings::power_w>("power_w", 0, 1e5, "W", "mean power while on"),
    field<&parts::LaserSettings::on_delay_us>("on_delay_us", 0, 1e5, "us", "from the gate to the light"),
    field<&parts::LaserSettings::off_delay_us>("off_delay_us", 0, 1e5, "us", "from the gate to the dark"),
};
constexpr std::array<Field, 7> pace_fields = {
    field<&Pace::mark_mm_s>("mark_mm_s", 1e-6, 1e6, "mm/s", "speed of marks"),
    field<&Pace::jump_mm_s>("jump_mm_s", 1e-6, 1e6, "mm/s", "speed of jumps"),
    field<&Pace::jump_delay_us>("jump_delay_us", 0, 1e7, "us", "wait after a jump"),
    field<&Pace::mark_delay_us>("mark_delay_us", 0, 1e7, "us", "wait after a stroke"),
    field<&Pace::polygon_delay_us>("polygon_delay_us", 0, 1e7, "us", "wait at a corner"),
    field<&Pace::laser_on_us>("laser_on_us", -16'384, 32'767, "us", "from the begin of a stroke to the laser"),
    field<&Pace::laser_off_us>("laser_off_us", 0, 32'767, "us", "from the end of a stroke to the laser"),
};
constexpr std::array<Field, 5> belt_fields = {
    field<&Belt::speed>("speed_mm_s", -1e5, 1e5, "mm/s", "speed"),
    field<&Belt::direction_deg>("direction_deg", -3600, 3600, "deg", "where it goes, from +X counter-clockwise"),
    field<&Belt::counts_per_unit>("counts_per_mm", -1e9, 1e9, "", "of its encoder, four a line"),
    field<&Belt::slip>("slip", -0.5, 0.5, "", "of the encoder's wheel"),
    field<&Belt::jitter_counts>("jitter_counts", 0, 1000, "", "noise of a reading"),
};
constexpr std::array<Field, 6> table_fields = {
    field<&Belt::speed>("speed_deg_s", -1e5, 1e5, "deg/s", "speed, counter-clockwise"),
    field<&Belt::centre_x_mm>("centre_x_mm", -1000, 1000, "mm", "centre"),
    field<&Belt::centre_y_mm>("centre_y_mm", -1000, 1000, "mm", "centre"),
    field<&Belt::counts_per_unit>("counts_per_deg", -1e9, 1e9, "", "of its encoder, four a line"),
    field<&Belt::slip>("slip", -0.5, 0.5, "", "of the encoder's wheel"),
    field<&Belt::jitter_counts>("jitter_counts", 0, 1000, "", "noise of a reading"),
};
constexpr std::array<Field, 3> fly_fields = {
    with_choices(field<&FlySettings::mode>("mode", 0, 0, "", "where the card has the movement from"), modes),
    field<&FlySettings::tracking_error_us>("tracking_error_us", 0, 655'350, "us", "lag of the mirrors that the card makes up for"),
    field<&FlySettings::scale_factor>("scale_factor", 0.01, 100, "", "a wrong scale: 1.01 is one percent too much"),
};
constexpr std::array<Field, 3> sender_fields = {
    field<&parts::SenderSettings::bits_per_mm>("bits_per_unit", -1e9, 1e9, "", "resolution, a mm or degree"),
    field<&parts::SenderSettings::period_us>("period_us", 1, 1e6, "us", "between readings"),
    field<&parts::SenderSettings::delay_us>("delay_us", 0, 1e6, "us", "from a reading to its word"),
};
constexpr std::array<std::string_view, 10> sections = {"drawing", "optics", "lens", "galvo", "laser", "pace", "belt", "table", "fly", "sender"};

bool is_number(const TomlNode& node) { return node.type == TomlType::number || node.type == TomlType::integer; }
double number_of(const TomlNode& node) { return node.type == TomlType::integer ? static_cast<double>(node.integer) : node.number; }

/// profile = [[0, 50], [0.5, 120]]: seconds and speeds.
void read_profile(const TomlNode& table, Belt& belt, rack::Problems& problems) {
    const TomlNode* profile = table.find("profile");
    if (profile == nullptr) return;
    if (profile->type != TomlType::array || profile->children.empty() || profile->children.size() > 10'000)
        return problems.error(profile->value_place, "'profile' must be an array of 1 to 10000 pairs [seconds, speed].");
    for (const TomlNode& pair : profile->children) {
        if (pair.type != TomlType::array || pair.children.size() != 2 || !is_number(pair.children[0]) || !is_number(pair.children[1]))
            return problems.error(pair.value_place, "A point of 'profile' must be a pair [seconds, speed].");
        belt.profile.push_back({number_of(pair.children[0]), number_of(pair.children[1])});
    }
    if (table.find("speed_mm_s") != nullptr || table.find("speed_deg_s") != nullptr)
        problems.error(profile->key_place, "A speed and a 'profile' are both given; leave one out.");
    if (const auto track = parts::Track::make({.profile = belt.profile}); !track) problems.error(profile->value_place, track.error().message);
}

/// Numbers that the card counts in steps.
void check_steps(const TomlNode& root, std::string_view section, std::string_view key, double value, double step, rack::Problems& problems) {
    if (value / step == std::floor(value / step)) return;
    problems.error(root.find(section)->place_of(key), fmt::format("'{}' is {} us; the card has steps of {} us.", key, rack::number_text(value), rack::number_text(step)));
}

void check_job(const TomlNode& root, Job& job, rack::Problems& problems) {
    const DrawingSource& d = job.drawing;
    const int sources = (d.svg ? 1 : 0) + (d.gcode ? 1 : 0) + (d.text ? 1 : 0);
    const TomlNode* drawing = root.find("drawing");
    if (sources != 1)
        problems.error(drawing != nullptr ? drawing->key_place : Place{1, 1},
                       fmt::format("A job needs one of svg, gcode and text in [drawing]; there are {}.", sources));
    if (root.find("belt") != nullptr && root.find("table") != nullptr) problems.error(root.find("table")->key_place, "A job has a [belt] or a [table], not both.");
    if (job.belt.counts_per_unit == 0) problems.error(job.belt.place, "An encoder with 0 counts measures nothing.");
    if (job.sender.bits_per_mm == 0) problems.error(root.place_of("sender"), "A sender with 0 bits measures nothing.");
    for (const auto& [key, value] : {std::pair{"jump_delay_us", job.pace.jump_delay_us}, std::pair{"mark_delay_us", job.pace.mark_delay_us},
                                     std::pair{"polygon_delay_us", job.pace.polygon_delay_us}})
        check_steps(root, "pace", key, value, 10, problems);
    for (const auto& [key, value] : {std::pair{"laser_on_us", job.pace.laser_on_us}, std::pair{"laser_off_us", job.pace.laser_off_us}})
        check_steps(root, "pace", key, value, 0.5, problems);
    check_steps(root, "fly", "tracking_error_us", job.fly.tracking_error_us, 10, problems);
    if (job.fly.mode == FlyMode::simulated && job.belt.speed == 0)
        problems.error(root.find("fly")->place_of("mode"), "The simulated encoder needs a constant speed above or below 0 in [belt] or [table]; with a profile take mode encoder.");
    if (job.lens) {
        if (const auto good = sim::check(job.lens->lens()); !good) problems.error(root.place_of("lens"), good.error().message);
        if (root.find("optics") != nullptr && root.find("optics")->find("bits_per_mm") != nullptr)
            problems.error(root.find("optics")->place_of("bits_per_mm"), "With a [lens], bits_per_mm stands there.");
    }
}

Result<void> check_size(const Drawing& drawing, const std::string& file) {
    if (element_count(drawing) > most_elements || segment_count(drawing) > most_segments)
        return fail(Trouble::bad_input, fmt::format("The drawing has more than {} lines and arcs, or more than {} with arcs as lines. Nothing was marked.", most_elements, most_segments),
                    {}, file);
    const auto near = [](Spot p) { return std::fabs(p.x) <= greatest_mm && std::fabs(p.y) <= greatest_mm; };
    for (const Stroke& stroke : drawing.strokes) {
        bool good = near(stroke.from);
        for (const Element& e : stroke.elements) good &= near(e.to) && near(e.centre);
        if (!good)
            return fail(Trouble::bad_input, fmt::format("Some of the drawing, or the centre of an arc, is more than {:g} mm from the field's middle. Nothing was marked; make it smaller.", greatest_mm),
                        {}, file);
    }
    return {};
}

}  // namespace

parts::TrackSettings Job::track() const {
    parts::TrackSettings out;
    out.rotary = belt.rotary;
    out.direction_deg = belt.direction_deg;
    out.centre_mm = {belt.centre_x_mm, belt.centre_y_mm};
    out.profile = belt.profile.empty() ? std::vector<parts::SpeedPoint>{{0, belt.speed}} : belt.profile;
    out.counts_per_unit = belt.counts_per_unit;
    out.slip = belt.slip;
    out.jitter_counts = belt.jitter_counts;
    return out;
}

JobRead read_job(std::string_view text, const std::string& file) {
    const Result<TomlNode> root = rack::parse_toml(text, file);
    if (!root) return {std::nullopt, {root.error()}};
    rack::Problems problems(file);
    Job job;
    job.file = file;
    static constexpr std::array<std::string_view, 1> profile = {"profile"};
    for (const TomlNode& node : root->children) {
        if (node.type != TomlType::table || std::find(sections.begin(), sections.end(), node.key) == sections.end()) {
            problems.error(node.key_place, fmt::format("There is no section {}{}.", rack::in_quotes(node.key), rack::did_you_mean(node.key, sections)));
            continue;
        }
        const auto read = [&](std::span<const Field> fields, void* object, std::span<const std::string_view> also = {}) {
            rack::read_fields(node, fields, object, {"[" + node.key + "]", "", "", also}, problems);
        };
        if (node.key == "drawing") read(drawing_fields, &job.drawing);
        if (node.key == "optics") read(optics_fields, &job.optics);
        if (node.key == "lens") read(lens_fields, &job.lens.emplace());
        if (node.key == "galvo") read(galvo_fields, &job.galvo);
        if (node.key == "laser") read(laser_fields, &job.laser);
        if (node.key == "pace") read(pace_fields, &job.pace);
        if (node.key == "fly") read(fly_fields, &job.fly);
        if (node.key == "sender") read(sender_fields, &job.sender);
        if (node.key == "belt" || node.key == "table") {
            job.belt.rotary = node.key == "table";
            job.belt.place = node.key_place;
            job.belt.rotary ? read(table_fields, &job.belt, profile) : read(belt_fields, &job.belt, profile);
            read_profile(node, job.belt, problems);
        }
    }
    if (!problems.any_errors()) check_job(*root, job, problems);
    if (problems.any_errors()) return {std::nullopt, problems.take_errors()};
    return {std::move(job), {}};
}

Result<Drawing> drawing_of(const Job& job, const Load& load) {
    const DrawingSource& source = job.drawing;
    Drawing drawing;
    if (source.text) {
        auto made = text_drawing(*source.text, source.height_mm);
        if (!made) return fail(made.error().trouble, made.error().message, {}, job.file);
        drawing = std::move(*made);
    } else {
        const std::string& name = source.svg ? *source.svg : *source.gcode;
        MOTIONRACK_TRY(const std::string text, load(name));
        MOTIONRACK_TRY(drawing, source.svg ? read_svg(text, name, source.tolerance_mm) : read_gcode(text, name));
    }
    if (element_count(drawing) == 0) return fail(Trouble::bad_input, "The drawing has no lines. Nothing was marked.", {}, job.file);
    MOTIONRACK_CHECK(check_size(drawing, job.file));
    const Box box = box_of(drawing);
    double scale = source.scale;
    if (source.width_mm) {
        const double wide = box.high.x - box.low.x;
        if (!(wide > 0)) return fail(Trouble::bad_input, "The drawing is 0 mm wide and cannot be made as wide as width_mm. Nothing was marked.", {}, job.file);
        scale *= *source.width_mm / wide;
    }
    if (source.svg && scale > 1) {  // the tolerance is meant on the part
        MOTIONRACK_TRY(const std::string text, load(*source.svg));
        MOTIONRACK_TRY(drawing, read_svg(text, *source.svg, source.tolerance_mm / scale));
    }
    const SinCos turn = sin_cos(source.rotate_deg * (pi / 180));
    const Spot anchor = source.anchor == Anchor::centre ? Spot{(box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2} : Spot{};
    const Affine place = Affine{scale * turn.cos, scale * turn.sin, -scale * turn.sin, scale * turn.cos, source.x_mm, source.y_mm}.after(
        {1, 0, 0, 1, -anchor.x, -anchor.y});
    Drawing out = transformed(drawing, place, source.tolerance_mm);
    MOTIONRACK_CHECK(check_size(out, job.file));
    return out;
}

}  // namespace motionrack::mark
