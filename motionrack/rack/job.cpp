// Runs a program and collects its results.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/rack/job.hpp>
#include <motionrack/rack/validity_watch.hpp>
#include <utility>

namespace motionrack::rack {

namespace {

constexpr Duration slice = milliseconds(50);
/// Queue length for jerk-limited trajectories: longer than their look-ahead, so that the plan does not depend on it.
constexpr std::size_t max_jerk_limited_entries = 40'000;

/// Deviation of the pulses allowed beyond the program's tolerance, mm. Ends and chords are on whole pulses, and an arc
/// that the card cannot draw is as close as its chords.
double allowed_deviation(const RackConfig& config) {
    constexpr double pulses = 3.5, rounding_mm = 1e-4;
    if (config.point_to_point()) return 0;
    double max_pulse_mm = 0;
    for (const RackAxis& axis : config.axes)
        if (axis.index() < 3) max_pulse_mm = std::max(max_pulse_mm, 1 / axis.pulses_per_unit());
    return max_pulse_mm > 0 ? pulses * max_pulse_mm + config.controller.arc_tolerance_mm + rounding_mm : 0;
}

/// Delay after which the effect of an immediate stop on a fast motor shows.
constexpr Duration shows_after = milliseconds(20);

double counts_per_pulse(const RackAxis& axis) {
    return static_cast<double>(axis.encoder_counts_per_rev) / static_cast<double>(axis.pulses_per_rev());
}

}  // namespace

std::vector<WatchedAxis> watched_axes(Rack& rack) {
    std::vector<WatchedAxis> watched;
    for (RunningAxis& axis : rack.axes()) {
        WatchedAxis one;
        one.index = axis.config.index();
        one.commanded = &axis.turned_by();
        one.servo = axis.servo.get();
        one.real = &axis.machine->rotor();
        one.pulses_per_unit = axis.config.pulses_per_unit();
        one.origin = axis.config.initial_position;
        one.jump_hz = axis.card->jump_hz(rack.config());
        one.full_step = static_cast<double>(axis.config.microsteps);
        one.accel_hz = axis.config.max_accel * one.pulses_per_unit;
        if (rack.config().point_to_point() || rack.config().positions_alone(axis.config))
            one.start_hz = 0;
        else
            one.start_hz = axis.config.max_velocity_step * one.pulses_per_unit;
        watched.push_back(one);
    }
    return watched;
}

control::gcode::Settings reader_settings(const RackConfig& config, bool block_delete) {
    control::gcode::Settings settings;
    settings.limits = config.limits();
    settings.block_delete = block_delete;
    settings.point_to_point = config.point_to_point();
    settings.probe = config.probe.has_value();
    settings.path_tolerance_mm = config.controller.default_path_tolerance_mm;
    for (const RackAxis& axis : config.axes) {
        const auto i = static_cast<std::size_t>(axis.index());
        settings.start[i] = settings.g28[i] = settings.g30[i] = axis.initial_position;
    }
    return settings;
}

Job::Job(Rack& rack, JobSettings settings) : rack_(rack), settings_(std::move(settings)), reference_(rack) {
    monitor_ =
        std::make_unique<Monitor>(rack_.kernel(), watched_axes(rack_), settings_.sample_period, settings_.max_samples);
    monitor_->on_sample(settings_.on_sample);
    monitor_->set_allowed_deviation(allowed_deviation(rack_.config()));
}

Job::~Job() = default;

void Job::programmed(const control::Move& move, const control::Point& start, JobOutcome& out) {
    monitor_->programmed(move, start);
    if (!rack_.config().point_to_point() && move.path == control::PathControl::continuous)
        out.tolerance_mm = std::max(out.tolerance_mm, move.tolerance_mm);
}

void Job::planned(std::int64_t block, const control::PlannedMove& move) {
    monitor_->planned(block, move);
    if (planned_.size() < max_planned) planned_.push_back(move);
}

void Job::listen(const std::vector<control::MoveStart>& starts) {
    for (const control::MoveStart& start : starts) line_ = start.line;
    monitor_->started(starts);
    monitor_->drain();
    if (settings_.commands != nullptr) {
        settings_.commands->apply_due();
        if (rack_.stop_latch().halted()) settings_.commands->halt();
    }
    if (settings_.on_slice) settings_.on_slice();
    if (settings_.progress) settings_.progress({to_seconds(rack_.kernel().now() - began_), line_, lines_});
}

Result<void> Job::drive(control::AxisGroup& axes, JobOutcome& out) {
    control::ExecutorSettings settings;
    settings.gcode = settings_.reading ? *settings_.reading : reader_settings(rack_.config());
    settings.gcode.start = start_;
    settings.accel_reserve = accel_reserve_of(rack_);
    settings.jerk_limited = rack_.config().jerk_limited();
    if (settings_.commands != nullptr && settings_.commands->needs_stream())
        return drive_by_stream(axes, settings, out);
    settings.stop = settings_.commands != nullptr ? settings_.commands->stop_flag() : settings_.stop;
    settings.halted = &rack_.stop_latch().halted();
    rack_.set_stop_flag(settings.stop);
    rack_.on_slice(slice, [&] { listen(axes.take_move_starts()); });
    control::ProgramExecutor controller(axes, settings);
    controller.on_move([&](const control::Move& move, const control::Point& start) { programmed(move, start, out); });
    controller.on_planned_move([&](std::int64_t block, const control::PlannedMove& move) { planned(block, move); });
    monitor_->begin();
    const Result<void> ended = controller.run(settings_.program, settings_.program_name, out.run);
    out.time = rack_.kernel().now() - began_;
    listen(axes.take_move_starts());
    return ended;
}

Result<void> Job::drive_by_stream(control::AxisGroup& axes, const control::ExecutorSettings& settings,
                                  JobOutcome& out) {
    PathObserver watch(axes, [&](std::int64_t block, const control::PlannedMove& move) {
        out.run.plan.add(move);
        planned(block, move);
    });
    control::StreamExecutorSettings stream_settings;
    stream_settings.gcode = settings.gcode;
    stream_settings.accel_reserve = settings.accel_reserve;
    stream_settings.jerk_limited = settings.jerk_limited;
    if (settings.jerk_limited) stream_settings.max_entries = max_jerk_limited_entries;
    Interrupt& host = rack_.axes().front().card->host();
    control::StreamExecutor stream(watch, host, stream_settings);
    rack_.set_stop_flag(stream.stop_flag());
    rack_.on_slice(slice, [&] { listen(watch.observed()); });
    settings_.commands->attach(&stream);
    monitor_->begin();
    const OnProgrammedMove on_move = [&](const control::Move& move, const control::Point& start) {
        programmed(move, start, out);
    };
    const Result<void> ended = drive_live(stream, watch, host, *settings_.commands, settings_.program, settings.gcode,
                                          settings_.program_name, out.run, on_move);
    out.time = rack_.kernel().now() - began_;
    listen(watch.observed());
    settings_.commands->attach(nullptr);
    rack_.set_stop_flag(nullptr);
    rack_.on_slice(slice, [this] { listen({}); });  // after a stop by the machine the run continues without the path
    return ended;
}

void Job::give(std::string_view program, std::string name, control::gcode::Settings reading) {
    settings_.program = program;
    settings_.program_name = std::move(name);
    settings_.reading = std::move(reading);
}

Result<control::Point> Job::start() const {
    MOTIONRACK_CHECK(reference_.check());
    return reference_.position();
}

/// Discards the data of the previous program.
void Job::restart() {
    planned_.clear();
    line_ = 0;
    start_ = reference_.position();
    given_ = rack_.kernel().now();
    std::vector<WatchedAxis> watched = watched_axes(rack_);
    for (std::size_t i = 0; i < watched.size(); ++i) {
        watched[i].origin = reference_.real_origin(i);
        watched[i].commanded_beyond = reference_.commanded_origin(i) - watched[i].origin;
    }
    monitor_->restart(std::move(watched));
}

/// Stores the counters at the start of the program. Call after the card's setup, which sets them.
void Job::note_before() {
    segments_before_ = rack_.axes().front().card->segments();
    before_.clear();
    for (const RunningAxis& axis : rack_.axes())
        before_.push_back({axis.card->pulses_made(axis.channel), axis.turned_by().count(rack_.kernel().now()),
                           axis.card->pulse_counter(axis.channel), axis.card->encoder_counter(axis.channel)});
}

JobOutcome Job::run() {
    JobOutcome out;
    restart();
    const Result<control::AxisGroup*> axes = rack_.path_axes(start_);
    if (!axes) {
        out.ended = tl::unexpected<Error>(axes.error());
        return out;
    }
    note_before();
    ValidityWatch validity(rack_);
    reference_.begin(validity);
    lines_ = 1 + std::count(settings_.program.begin(), settings_.program.end(), '\n');
    began_ = rack_.kernel().now();
    const std::uint64_t events_before = rack_.kernel().events();
    rack_.stop_latch().arm();
    out.ended = drive(**axes, out);
    report_stop(out);
    if (!out.ended && out.ended.error().kind == ErrorKind::machine) {
        out.ended.error().file = settings_.program_name;
        rack_.axes().front().card->host().pass(shows_after);
    }
    monitor_->finish();
    rack_.on_slice(slice, {});

    out.path_mm = out.run.plan.path_mm;
    out.max_deviation = monitor_->max_deviation();
    out.chip_segments = rack_.axes().front().card->segments() - segments_before_;
    out.events = rack_.kernel().events() - events_before;
    out.trace_hash = rack_.kernel().trace_hash();
    const std::vector<DrivenOtherwise> others = take_path_warnings(**axes, out);
    collect_conditions(out);
    collect_breaches(out);
    report_other_motion(others, out);
    judge_positions(validity, out);
    out.axes = axis_outcomes((*axes)->commanded_position());
    for (const AxisOutcome& axis : out.axes) {
        if (!axis.servo) continue;
        const double off = std::fabs(axis.actual_end - axis.planned_end);
        if (out.rest_axis < 0 || off > out.rest_off) out.rest_off = off, out.rest_axis = axis.index;
    }
    rack_.stop_latch().disarm();
    return out;
}

/// Invalidates the positions of axes that lost them; the next program does not start until these axes are homed.
void Job::judge_positions(ValidityWatch& validity, JobOutcome& out) {
    for (ValidityFinding& found : validity.poll(true)) {
        if (found.axis == ValidityFinding::no_axis) continue;  // reported with the conditions
        if (found.lost) {
            out.position_valid = false;
            reference_.lose(found.axis, std::move(found.text));
        } else {
            out.warnings.push_back({found.at, 0, std::move(found.text)});
        }
    }
    const StopLatch& latch = rack_.stop_latch();
    for (std::size_t i = 0; i < rack_.axes().size(); ++i) {
        if (latch.keeps_position(rack_.axes()[i].config.index())) continue;
        out.position_valid = false;
        reference_.lose(i, "steps may have been lost in a stop");
    }
}

HomingOutcome Job::home(const HomingSettings& settings) {
    const auto number = [this](char letter) {
        std::size_t i = 0;
        while (rack_.axes()[i].config.letter != letter) ++i;
        return i;
    };
    std::vector<ValidityWatch::Mark> found(rack_.axes().size());
    const ValidityWatch watch(rack_);
    HomingSettings observed = settings;
    observed.on_homed = [&](char letter, Instant since) {
        found[number(letter)] = {since, watch.mark(number(letter)).lost_pulses};
        if (settings.on_homed) settings.on_homed(letter, since);
    };
    HomingOutcome out = home_axes(rack_, observed);
    for (const HomedAxis& axis : out.axes) {
        const std::size_t i = number(axis.letter);
        if (axis.begun && axis.outcome.homed)
            reference_.set(i, axis.counter_position, found[i]);
        else if (axis.begun)
            reference_.lose(i, "its homing did not end at home");
    }
    return out;
}

/// If the axes report only a stop request, adds the reason from the latch.
void Job::report_stop(JobOutcome& out) {
    StopLatch& latch = rack_.stop_latch();
    const bool failed = !out.ended && out.ended.error().kind == ErrorKind::machine;
    latch.settle(failed);
    if (latch.latched()) latch.poll();
    const auto lost = [&](const RunningAxis& axis) { return !latch.keeps_position(axis.config.index()); };
    if (failed && std::any_of(rack_.axes().begin(), rack_.axes().end(), lost))
        out.ended.error().message += ' ' + latch.position_sentence();
    if (!latch.latched()) return;
    const bool asked = latch.is_ordered();
    if (asked || (!out.ended && out.ended.error().kind != ErrorKind::stopped)) return;
    out.ended =
        fail(ErrorKind::machine,
             fmt::format("{} The program was stopped in line {} and nothing after it was executed. {} {}",
                         latch.sentence(), line_, latch.position_sentence(), "Remove the cause and start again."),
             {line_, 1});
}

/// Records late segments as breaches. Returns one warning of each other kind, with its number of lines.
std::vector<Job::DrivenOtherwise> Job::take_path_warnings(control::AxisGroup& axes, JobOutcome& out) {
    std::vector<DrivenOtherwise> others;
    for (control::PathWarning& note : axes.take_path_warnings()) {
        if (note.late_seconds >= 0) {
            out.breaches.add(
                {BreachKind::late, -1, note.late_seconds, 0, note.at, note.line, monitor_->place_at(note.at)});
            continue;
        }
        const auto same = std::find_if(others.begin(), others.end(),
                                       [&](const DrivenOtherwise& one) { return one.first.what == note.what; });
        if (same == others.end()) {
            others.push_back({note, note.line, 1});
            continue;
        }
        same->first.deviation_mm = std::max(same->first.deviation_mm, note.deviation_mm);
        same->lines += std::exchange(same->last_line, note.line) != note.line;
    }
    return others;
}

/// Warns about lines whose moves were replaced for execution; called after losses and breaches are reported.
void Job::report_other_motion(const std::vector<DrivenOtherwise>& others, JobOutcome& out) const {
    for (const DrivenOtherwise& one : others) {
        const std::string lines = one.lines == 1
                                      ? fmt::format("line {}", one.first.line)
                                      : fmt::format("{} lines from {} to {}", one.lines, one.first.line, one.last_line);
        out.warnings.push_back(
            {began_, one.first.line,
             fmt::format("{}: {} (it costs at most {:.4f} mm)", lines, one.first.what, one.first.deviation_mm)});
    }
}

/// Adds the monitor's breaches and their warnings to the outcome. Drops all breaches if the machine itself stopped the
/// job (switch, alarm, blocked motor).
void Job::collect_breaches(JobOutcome& out) {
    if (!out.ended && out.ended.error().kind == ErrorKind::machine) {
        out.breaches = {};
        return;
    }
    for (const Breach& breach : monitor_->breaches()) out.breaches.add(breach);
    for (const Breach& breach : out.breaches.all())
        out.warnings.push_back({breach.at, breach.line, sentence_of(breach)});
}

void Job::collect_conditions(JobOutcome& out) {
    const sim::Kernel& kernel = rack_.kernel();
    for (const sim::Condition& condition : kernel.conditions(reported_))
        if (condition.at >= given_) out.warnings.push_back({condition.at, 0, rack_.describe(condition)});
    for (std::string& text : rack_.stop_latch().contacts().take_alarms())
        out.warnings.push_back({rack_.kernel().now(), 0, std::move(text)});
    if (const std::uint64_t dropped = kernel.dropped_conditions(); dropped > reported_)
        out.warnings.push_back(
            {kernel.now(), 0, fmt::format("{} earlier conditions were not kept", dropped - reported_)});
    reported_ = kernel.dropped_conditions() + kernel.conditions().size();
    for (JobWarning& warning : out.warnings) {
        if (warning.line != 0) continue;
        for (const ExecutedMove& block : monitor_->blocks())
            if (block.start <= warning.at && warning.at <= block.end) warning.line = block.line;
    }
}

std::vector<AxisOutcome> Job::axis_outcomes(const control::Point& sent_to) {
    std::vector<AxisOutcome> out;
    const Instant now = rack_.kernel().now();
    for (std::size_t i = 0; i < before_.size(); ++i) {
        RunningAxis& axis = rack_.axes()[i];
        const Before& before = before_[i];
        AxisOutcome one;
        one.index = axis.config.index();
        one.unit = axis.config.unit();
        one.limits = rack_.config().limits()[static_cast<std::size_t>(one.index)];
        const std::int64_t commanded = axis.turned_by().count(now);
        const auto counts = [&](std::int64_t pulses) {
            return static_cast<std::int64_t>(std::floor(static_cast<double>(pulses) * counts_per_pulse(axis.config)));
        };
        one.servo = axis.servo != nullptr;
        one.pulses_sent = axis.card->pulses_made(axis.channel) - before.pulses_made;
        one.pulses_net = commanded - before.commanded;
        one.pulse_position = axis.card->pulse_counter(axis.channel);
        one.pulse_start = before.pulse_counter;
        one.encoder_counts = axis.card->encoder_counter(axis.channel) - before.encoder_counter;
        one.lost_pulses = commanded - axis.machine->rotor().count(now) - reference_.lost_before(i);
        one.expected_counts = counts(commanded) - counts(before.commanded);
        one.planned_end = rack_.config().positions_alone(axis.config)
                              ? sent_to[static_cast<std::size_t>(one.index)]
                              : static_cast<double>(one.pulse_position) / axis.config.pulses_per_unit();
        one.actual_end = axis.machine->position(now) + (reference_.real_origin(i) - axis.config.initial_position);
        one.top = monitor_->statistics(one.index);
        out.push_back(std::move(one));
    }
    return out;
}

}  // namespace motionrack::rack
