// The table of quantities of an axis.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/quantities.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

namespace {

bool always(const RunningAxis&) { return true; }
bool has_encoder(const RunningAxis& axis) { return axis.machine->has_encoder(); }

double rotor(RunningAxis& axis, Instant now) { return static_cast<double>(axis.machine->rotor().count(now)); }

constexpr std::array<Quantity, 13> table = {{
    {"position_{u}", "where the table is",
     [](RunningAxis& axis, Instant now) { return axis.machine->position(now); },
     [](RunningAxis& axis, double value, Instant now) {
         return (value - axis.machine->position(now)) / axis.machine->units_per_pulse();
     },
     always},
    {"speed_{u}_s", "how fast the rotor moves the table, signed",
     [](RunningAxis& axis, Instant now) { return axis.speed(now); }, nullptr,
     always},
    {"position_pulses", "the rotor in microsteps from where it stood at the start", rotor,
     [](RunningAxis& axis, double value, Instant now) { return value - rotor(axis, now); }, always},
    {"position_counts", "what its encoder's tracks have counted since the start",
     [](RunningAxis& axis, Instant now) { return static_cast<double>(axis.machine->encoder().count(now)); }, nullptr, has_encoder},
    {"pulses", "pulses that came to the motor, + less -",
     [](RunningAxis& axis, Instant now) { return rotor(axis, now) + static_cast<double>(axis.machine->lost_steps(now)); }, nullptr,
     always},
    {"lost_pulses", "pulses that the rotor did not follow",
     [](RunningAxis& axis, Instant now) { return static_cast<double>(axis.machine->lost_steps(now)); }, nullptr, always},
    {"in_step", "1 while the rotor follows the pulses, else 0",
     [](RunningAxis& axis, Instant) { return axis.machine->in_step() ? 1.0 : 0.0; }, nullptr, always},
    {"top_speed_{u}_s", "the greatest speed so far",
     [](RunningAxis& axis, Instant) { return axis.machine->top_speed(); }, nullptr, always},
    {"limit_minus", "1 while the machine is at that switch, whatever its wire shows",
     [](RunningAxis& axis, Instant) { return axis.machine->limit_minus().active() ? 1.0 : 0.0; }, nullptr,
     [](const RunningAxis& axis) { return axis.machine->limit_minus().present(); }},
    {"limit_plus", "the same for the switch at the + end",
     [](RunningAxis& axis, Instant) { return axis.machine->limit_plus().active() ? 1.0 : 0.0; }, nullptr,
     [](const RunningAxis& axis) { return axis.machine->limit_plus().present(); }},
    {"home", "the same for the home switch",
     [](RunningAxis& axis, Instant) { return axis.machine->home().active() ? 1.0 : 0.0; }, nullptr,
     [](const RunningAxis& axis) { return axis.machine->home().present(); }},
    {"cam", "1 while the machine is on its reference cam",
     [](RunningAxis& axis, Instant now) { return axis.cam->active(now) ? 1.0 : 0.0; }, nullptr,
     [](const RunningAxis& axis) { return axis.cam != nullptr; }},
    {"drive_v", "the voltage at the servo amplifier",
     [](RunningAxis& axis, Instant) { return axis.servo->volts(); }, nullptr,
     [](const RunningAxis& axis) { return axis.servo != nullptr; }},
}};

constexpr double mm = 1e-6;  // a nm

constexpr std::array<StageQuantity, 13> stage_table = {{
    {"position_mm", "where the stage is", [](RunningStage& stage, Instant now) { return stage.motor->position_nm(now) * mm; }, false},
    {"speed_mm_s", "its speed, signed", [](RunningStage& stage, Instant now) { return stage.motor->speed(now) * 1e3; }, false},
    {"drive_v", "the voltage at its amplifier", [](RunningStage& stage, Instant) { return stage.motor->volts(); }, false},
    {"scale_mm", "where its scale shows it", [](RunningStage& stage, Instant now) { return stage.config.scale.zero_mm + stage.scale->position_nm(now) * mm; }, false},
    {"scale_counts", "what its scale has counted", [](RunningStage& stage, Instant now) { return static_cast<double>(stage.scale->count(now)); }, false},
    {"lost_counts", "counts that its scale has lost", [](RunningStage& stage, Instant) { return static_cast<double>(stage.scale->lost()); }, false},
    {"trusted", "1 while its scale has lost none, else 0", [](RunningStage& stage, Instant) { return stage.scale->trusted() ? 1.0 : 0.0; }, false},
    {"closed", "1 while its loop is closed, else 0", [](RunningStage& stage, Instant) { return stage.loop()->closed() ? 1.0 : 0.0; }, true},
    {"following_nm", "wanted - measured at the last frame", [](RunningStage& stage, Instant) { return stage.loop()->error().last_nm; }, true},
    {"following_peak_nm", "the greatest of it so far, without its sign", [](RunningStage& stage, Instant) { return stage.loop()->error().peak_nm; }, true},
    {"following_rms_nm", "its root mean square so far", [](RunningStage& stage, Instant) { return stage.loop()->error().rms_nm(); }, true},
    {"wanted_mm", "where its profile wants it now", [](RunningStage& stage, Instant now) { return stage.wanted(to_seconds(now)).position_nm * mm; }, true},
    {"unused_frames", "frames that its loop could not use", [](RunningStage& stage, Instant) { return static_cast<double>(stage.loop()->unused()); }, true},
}};

bool always_there(const RunningTrack&) { return true; }
bool with_encoder(const RunningTrack& track) { return track.encoder != nullptr; }

constexpr std::string_view track_speed = "speed_{u}_s";
constexpr std::array<TrackQuantity, 6> track_table = {{
    {"position_{u}", "how far it has gone since the start",
     [](RunningTrack& track, Instant now) { return track.track().travel(to_seconds(now)); }, always_there},
    {track_speed, "how fast it goes, signed", [](RunningTrack& track, Instant now) { return track.track().speed(to_seconds(now)); }, always_there},
    {"encoder_counts", "what its encoder has shown", [](RunningTrack& track, Instant) { return static_cast<double>(track.encoder->count()); }, with_encoder},
    {"lost_counts", "counts that were too quick for the encoder's lines",
     [](RunningTrack& track, Instant) { return static_cast<double>(track.encoder->lost()); }, with_encoder},
    {"word", "the sender's last complete word", [](RunningTrack& track, Instant) { return static_cast<double>(track.sender->word()); },
     [](const RunningTrack& track) { return track.sender != nullptr; }},
    {"parts", "parts that have come to the sensor", [](RunningTrack& track, Instant now) { return static_cast<double>(track.sensor->parts(now)); },
     [](const RunningTrack& track) { return track.sensor != nullptr; }},
}};

constexpr std::array<ScannerQuantity, 7> scanner_table = {{
    {"spot_x_mm", "where the mirrors point in the field", [](RunningScanner& scanner) { return scanner.station().spot().x; }},
    {"spot_y_mm", "the same, Y", [](RunningScanner& scanner) { return scanner.station().spot().y; }},
    {"light", "1 while the laser shines, else 0", [](RunningScanner& scanner) { return scanner.station().gate().on() ? 1.0 : 0.0; }},
    {"marked_mm", "length of all marks on the part", [](RunningScanner& scanner) { return scanner.workpiece().length_mm(); }},
    {"energy_j", "energy that came to the part", [](RunningScanner& scanner) { return scanner.workpiece().energy_j(); }},
    {"points", "points of marks that are kept", [](RunningScanner& scanner) { return static_cast<double>(scanner.workpiece().points().size()); }},
    {"lost_points", "points beyond greatest_points", [](RunningScanner& scanner) { return static_cast<double>(scanner.workpiece().lost_points()); }},
}};

tl::unexpected<Error> no_quantity(std::string_view part, std::string_view name, const std::vector<std::string>& known) {
    return fail(Trouble::bad_input, fmt::format("{} has no quantity {}; it has: {}. Nothing was done.", part, in_quotes(name), fmt::join(known, ", ")));
}

Result<double> stage_quantity(RunningStage& stage, std::string_view name, Instant now) {
    std::vector<std::string> known;
    for (const StageQuantity& quantity : stage_table) {
        if (quantity.of_loop && stage.loop() == nullptr) continue;
        if (quantity.name == name) return quantity.get(stage, now);
        known.emplace_back(quantity.name);
    }
    return no_quantity("Stage " + stage.config.name, name, known);
}

Result<double> track_quantity(RunningTrack& track, std::string_view name, Instant now) {
    std::vector<std::string> known;
    for (const TrackQuantity& quantity : track_table) {
        if (!quantity.present(track)) continue;
        known.push_back(with_unit(quantity.name, track.config.unit()));
        if (known.back() == name) return quantity.get(track, now);
    }
    return no_quantity(track.config.name, name, known);
}

Result<double> scanner_quantity(RunningScanner& scanner, std::string_view name) {
    std::vector<std::string> known;
    for (const ScannerQuantity& quantity : scanner_table) {
        if (quantity.name == name) return quantity.get(scanner);
        known.emplace_back(quantity.name);
    }
    return no_quantity(scanner.config.name, name, known);
}

Result<void> set_track_quantity(Rack& rack, const RunningTrack& track, std::string_view name, double value) {
    const std::string speed = with_unit(track_speed, track.config.unit());
    if (name != speed)
        return fail(Trouble::refused, fmt::format("Of {} only {} can be set, not {}. Nothing was done.", track.config.name, speed, in_quotes(name)));
    const double greatest = track.config.greatest_speed();
    if (!(std::fabs(value) <= greatest))
        return fail(Trouble::refused, fmt::format("{}.{} cannot become {}: {:.6g} to {:.6g} are possible. Nothing was done.", track.config.name, speed,
                                                  value, -greatest, greatest));
    return inject_fault(rack, fmt::format("drive.speed={:.17g}", value), track.config.name);
}

struct Found {
    RunningAxis* axis = nullptr;
    const Quantity* quantity = nullptr;
};

Result<Found> find(Rack& rack, std::string_view name) {
    const std::size_t dot = name.find('.');
    const std::string_view part = name.substr(0, dot);
    Found found;
    std::string axes;
    for (RunningAxis& axis : rack.axes()) {
        if (part.size() == 1 && part[0] == axis.config.letter) found.axis = &axis;
        axes += (axes.empty() ? "" : ", ") + std::string(1, axis.config.letter);
    }
    const auto add = [&axes](const auto& parts) {
        for (const auto& each : parts) axes += (axes.empty() ? "" : ", ") + each.config.name;
    };
    add(rack.stages());
    add(rack.tracks());
    add(rack.scanners());
    if (found.axis == nullptr || dot == std::string_view::npos)
        return fail(Trouble::bad_input, fmt::format("There is no quantity {}: write PART.QUANTITY, such as X.position_mm; the parts of "
                                                    "this rack are: {}. Nothing was done.",
                                                    in_quotes(name), axes.empty() ? "none" : axes));
    std::string known;
    for (const Quantity& quantity : table) {
        if (!quantity.present(*found.axis)) continue;
        const std::string its_name = with_unit(quantity.name, found.axis->config.unit());
        if (its_name == name.substr(dot + 1)) found.quantity = &quantity;
        known += (known.empty() ? "" : ", ") + its_name;
    }
    if (found.quantity == nullptr)
        return fail(Trouble::bad_input, fmt::format("Axis {} has no quantity {}; it has: {}. Nothing was done.", part,
                                                    in_quotes(name.substr(dot + 1)), known));
    return found;
}

}  // namespace

std::span<const Quantity> quantities() { return table; }
std::span<const StageQuantity> stage_quantities() { return stage_table; }
std::span<const TrackQuantity> track_quantities() { return track_table; }
std::span<const ScannerQuantity> scanner_quantities() { return scanner_table; }

Result<double> get_quantity(Rack& rack, std::string_view name) {
    const std::size_t dot = std::min(name.find('.'), name.size());
    if (const Card* card = rack.card(name.substr(0, dot)); card != nullptr && dot < name.size()) {
        if (const std::optional<double> value = card->quantity(name.substr(dot + 1))) return *value;
        const auto known = card->quantity_names();
        return fail(Trouble::bad_input,
                    fmt::format("Card {} has no quantity {}{}. Nothing was done.", card->name(), in_quotes(name.substr(dot + 1)),
                                known.empty() ? "" : fmt::format("; it has: {}", fmt::join(known, ", "))));
    }
    if (RunningStage* stage = rack.stage(name.substr(0, dot)); stage != nullptr && dot < name.size())
        return stage_quantity(*stage, name.substr(dot + 1), rack.kernel().now());
    if (RunningTrack* track = rack.track(name.substr(0, dot)); track != nullptr && dot < name.size())
        return track_quantity(*track, name.substr(dot + 1), rack.kernel().now());
    if (RunningScanner* scanner = rack.scanner(name.substr(0, dot)); scanner != nullptr && dot < name.size())
        return scanner_quantity(*scanner, name.substr(dot + 1));
    MOTIONRACK_TRY(const Found found, find(rack, name));
    return found.quantity->get(*found.axis, rack.kernel().now());
}

Result<void> set_quantity(Rack& rack, std::string_view name, double value) {
    const std::size_t dot = std::min(name.find('.'), name.size());
    if (const RunningTrack* track = rack.track(name.substr(0, dot)); track != nullptr && dot < name.size())
        return set_track_quantity(rack, *track, name.substr(dot + 1), value);
    MOTIONRACK_TRY(const Found found, find(rack, name));
    if (found.quantity->push == nullptr)
        return fail(Trouble::refused, fmt::format("{} follows from the machine and cannot be set; set the position. Nothing was done.", name));
    if (!std::isfinite(value))
        return fail(Trouble::refused, fmt::format("{} cannot become {}: that is no number. Nothing was done.", name, value));
    parts::AxisMachine& machine = *found.axis->machine;
    const double push = found.quantity->push(*found.axis, value, rack.kernel().now());
    if (!(std::fabs(push) <= greatest_push))
        return fail(Trouble::refused, fmt::format("To bring {} to {} the motor must be pushed by {:.0f} microsteps; {:.0f} are the most "
                                                  "at once. Nothing was done.",
                                                  name, value, push, greatest_push));
    // A rotor in step springs back unless it is brought past the middle of an electrical cycle.
    const double least = machine.in_step() && !found.axis->servo ? 2.0 * static_cast<double>(machine.settings().motor.microsteps) : 0.5;
    if (std::fabs(push) < least) return {};
    return inject_fault(rack, fmt::format("motor.push={:.0f}", push), std::string(1, found.axis->config.letter));
}

}  // namespace motionrack::rack
