// Builds belts, tables and scan heads from their settings.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/marking.hpp>

namespace motionrack::rack {

namespace {

constexpr double places_per_unit = 1e5;  // resolution of part positions: 10 nm, or 1/100,000 degree

std::int64_t places(double units) {
    return static_cast<std::int64_t>(std::floor(units * places_per_unit + 0.5));
}

bool begins_with(std::string_view text, std::string_view begin) {
    return text.substr(0, begin.size()) == begin;
}

}  // namespace

parts::ConveyorSettings RackConveyor::settings() const {
    parts::ConveyorSettings out;
    out.rotary = rotary;
    out.direction_deg = direction_deg;
    out.centre_mm = {centre_x_mm, centre_y_mm};
    out.profile = profile;
    if (profile.empty()) out.profile = {{0, velocity}};
    if (has_encoder()) out.counts_per_unit = counts_per_unit;
    out.slip = slip;
    out.deceleration = deceleration;
    return out;
}

double RackConveyor::max_velocity() const {
    double out = parts::max_track_velocity;
    if (has_encoder()) out = std::min(out, max_track_counts / (std::fabs(counts_per_unit) * (1 - slip)));
    if (passing) out = std::min(out, max_parts * passing->part_pitch);
    return out;
}

parts::StationSettings RackScanner::settings() const {
    parts::StationSettings out;
    out.galvo = galvo;
    if (lens) out.lens = lens->lens();
    out.bits_per_mm = bits_per_mm;
    out.laser = laser;
    out.track.profile = {{0, 0}};
    out.workpiece = {tolerance_um * 1e-3, static_cast<std::size_t>(max_points)};
    return out;
}

std::string RunningConveyor::wire_name(std::string_view end) const {
    if (begins_with(end, "enc_")) return fmt::format("{}.encoder.{}", config.name, end.substr(4));
    return fmt::format("{}.{}", config.name, end);
}

RunningConveyor build_track(sim::Kernel& kernel, const RackConveyor& config) {
    RunningConveyor out;
    out.config = config;
    const Result<parts::Conveyor> track = parts::Conveyor::make(config.settings());
    MOTIONRACK_ASSERT(track.has_value());  // checked by read_rack
    out.drive = std::make_unique<parts::ConveyorDrive>(kernel, config.name, *track, config.max_velocity());
    if (config.has_encoder()) {
        out.counts = std::make_unique<parts::ConveyorPosition>(kernel, config.name + ".counts", out.track(),
                                                               config.counts_per_unit * (1 - config.slip));
        out.drive->add(*out.counts);
        parts::LineEncoderSettings lines;
        lines.index = false;
        lines.min_edge_interval = from_seconds(1 / max_track_counts);
        out.encoder = std::make_unique<parts::LineEncoder>(kernel, config.name + ".encoder", *out.counts, lines);
        if (config.jitter_us > 0) out.encoder->fault("jitter", config.jitter_us * 1e-6, Instant{0});
    }
    if (config.sender) {
        const Result<parts::SerialPositionSource> sender =
            parts::SerialPositionSource::make(out.track(), *config.sender);
        MOTIONRACK_ASSERT(sender.has_value());
        out.sender = std::make_unique<parts::SerialWordSource>(kernel, config.name + ".sender", config.name, *sender);
    }
    if (config.passing) {
        out.position =
            std::make_unique<parts::ConveyorPosition>(kernel, config.name + ".place", out.track(), places_per_unit);
        out.drive->add(*out.position);
        const parts::PartSensorSettings sensor{places(config.passing->first_part), places(config.passing->part_pitch),
                                               places(config.passing->length)};
        out.sensor = std::make_unique<parts::PartSensor>(kernel, config.name + ".sensor", config.name + ".sensor_n",
                                                         *out.position, sensor);
    }
    return out;
}

RunningScanner build_scanner(sim::Kernel& kernel, const RackScanner& config, const parts::Conveyor* track) {
    Result<parts::MarkingStation> station = parts::MarkingStation::make(config.settings(), track);
    MOTIONRACK_ASSERT(station.has_value());  // checked by read_rack
    const auto wire = [&](const char* pin) { return kernel.find_wire(config.card + "." + pin); };
    RunningScanner out;
    out.config = config;
    out.head = std::make_unique<parts::ScanHead>(
        kernel, config.name, parts::ScanHeadWires{wire("xout"), wire("yout"), wire("laser_on")}, std::move(*station));
    return out;
}

}  // namespace motionrack::rack
