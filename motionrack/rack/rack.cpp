// Builds cards, parts and wires in one kernel from a rack file's config.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/part_catalogue.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/trace_hash_log.hpp>

namespace motionrack::rack {

Rack::Rack(const RackConfig& config) : config_(config) {
    build_cards();
    for (const RackAxis& axis : config_.axes) build_axis(axis);
    for (const RackConveyor& track : config_.tracks) tracks_.push_back(build_track(kernel_, track));
    join_links();
    if (config_.probe) build_probe();
    for (const RackLamp& lamp : config_.lamps)
        lamps_.push_back({lamp, std::make_unique<parts::SignalLamp>(kernel_, lamp.name, lamp.active_low)});
    build_wires();
    build_stages();
    build_scanners();
    parts_ = make_parts(*this);
    stop_latch_ = std::make_unique<StopLatch>(*this);
    for (const auto& card : cards_) card->host().set_halted_flag(&stop_latch_->halted());
}

Rack::~Rack() {
    if (started_) report_history(kernel_);
}

Card* Rack::card(std::string_view name) {
    for (const auto& card : cards_)
        if (card->name() == name) return card.get();
    return nullptr;
}

RunningStage* Rack::stage(std::string_view name) {
    for (RunningStage& stage : stages_)
        if (stage.config.name == name) return &stage;
    return nullptr;
}

RunningConveyor* Rack::track(std::string_view name) {
    for (RunningConveyor& track : tracks_)
        if (track.config.name == name) return &track;
    return nullptr;
}

RunningScanner* Rack::scanner(std::string_view name) {
    for (RunningScanner& scanner : scanners_)
        if (scanner.config.name == name) return &scanner;
    return nullptr;
}

void Rack::build_cards() {
    for (const RackCard& card : config_.cards) {
        const CardPlugin* plugin = find_card_plugin(card.type);
        MOTIONRACK_ASSERT(plugin != nullptr);  // read_rack knows the same types
        cards_.push_back(plugin->make(kernel_, card, log_, cards_));
    }
    for (const auto& card : cards_) card->complete();
}

namespace {

parts::DcMotorSettings servo_settings(const RackAxis& axis) {
    const RackServo& servo = *axis.servo;
    const double counts = axis.counts_per_unit();
    parts::DcMotorSettings out;
    out.gain = servo.velocity_per_volt * counts;
    out.saturation_velocity = servo.saturation() * counts;
    out.current_limit_accel = servo.current_limit_accel * counts;
    out.coulomb_friction = servo.coulomb_friction * counts;
    out.time_constant_s = servo.time_constant_ms * 1e-3;
    out.dead_band_v = servo.dead_band_v;
    out.load_inertia_ratio = servo.load_inertia_ratio;
    return out;
}

/// Returns the rotor position, in pulses from the start, for that machine position.
std::int64_t rotor_at(const RackAxis& axis, double position) {
    return static_cast<std::int64_t>(std::floor((position - axis.initial_position) * axis.pulses_per_unit() + 0.5));
}

/// Returns the settings of the axis' rotor. The rotor of a servo is its encoder: it follows the servo's position
/// without step loss.
parts::StepperSettings motor_settings(const RackAxis& axis) {
    if (axis.servo) return {axis.encoder_counts_per_rev, 1, 1e12, 1e12};
    return {axis.motor_steps_per_rev, axis.microsteps, axis.motor.start_stop_hz, axis.motor.pull_out_hz};
}

}  // namespace

void Rack::build_axis(const RackAxis& axis) {
    parts::AxisMechanicsSettings settings;
    settings.motor = motor_settings(axis);
    settings.axle.travel_per_rev =
        axis.kind == AxisKind::linear ? parts::linear_travel(axis.lead_mm) : parts::rotary_travel(axis.gear_ratio);
    settings.axle.initial_position = axis.initial_position;
    settings.encoder.counts_per_rev = axis.encoder_counts_per_rev;
    auto set = [&](parts::LimitSwitchSettings& which, const std::optional<double>& position) {
        which.position = position;
        which.hysteresis = axis.switches.hysteresis;
        which.bounce = from_seconds(axis.switches.bounce_ms * 1e-3);
    };
    set(settings.limit_minus, axis.switches.limit_minus);
    set(settings.limit_plus, axis.switches.limit_plus);
    set(settings.home, axis.switches.home);
    const std::string name(1, axis.letter);
    RunningAxis running;
    running.config = axis;
    running.card = card(axis.card)->motion();
    MOTIONRACK_ASSERT(running.card != nullptr);
    running.channel = running.card->channel_number(axis.channel);
    if (axis.servo)
        running.servo =
            std::make_unique<parts::DcMotor>(kernel_, name + ".servo", servo_settings(axis), name + ".drive");
    running.machine = std::make_unique<parts::AxisMechanics>(kernel_, name, settings);
    running.pulse_listeners = std::make_unique<EdgeFanout>(
        [machine = running.machine.get()](sim::EdgeListener* listener) { machine->listen_pulse_edges(listener); });
    running.encoder_listeners =
        std::make_unique<EdgeFanout>([machine = running.machine.get()](sim::EdgeListener* listener) {
            machine->encoder().set_edge_listener(listener);
        });
    axes_.push_back(std::move(running));
}

void Rack::join_links() {
    std::vector<sim::PositionFunction*> pulses(axes_.size(), &still_);
    for (const PulseLink& link : config_.pulse_links)
        pulses[static_cast<std::size_t>(link.axis)] =
            &cards_[static_cast<std::size_t>(link.card)]->motion()->pulses(link.channel);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        RunningAxis& axis = axes_[i];
        axis.machine->connect(axis.servo ? *axis.servo : *pulses[i]);
        const RackSwitches& switches = axis.config.switches;
        if (!switches.has_cam()) continue;
        axis.cam = std::make_unique<parts::ReferenceCam>(
            kernel_, fmt::format("{}.cam", axis.config.letter), axis.machine->rotor(),
            rotor_at(axis.config, *switches.cam_from), rotor_at(axis.config, *switches.cam_to), 0);
    }
    for (const EncoderLink& link : config_.encoder_links) {
        sim::PositionFunction* counts = &axes_[static_cast<std::size_t>(link.axis)].machine->encoder();
        if (link.swapped) {
            mirrored_.push_back(std::make_unique<InvertedPosition>(*counts));
            counts = mirrored_.back().get();
        }
        cards_[static_cast<std::size_t>(link.card)]->motion()->connect_encoder(link.channel, *counts);
    }
    for (const auto& card : cards_)
        if (MotionCard* mover = card->motion();
            mover != nullptr &&
            std::none_of(axes_.begin(), axes_.end(), [&](const RunningAxis& axis) { return axis.card == mover; }))
            mover->connect_ideal_machine();
}

void Rack::build_probe() {
    probe_ = std::make_unique<parts::TouchProbe>(kernel_, "probe");
    for (RunningAxis& axis : axes_) {
        const int index = axis.config.index();
        if (index > 2) continue;
        const std::optional<double> lower = config_.probe->lower(index), upper = config_.probe->upper(index);
        if (!lower && !upper) continue;
        probe_->add_range(axis.machine->rotor(), lower ? rotor_at(axis.config, *lower) : sim::unwatched_below + 1,
                          upper ? rotor_at(axis.config, *upper) : sim::unwatched_above - 1);
    }
}

/// Returns the wire of an end. Pulses of an axis have none: they are links.
sim::WireId Rack::wire_of(const WireEnd& end) {
    if (end.owner != EndOwner::card)
        if (const PartSignals& signals = signals_of(end.owner); signals.wire_of != nullptr)
            return signals.wire_of(*this, end);
    return kernel_.find_wire(config_.end_name(end));
}

void Rack::build_wires() {
    kernel_.add_wire("estop", 1);
    junctions_ = std::make_unique<sim::WireConnections>(kernel_, "wiring");
    for (const RackWire& wire : config_.wires) {
        if (wire.link) continue;
        const sim::WireId from = wire_of(wire.from);
        const sim::WireId to = wire_of(wire.to);
        MOTIONRACK_ASSERT(from != sim::WireId::none && to != sim::WireId::none);
        junctions_->join(from, to, is_contact(wire.to));
    }
    // A contact input without a wire carries no current.
    const sim::WireId no_current = config_.open.empty() ? sim::WireId::none : kernel_.add_wire("no_current", 0);
    for (const WireEnd& input : config_.open)
        if (is_contact(input)) junctions_->join(no_current, wire_of(input), true);
}

namespace {

/// Returns the stage properties of a card's type, which drives stages as read_rack has checked.
const StageDrive& drive_of(const RackConfig& config, const std::string& card) {
    return find_card_type(config.card(card)->type)->stage_drive;
}

}  // namespace

CardProcessor& Rack::processor_of(const std::string& card) {
    for (const auto& [name, processor] : processors_)
        if (name == card) return *processor;
    return *processors_.emplace_back(card, drive_of(config_, card).processor(kernel_, *this->card(card))).second;
}

void Rack::build_stages() {
    for (const RackStage& config : config_.stages) {
        RunningStage stage;
        stage.config = config;
        stage.motor = std::make_unique<parts::LinearStage>(kernel_, config.name, motor_settings(config));
        stage.scale =
            std::make_unique<parts::LinearScale>(kernel_, config.name + ".scale", *stage.motor, scale_settings(config));
        drive_of(config_, config.card).connect_scale(*card(config.card), static_cast<int>(config.input), *stage.scale);
        junctions_->join(kernel_.find_wire(fmt::format("{}.vout{}", config.card, config.output)),
                         stage.motor->drive_wire(), false);
        if (config.servo) {
            stage.processor = &processor_of(config.card);
            stage.processor->add(static_cast<int>(config.output), StageSetup(config), loop_settings(config),
                                 from_seconds(config.servo->control_delay_us * 1e-6), stage.scale->count(Instant{0}));
        }
        stages_.push_back(std::move(stage));
    }
}

void Rack::build_scanners() {
    for (const RackScanner& scanner : config_.scanners)
        scanners_.push_back(
            build_scanner(kernel_, scanner, scanner.conveyor ? &track(*scanner.conveyor)->drive->track() : nullptr));
}

bool Rack::is_contact(const WireEnd& end) const {
    if (end.owner != EndOwner::card) return false;
    for (const CardPin& pin : pins_of(config_.cards[static_cast<std::size_t>(end.index)]))
        if (pin.name == end.pin) return pin.kind == PinKind::contact;
    return false;
}

void Rack::start() {
    kernel_.start();
    started_ = true;
    for (const RunningScanner& scanner : scanners_) scanner.head->begin();
    while (kernel_.run_until(kernel_.now()) == sim::RunEnd::broken) {
    }
}

void Rack::copy_from(Rack& other) {
    kernel_.restore(other.kernel_.snapshot());
    for (std::size_t i = 0; i < cards_.size(); ++i) cards_[i]->copy_from(*other.cards_[i]);
    for (std::size_t i = 0; i < scanners_.size(); ++i) scanners_[i].head->copy_points(*other.scanners_[i].head);
}

Result<control::AxisGroup*> Rack::path_axes(const std::optional<control::Point>& position) {
    if (axes_.empty())
        return fail(ErrorKind::refused,
                    "The rack has no axes, so no program can run on it; add an [axis.X] section to the rack file.");
    if (config_.point_to_point()) return positioning_axes(position);
    for (const RunningAxis& axis : axes_)
        if (axis.card != axes_.front().card)
            return fail(
                ErrorKind::refused,
                fmt::format("Axis {} is on card '{}' and axis {} on card '{}', but a path is followed by the axes of "
                            "one card. Nothing was moved; put them on one card.",
                            axes_.front().config.letter, axes_.front().config.card, axis.config.letter,
                            axis.config.card));
    return axes_.front().card->path_axes(config_, position);
}

namespace {

/// Checks that a card that positions by itself has the axis at `position`; a host may have reset it or written its
/// counter.
Result<void> check_agrees(const RunningAxis& axis, double position) {
    const double units = axis.config.pulses_per_unit();
    const double counted =
        axis.card->counter_origin() + static_cast<double>(axis.card->pulse_counter(axis.channel)) / units;
    constexpr double slack_pulses = 2;
    if (std::fabs(counted - position) * units <= slack_pulses) return {};
    return fail(
        ErrorKind::refused,
        fmt::format("Card {} has axis {} at {:.4f} {}, but it is at {:.4f}: another program wrote to the "
                    "card's counter, or its encoder is not counted. Nothing was moved; home it, or take another rack.",
                    axis.config.card, axis.config.letter, counted, axis.config.unit(), position));
}

}  // namespace

Result<control::AxisGroup*> Rack::positioning_axes(const std::optional<control::Point>& position) {
    std::array<control::Axis*, control::axis_count> axes = {};
    for (const RunningAxis& axis : axes_) {
        control::Axis*& one = axes[static_cast<std::size_t>(axis.config.index())];
        MOTIONRACK_TRY(one, axis.card->axis(config_, axis.config.letter));
        if (!position) continue;
        const double here = (*position)[static_cast<std::size_t>(axis.config.index())];
        if (one->position_valid())
            MOTIONRACK_CHECK(check_agrees(axis, here));
        else
            MOTIONRACK_CHECK(one->set_position(here));
    }
    return &positioning_.emplace(axes, config_.limits(), axes_.front().card->host());
}

void Rack::on_slice(Duration slice, const std::function<void()>& call) {
    std::function<void()> callback;
    if (call)
        callback = [this, call] {
            call();
            stop_latch_->poll();
        };
    for (const auto& card : cards_) card->host().on_slice(slice, callback);
}

void Rack::set_stop_flag(const std::atomic<bool>* stop) {
    for (const auto& card : cards_) card->host().set_stop_flag(stop);
}

control::Point Rack::initial_position() const {
    control::Point out = {};
    for (const RackAxis& axis : config_.axes) out[static_cast<std::size_t>(axis.index())] = axis.initial_position;
    return out;
}

std::string Rack::describe(const sim::Condition& condition) {
    if (condition.device == sim::no_device)
        return fmt::format(
            "{}: at {:.6f} s this wire is part of a loop and did not settle after {} changes; it was left as it was. "
            "Check the section [wires] of the rack file",
            kernel_.wire_name(static_cast<sim::WireId>(condition.a)), to_seconds(condition.at), condition.b);
    for (const auto& part : parts_)
        if (std::optional<std::string> text = part->describe(condition, kernel_)) return *std::move(text);
    return fmt::format("{}: condition {} ({}, {})", kernel_.device_name(condition.device), condition.code, condition.a,
                       condition.b);
}

double accel_reserve_of(Rack& rack) {
    return rack.axes().empty() ? 0 : rack.axes().front().card->accel_reserve();
}

}  // namespace motionrack::rack
