// `motionrack new`: writes a machine as a RackConfig key by key, with the description of each key from the table.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/part_sections.hpp>
#include <motionrack/rack/template.hpp>

namespace motionrack::rack {
namespace {

constexpr std::array<TemplateVariant, 5> variants = {{
    {"router", "three linear axes X Y Z and a rotary table A on the card's fourth channel"},
    {"stage", "two linear axes X Y"},
    {"single", "one linear axis X"},
    {"carriage", "a transfer carriage with a servo on a positioning card"},
    {"marking", "a laser scan head over a belt, which marks the parts that pass"},
}};

/// A linear axis with switches 2 mm outside its travel.
RackAxis linear_axis(char letter, char channel, double travel) {
    RackAxis axis = default_axis(letter);
    axis.card = "motion";
    axis.channel = channel;
    axis.max_limit = travel;
    axis.switches.limit_minus = -2;
    axis.switches.limit_plus = travel + 2;
    axis.switches.home = 1;
    return axis;
}

RackConfig router() {
    RackConfig out;
    out.name = "three-axis router with a rotary table";
    out.axes = {linear_axis('X', 'x', 300), linear_axis('Y', 'y', 200), linear_axis('Z', 'z', 80), default_axis('A')};
    RackAxis& z = out.axes[2];
    z.max_velocity = 50;
    z.max_accel = 500;
    z.initial_position = 80;  // the tool is above the work piece
    RackAxis& a = out.axes[3];
    a.card = "motion";
    a.channel = "u";
    a.min_limit = -3600;
    a.max_limit = 3600;
    a.switches.home = 0;
    return out;
}

RackConfig stage() {
    RackConfig out;
    out.name = "two-axis stage";
    out.axes = {linear_axis('X', 'x', 100), linear_axis('Y', 'y', 100)};
    for (RackAxis& axis : out.axes) {
        axis.lead_mm = 1;
        axis.max_velocity = 20;
        axis.max_velocity_step = 0.5;
    }
    return out;
}

RackConfig single() {
    RackConfig out;
    out.name = "one axis";
    out.axes = {linear_axis('X', 'x', 300)};
    return out;
}

RackConfig carriage() {
    RackConfig out;
    out.name = "transfer carriage";
    RackAxis axis = default_axis('X');
    axis.card = "motion";
    axis.lead_mm = 10;
    axis.encoder_counts_per_rev = 1000;
    axis.max_velocity = 500;
    axis.min_limit = -200;
    axis.max_limit = 2900;
    axis.switches.limit_minus = -300;
    axis.switches.limit_plus = 3000;
    axis.switches.cam_from = 126;
    axis.switches.cam_to = 132;
    axis.servo.emplace();
    axis.servo->position_window = 0.25;
    out.axes = {axis};
    return out;
}

/// Writes sections as "key = value  # meaning; range; default", the comments in one column.
class Writer {
  public:
    void section(const std::string& header, std::string_view doc) {
        text_ += fmt::format("\n[{}]  # {}\n", header, doc);
    }

    /// Leaves out keys of other units, and `without`.
    void fields(std::span<const Field> fields, const void* object, const void* defaults, std::string_view unit,
                std::initializer_list<std::string_view> without = {}) {
        for (const Field& field : fields) {
            if (!field.only.empty() && field.only != unit) continue;
            if (std::find(without.begin(), without.end(), field.key) != without.end()) continue;
            const FieldValue value = field.get(object, field);
            const bool absent = std::holds_alternative<std::monostate>(value);
            const std::string key = with_unit(field.key, unit);
            const std::string line =
                absent ? fmt::format("# {} =", key) : fmt::format("{} = {}", key, toml_text(value));
            text_ += fmt::format("{:<38}  # {}; {}; {}\n", line, with_unit(field.doc, unit), range_text(field, unit),
                                 field.required ? "required" : "default " + default_text(field, defaults));
        }
    }

    void line(std::string_view text) { text_.append(text).append("\n"); }
    std::string take() { return std::move(text_); }

  private:
    std::string text_;
};

void write_axis(Writer& out, const RackAxis& axis) {
    const RackAxis defaults = default_axis(axis.letter);
    const std::string_view unit = axis.unit();
    const std::string name = fmt::format("axis.{}", axis.letter);
    out.section(name, axis.kind == AxisKind::linear ? "a linear axis: mm" : "a rotary axis: degrees");
    if (axis.servo) {
        const RackServo servo;
        out.fields(part_fields("axis.NAME"), &axis, &defaults, unit, {"channel", "motor_steps_per_rev", "microsteps"});
        out.section(name + ".servo", "a servo amplifier with a DC motor and tacho in place of a stepping motor");
        out.fields(part_fields("axis.NAME.servo"), &*axis.servo, &servo, unit);
    } else {
        out.fields(part_fields("axis.NAME"), &axis, &defaults, unit);
        out.section(name + ".motor", "the stepping motor; its pulses are microsteps");
        out.fields(part_fields("axis.NAME.motor"), &axis.motor, &defaults.motor, unit);
    }
    out.section(name + ".switches", "machine positions at which they act; an omitted switch does not exist");
    out.fields(part_fields("axis.NAME.switches"), &axis.switches, &defaults.switches, unit);
    out.section(name + ".homing", "how the axis finds its home switch (motionrack home)");
    out.fields(part_fields("axis.NAME.homing"), &axis.homing, &defaults.homing, unit);
}

/// Writes the rack and its card.
void write_head(Writer& out, const RackConfig& config, const std::string& card_name, std::string_view card_type) {
    RackCard card;
    card.type = card_type;
    card.name = card_name;
    card.slot = 0;
    const CardType& type = *find_card_type(card.type);
    out.line("# A rack file: cards, axes, wires. Each comment gives the key's meaning, range, unit and default.");
    const RackConfig defaults;
    const RackCard card_defaults;
    out.section("rack", "the whole machine");
    out.fields(rack_fields(), &config, &defaults, "");
    out.section("card." + card_name, fmt::format("a card, by a name of your choice; {}: {}", type.name, type.doc));
    out.fields(card_fields(), &card, &card_defaults, "");
    RackCard scratch = card_defaults;
    out.fields(type.settings, type.settings_of(card), type.settings_of(scratch), "");
}

/// Writes the rack file. Its only card, motion, is of the first type for which `holds` is true.
std::string write(RackConfig config, bool (*holds)(const CardType& type) = has_channels) {
    const std::string_view card_type = card_types_that(holds).front();
    const CardType& type = *find_card_type(card_type);
    Writer out;
    write_head(out, config, "motion", card_type);
    const RackConfig defaults;
    for (const RackAxis& axis : config.axes) write_axis(out, axis);
    out.section("controller", "how paths are cut where the part program does not say");
    out.fields(controller_fields(), &config.controller, &defaults.controller, "");
    out.section("safety", "safety contacts: the emergency stop and a door");
    out.fields(safety_fields(), &config.safety, &defaults.safety, "");
    out.section("wires", "only what differs from the default rule: input = output that drives it, or \"open\"");
    for (const std::string_view line : type.template_wires) out.line(line);
    return out.take();
}

std::string marking() {
    RackConfig config;
    config.name = "laser over a belt";
    RackConveyor line;
    line.card = "scan";
    RackScanner head;
    head.card = "scan";
    head.conveyor = "line";
    const RackConveyor line_defaults;
    const RackScanner head_defaults;
    const RackParts parts;
    const RackLens lens;
    Writer out;
    write_head(out, config, "scan", card_types_that(drives_scan_heads).front());
    out.section("belt.line",
                "conveyor of the parts, by a name of your choice; [table.NAME] is a rotary table, in degrees");
    out.fields(part_fields("belt.NAME"), &line, &line_defaults, "mm");
    out.line(
        "# profile = [[0, 0], [0.5, 100]]        # instead of the velocity: seconds and velocities, linear between");
    out.section("belt.line.parts", "parts at equal distances before a light barrier, which starts the card; optional");
    out.fields(part_fields("belt.NAME.parts"), &parts, &parts, "mm");
    out.section("scanner.head", "mirrors and laser over the belt, and the part, which stores the marks");
    out.fields(part_fields("scanner.NAME"), &head, &head_defaults, "", {"bits_per_mm"});
    out.section("scanner.head.lens", "the field's optics; optional: without it the field is linear");
    out.fields(lens_keys, &lens, &lens, "");
    out.section("scanner.head.galvo", "the mirrors");
    out.fields(galvo_keys, &head.galvo, &head_defaults.galvo, "");
    out.section("scanner.head.laser", "the laser behind its gate");
    out.fields(laser_keys, &head.laser, &head_defaults.laser, "");
    out.section("wires", "only what differs from the default rule: input = output that drives it, or \"open\"");
    out.line("# \"scan.enc0_a\" = \"line.enc_b\"          # the encoder's lines crossed over: it counts backwards");
    out.line("# \"scan.enc0_b\" = \"line.enc_a\"");
    return out.take();
}

}  // namespace

std::span<const TemplateVariant> template_variants() {
    return variants;
}

Result<std::string> rack_template(std::string_view variant) {
    if (variant == "router") return write(router());
    if (variant == "stage") return write(stage());
    if (variant == "single") return write(single());
    if (variant == "carriage") return write(carriage(), positions_by_itself);
    if (variant == "marking") return marking();
    std::vector<std::string_view> names;
    for (const TemplateVariant& known : variants) names.push_back(known.name);
    const std::string hint = did_you_mean(variant, names);
    return fail(ErrorKind::invalid_input,
                fmt::format("Unknown rack template {}: the templates are {}{} Nothing was written.", in_quotes(variant),
                            fmt::join(names, ", "), hint.empty() ? "." : hint));
}

}  // namespace motionrack::rack
