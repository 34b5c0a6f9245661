// The tables of quantities: of axes, stages, belts and tables, scan heads.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/quantities.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <optional>
#include <span>
#include <utility>

namespace motionrack::rack {

namespace {

/// A row of a part's table.
template <class Part>
struct Row {
    std::string_view name;  ///< "{u}" stands for mm or deg
    std::string_view doc;
    double (*get)(Part& part, Instant now);
    bool whole;
    bool (*present)(const Part& part) = nullptr;  ///< nullptr: always
    /// What brings an axis to `value`, as microsteps to push its motor by; nullptr: it cannot be set.
    double (*push)(Part& part, double value, Instant now) = nullptr;
};
constexpr bool whole = true, measures = false;  // the values are whole, or not

bool has_encoder(const RunningAxis& axis) {
    return axis.machine->has_encoder();
}

double rotor(RunningAxis& axis, Instant now) {
    return static_cast<double>(axis.machine->rotor().count(now));
}

constexpr std::array<Row<RunningAxis>, 13> axis_quantities = {{
    {"position_{u}", "where the table is", [](RunningAxis& axis, Instant now) { return axis.machine->position(now); },
     measures, nullptr,
     [](RunningAxis& axis, double value, Instant now) {
         return (value - axis.machine->position(now)) / axis.machine->units_per_pulse();
     }},
    {"speed_{u}_s", "how fast the rotor moves the table, signed",
     [](RunningAxis& axis, Instant now) { return axis.speed(now); }, measures},
    {"position_pulses", "the rotor in microsteps from where it stood at the start", rotor, whole, nullptr,
     [](RunningAxis& axis, double value, Instant now) { return value - rotor(axis, now); }},
    {"position_counts", "what its encoder's tracks have counted since the start",
     [](RunningAxis& axis, Instant now) { return static_cast<double>(axis.machine->encoder().count(now)); }, whole,
     has_encoder},
    {"pulses", "pulses that came to the motor, + less -",
     [](RunningAxis& axis, Instant now) {
         return rotor(axis, now) + static_cast<double>(axis.machine->lost_steps(now));
     },
     whole},
    {"lost_pulses", "pulses that the rotor did not follow",
     [](RunningAxis& axis, Instant now) { return static_cast<double>(axis.machine->lost_steps(now)); }, whole},
    {"in_step", "1 while the rotor follows the pulses, else 0",
     [](RunningAxis& axis, Instant) { return axis.machine->in_step() ? 1.0 : 0.0; }, whole},
    {"top_speed_{u}_s", "the greatest speed so far",
     [](RunningAxis& axis, Instant) { return axis.machine->top_speed(); }, measures},
    {"limit_minus", "1 while the machine is at that switch, whatever its wire shows",
     [](RunningAxis& axis, Instant) { return axis.machine->limit_minus().active() ? 1.0 : 0.0; }, whole,
     [](const RunningAxis& axis) { return axis.machine->limit_minus().present(); }},
    {"limit_plus", "the same for the switch at the + end",
     [](RunningAxis& axis, Instant) { return axis.machine->limit_plus().active() ? 1.0 : 0.0; }, whole,
     [](const RunningAxis& axis) { return axis.machine->limit_plus().present(); }},
    {"home", "the same for the home switch",
     [](RunningAxis& axis, Instant) { return axis.machine->home().active() ? 1.0 : 0.0; }, whole,
     [](const RunningAxis& axis) { return axis.machine->home().present(); }},
    {"cam", "1 while the machine is on its reference cam",
     [](RunningAxis& axis, Instant now) { return axis.cam->active(now) ? 1.0 : 0.0; }, whole,
     [](const RunningAxis& axis) { return axis.cam != nullptr; }},
    {"drive_v", "the voltage at the servo amplifier", [](RunningAxis& axis, Instant) { return axis.servo->volts(); },
     measures, [](const RunningAxis& axis) { return axis.servo != nullptr; }},
}};

constexpr double mm = 1e-6;  // a nm

/// Somebody closes its loop.
bool has_loop(const RunningStage& stage) {
    return stage.loop() != nullptr;
}

constexpr std::array<Row<RunningStage>, 13> stage_quantities = {{
    {"position_mm", "where the stage is",
     [](RunningStage& stage, Instant now) { return stage.motor->position_nm(now) * mm; }, measures},
    {"speed_mm_s", "its speed, signed", [](RunningStage& stage, Instant now) { return stage.motor->speed(now) * 1e3; },
     measures},
    {"drive_v", "the voltage at its amplifier", [](RunningStage& stage, Instant) { return stage.motor->volts(); },
     measures},
    {"scale_mm", "where its scale shows it",
     [](RunningStage& stage, Instant now) { return stage.config.scale.zero_mm + stage.scale->position_nm(now) * mm; },
     measures},
    {"scale_counts", "what its scale has counted",
     [](RunningStage& stage, Instant now) { return static_cast<double>(stage.scale->count(now)); }, whole},
    {"lost_counts", "counts that its scale has lost",
     [](RunningStage& stage, Instant) { return static_cast<double>(stage.scale->lost()); }, whole},
    {"trusted", "1 while its scale has lost none, else 0",
     [](RunningStage& stage, Instant) { return stage.scale->trusted() ? 1.0 : 0.0; }, whole},
    {"closed", "1 while its loop is closed, else 0",
     [](RunningStage& stage, Instant) { return stage.loop()->closed() ? 1.0 : 0.0; }, whole, has_loop},
    {"following_nm", "wanted - measured at the last frame",
     [](RunningStage& stage, Instant) { return stage.loop()->error().last_nm; }, measures, has_loop},
    {"following_peak_nm", "the greatest of it so far, without its sign",
     [](RunningStage& stage, Instant) { return stage.loop()->error().peak_nm; }, measures, has_loop},
    {"following_rms_nm", "its root mean square so far",
     [](RunningStage& stage, Instant) { return stage.loop()->error().rms_nm(); }, measures, has_loop},
    {"wanted_mm", "where its profile wants it now",
     [](RunningStage& stage, Instant now) { return stage.wanted(to_seconds(now)).position_nm * mm; }, measures,
     has_loop},
    {"unused_frames", "frames that its loop could not use",
     [](RunningStage& stage, Instant) { return static_cast<double>(stage.loop()->unused()); }, whole, has_loop},
}};

bool with_encoder(const RunningTrack& track) {
    return track.encoder != nullptr;
}

constexpr std::string_view track_speed = "speed_{u}_s";
constexpr std::array<Row<RunningTrack>, 6> track_quantities = {{
    {"position_{u}", "how far it has gone since the start",
     [](RunningTrack& track, Instant now) { return track.track().travel(to_seconds(now)); }, measures},
    {track_speed, "how fast it goes, signed",
     [](RunningTrack& track, Instant now) { return track.track().speed(to_seconds(now)); }, measures},
    {"encoder_counts", "what its encoder has shown",
     [](RunningTrack& track, Instant) { return static_cast<double>(track.encoder->count()); }, whole, with_encoder},
    {"lost_counts", "counts that were too quick for the encoder's lines",
     [](RunningTrack& track, Instant) { return static_cast<double>(track.encoder->lost()); }, whole, with_encoder},
    {"word", "the sender's last complete word",
     [](RunningTrack& track, Instant) { return static_cast<double>(track.sender->word()); }, whole,
     [](const RunningTrack& track) { return track.sender != nullptr; }},
    {"parts", "parts that have come to the sensor",
     [](RunningTrack& track, Instant now) { return static_cast<double>(track.sensor->parts(now)); }, whole,
     [](const RunningTrack& track) { return track.sensor != nullptr; }},
}};

constexpr std::array<Row<RunningScanner>, 7> scanner_quantities = {{
    {"spot_x_mm", "where the mirrors point in the field",
     [](RunningScanner& scanner, Instant) { return scanner.station().spot().x; }, measures},
    {"spot_y_mm", "the same, Y", [](RunningScanner& scanner, Instant) { return scanner.station().spot().y; }, measures},
    {"light", "1 while the laser shines, else 0",
     [](RunningScanner& scanner, Instant) { return scanner.station().gate().on() ? 1.0 : 0.0; }, whole},
    {"marked_mm", "length of all marks on the part",
     [](RunningScanner& scanner, Instant) { return scanner.workpiece().length_mm(); }, measures},
    {"energy_j", "energy that came to the part",
     [](RunningScanner& scanner, Instant) { return scanner.workpiece().energy_j(); }, measures},
    {"points", "points of marks that are kept",
     [](RunningScanner& scanner, Instant) { return static_cast<double>(scanner.workpiece().points().size()); }, whole},
    {"lost_points", "points beyond greatest_points",
     [](RunningScanner& scanner, Instant) { return static_cast<double>(scanner.workpiece().lost_points()); }, whole},
}};

// ---- what the kinds of part differ in

std::span<const Row<RunningAxis>> rows_of(const RunningAxis&) {
    return axis_quantities;
}
std::span<const Row<RunningStage>> rows_of(const RunningStage&) {
    return stage_quantities;
}
std::span<const Row<RunningTrack>> rows_of(const RunningTrack&) {
    return track_quantities;
}
std::span<const Row<RunningScanner>> rows_of(const RunningScanner&) {
    return scanner_quantities;
}

std::string name_of(const RunningAxis& axis) {
    return std::string(1, axis.config.letter);
}
template <class Part>
std::string name_of(const Part& part) {
    return part.config.name;
}

std::string_view unit_of(const RunningAxis& axis) {
    return axis.config.unit();
}
std::string_view unit_of(const RunningTrack& track) {
    return track.config.unit();
}
template <class Part>
std::string_view unit_of(const Part&) {
    return {};
}

std::string said_of(const RunningAxis& axis) {
    return "Axis " + name_of(axis);
}
std::string said_of(const RunningStage& stage) {
    return "Stage " + name_of(stage);
}
template <class Part>
std::string said_of(const Part& part) {
    return name_of(part);
}

// ---- going through them

template <class Told>
void each_part(Rack& rack, const Told& told) {
    for (RunningAxis& axis : rack.axes()) told(axis);
    for (RunningStage& stage : rack.stages()) told(stage);
    for (RunningTrack& track : rack.tracks()) told(track);
    for (RunningScanner& scanner : rack.scanners()) told(scanner);
}

/// What this part has, with names in its own unit.
template <class Part, class Told>
void each_quantity(const Part& part, const Told& told) {
    for (const Row<Part>& row : rows_of(part))
        if (row.present == nullptr || row.present(part)) told(with_unit(row.name, unit_of(part)), row);
}

template <class Part>
Result<const Row<Part>*> find_row(const Part& part, std::string_view name) {
    const Row<Part>* found = nullptr;
    std::vector<std::string> known;
    each_quantity(part, [&](std::string its_name, const Row<Part>& row) {
        if (its_name == name) found = &row;
        known.push_back(std::move(its_name));
    });
    if (found != nullptr) return found;
    return fail(Trouble::bad_input, fmt::format("{} has no quantity {}; it has: {}. Nothing was done.", said_of(part),
                                                in_quotes(name), fmt::join(known, ", ")));
}

template <class Part>
Result<double> value_of(Part& part, std::string_view name, Instant now) {
    MOTIONRACK_TRY(const Row<Part>* row, find_row(part, name));
    return row->get(part, now);
}

/// "X.position_mm" apart.
struct Name {
    std::string_view part, quantity;
    bool whole;  ///< it has a dot
    explicit Name(std::string_view text)
        : part(text.substr(0, text.find('.'))),
          quantity(text.substr(std::min(part.size() + 1, text.size()))),
          whole(part.size() < text.size()) {}
};

tl::unexpected<Error> no_such_part(Rack& rack, std::string_view name) {
    std::vector<std::string> parts;
    each_part(rack, [&](const auto& part) { parts.push_back(name_of(part)); });
    return fail(Trouble::bad_input,
                fmt::format("There is no quantity {}: write PART.QUANTITY, such as X.position_mm; the parts of "
                            "this rack are: {}. Nothing was done.",
                            in_quotes(name), parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "))));
}

Result<double> quantity_of_card(const Card& card, std::string_view name) {
    if (const std::optional<double> value = card.quantity(name)) return *value;
    const auto known = card.quantity_names();
    return fail(Trouble::bad_input,
                fmt::format("Card {} has no quantity {}{}. Nothing was done.", card.name(), in_quotes(name),
                            known.empty() ? "" : fmt::format("; it has: {}", fmt::join(known, ", "))));
}

// ---- setting

Result<void> set_track_quantity(Rack& rack, const RunningTrack& track, std::string_view name, double value) {
    const std::string speed = with_unit(track_speed, track.config.unit());
    if (name != speed)
        return fail(Trouble::refused, fmt::format("Of {} only {} can be set, not {}. Nothing was done.",
                                                  track.config.name, speed, in_quotes(name)));
    const double greatest = track.config.greatest_speed();
    if (!(std::fabs(value) <= greatest))
        return fail(Trouble::refused,
                    fmt::format("{}.{} cannot become {}: {:.6g} to {:.6g} are possible. Nothing was done.",
                                track.config.name, speed, value, -greatest, greatest));
    return inject_fault(rack, fmt::format("drive.speed={:.17g}", value), track.config.name);
}

/// `name`: the whole one.
Result<void> push_axis(Rack& rack, RunningAxis& axis, std::string_view name, double value) {
    MOTIONRACK_TRY(const Row<RunningAxis>* row, find_row(axis, Name(name).quantity));
    if (row->push == nullptr)
        return fail(
            Trouble::refused,
            fmt::format("{} follows from the machine and cannot be set; set the position. Nothing was done.", name));
    if (!std::isfinite(value))
        return fail(Trouble::refused,
                    fmt::format("{} cannot become {}: that is no number. Nothing was done.", name, value));
    parts::AxisMachine& machine = *axis.machine;
    const double push = row->push(axis, value, rack.kernel().now());
    if (!(std::fabs(push) <= greatest_push))
        return fail(Trouble::refused,
                    fmt::format("To bring {} to {} the motor must be pushed by {:.0f} microsteps; {:.0f} are the most "
                                "at once. Nothing was done.",
                                name, value, push, greatest_push));
    // A rotor in step springs back unless it is brought past the middle of an electrical cycle.
    const double least =
        machine.in_step() && !axis.servo ? 2.0 * static_cast<double>(machine.settings().motor.microsteps) : 0.5;
    if (std::fabs(push) < least) return {};
    return inject_fault(rack, fmt::format("motor.push={:.0f}", push), name_of(axis));
}

}  // namespace

std::vector<QuantitiesOfPart> quantities_of(Rack& rack) {
    std::vector<QuantitiesOfPart> out;
    each_part(rack, [&](auto& part) {
        QuantitiesOfPart& of = out.emplace_back();
        of.part = name_of(part);
        each_quantity(part, [&](std::string name, const auto& row) {
            of.quantities.push_back(
                {std::move(name), row.doc, row.whole, [&part, get = row.get](Instant now) { return get(part, now); }});
        });
    });
    return out;
}

std::vector<std::pair<std::string_view, std::string_view>> declared_quantities(PartKind kind) {
    std::vector<std::pair<std::string_view, std::string_view>> out;
    const auto add = [&out](const auto& table) {
        for (const auto& row : table) out.emplace_back(row.name, row.doc);
    };
    switch (kind) {
        case PartKind::axis:
            add(axis_quantities);
            break;
        case PartKind::stage:
            add(stage_quantities);
            break;
        case PartKind::track:
            add(track_quantities);
            break;
        case PartKind::scanner:
            add(scanner_quantities);
            break;
    }
    return out;
}

Result<double> get_quantity(Rack& rack, std::string_view part_dot_quantity) {
    const Name name(part_dot_quantity);
    std::optional<Result<double>> out;
    if (const Card* card = rack.card(name.part); card != nullptr && name.whole)
        return quantity_of_card(*card, name.quantity);
    each_part(rack, [&](auto& part) {
        if (!out && name.whole && name_of(part) == name.part) out = value_of(part, name.quantity, rack.kernel().now());
    });
    if (!out) return no_such_part(rack, part_dot_quantity);
    return *std::move(out);
}

Result<void> set_quantity(Rack& rack, std::string_view part_dot_quantity, double value) {
    const Name name(part_dot_quantity);
    if (const RunningTrack* track = rack.track(name.part); track != nullptr && name.whole)
        return set_track_quantity(rack, *track, name.quantity, value);
    for (RunningAxis& axis : rack.axes())
        if (name.whole && name_of(axis) == name.part) return push_axis(rack, axis, part_dot_quantity, value);
    MOTIONRACK_CHECK(get_quantity(rack, part_dot_quantity));  // whatever else there is cannot be set
    return fail(Trouble::refused, fmt::format("{} follows from the machine and cannot be set; of axes the position "
                                              "can, of belts and tables the speed. Nothing was done.",
                                              part_dot_quantity));
}

}  // namespace motionrack::rack
