// Opens racks; time, the bus, conditions and recordings.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/rack/bus_access.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/quantities.hpp>
#include <motionrack/rack/raised_flag.hpp>
#include <motionrack/rack/session.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <motionrack/rack/wave_sink.hpp>
#include <motionrack/trace/vcd_writer.hpp>

namespace motionrack::rack {

Session::Session(const RackConfig& config, Programs programs)
    : rack_(config), job_(make_job(programs)), tap_(std::make_unique<RecorderTap>(rack_.kernel())), context_(rack_) {
    rack_.input_log().keep_no_more();
    rack_.start();
}

Session::~Session() {
    static_cast<void>(stop_trace());
}

Result<std::unique_ptr<Session>> Session::open(std::string_view path_or_text, Programs programs) {
    const RackReading reading = read_rack(path_or_text);
    if (reading.config) return std::unique_ptr<Session>(new Session(*reading.config, programs));
    Error all = reading.errors.front();
    all.message = all.text();
    all.file.clear();
    all.location = {};
    for (std::size_t i = 1; i < reading.errors.size(); ++i) all.message += '\n' + reading.errors[i].text();
    return tl::unexpected<Error>(std::move(all));
}

// ---- time

Result<void> refuse_time_beyond_end(Instant now) {
    return fail(ErrorKind::refused,
                fmt::format("The rack's time is {:.0f} s and ends at {:.0f} s; nothing was run. Open a new rack.",
                            to_seconds(now), to_seconds(Session::latest)));
}

/// Converts `ns` to a duration within the rack's remaining time.
Result<Duration> Session::time_of(std::uint64_t ns) const {
    MOTIONRACK_CHECK(check_free());
    if (ns > max_ns)
        return fail(
            ErrorKind::refused,
            fmt::format("{} ns exceed the limit of a call, {} ns; nothing was run. Call several times.", ns, max_ns));
    const Duration time = nanoseconds(static_cast<std::int64_t>(ns));
    MOTIONRACK_CHECK(check_time_left(time));
    return time;
}

Result<void> Session::advance(std::uint64_t ns) {
    MOTIONRACK_TRY(const Duration time, time_of(ns));
    run_to(now() + time);
    return {};
}

void Session::run_to(Instant until) {
    while (true) {
        poll();
        const sim::RunEnd end = rack_.kernel().run_until(
            std::min(until, next_poll_), on_condition_ ? sim::RunBreak::conditions : sim::RunBreak::none);
        if (end == sim::RunEnd::broken && recorder_) recorder_->drain_settled();
        report_conditions();
        if (end == sim::RunEnd::reached && now() >= until) break;
    }
    poll();
}

/// Lets a due recording sample the registers and write its data to the disk.
void Session::poll() {
    if (now() < next_poll_) return;
    recorder_->poll();
    recorder_->drain_settled();
    const Duration period = recorder_->period();
    next_poll_ = (now() / period + 1) * period;
}

/// Called while a program, a homing or a card's host advances time.
void Session::between() {
    poll();
    if (recorder_) recorder_->drain_settled();
    report_conditions();
}

// ---- the bus

Result<std::uint32_t> Session::read(std::string_view card, int bits, std::uint32_t address) {
    MOTIONRACK_CHECK(check_free());
    MOTIONRACK_TRY(Card * on, card_for_access(rack_, card, bits, address, false));
    MOTIONRACK_CHECK(check_time_left(milliseconds(1)));
    const std::uint32_t value = on->bus_read(bits, address);
    after_access();
    return value;
}

Result<void> Session::write(std::string_view card, int bits, std::uint32_t address, std::uint32_t value) {
    MOTIONRACK_CHECK(check_free());
    MOTIONRACK_TRY(Card * on, card_for_access(rack_, card, bits, address, true));
    MOTIONRACK_CHECK(check_time_left(milliseconds(1)));
    on->bus_write(bits, address, value);
    after_access();
    return {};
}

Result<bool> Session::wait(std::string_view card, std::uint64_t ns) {
    MOTIONRACK_TRY(Card * on, card_named(rack_, card));
    MOTIONRACK_TRY(const Duration time, time_of(ns));
    constexpr Duration drained_within = microseconds(10);  // interval at which the data of a recording is fetched
    const Instant end = now() + time;
    bool active = false;
    for (poll(); !active; poll()) {
        const Duration left = end - now();
        active = on->host().wait(recorder_ ? std::min({left, drained_within, next_poll_ - now()}) : left);
        between();
        if (now() >= end) break;
    }
    return active;
}

Result<std::int64_t> Session::peek(std::string_view card, std::string_view name) {
    MOTIONRACK_TRY(const Card* on, card_named(rack_, card));
    return on->inspect(name);
}

// ---- parts, copies

Result<double> Session::part(std::string_view part_dot_quantity) {
    return get_quantity(rack_, part_dot_quantity);
}

Result<void> Session::set_part(std::string_view part_dot_quantity, double value) {
    Result<void> done = set_quantity(rack_, part_dot_quantity, value);
    report_conditions();
    return done;
}

Result<void> Session::set_wire(std::string_view name, double value) {
    Result<void> done = context_.force(name, value);
    report_conditions();
    return done;
}

Result<void> Session::fault(std::string_view fault, std::string_view target) {
    Result<void> done = inject_fault(rack_, fault, target);
    report_conditions();
    return done;
}

Result<std::unique_ptr<Session>> Session::copy() {
    MOTIONRACK_CHECK(check_free());
    std::unique_ptr<Session> out(new Session(rack_.config(), job_ ? Programs::yes : Programs::no));
    out->rack_.copy_from(rack_);
    out->context_.copy_from(context_);
    if (job_) out->job_->copy_from(*job_);
    out->trace_unit_ = trace_unit_;
    return out;
}

// ---- conditions

std::uint64_t Session::condition_count() const {
    const sim::Kernel& kernel = rack_.kernel();
    return kernel.dropped_conditions() + kernel.conditions().size();
}

std::vector<ReportedCondition> Session::conditions(std::uint64_t since) {
    return reported_conditions(rack_, since);
}

void Session::on_condition(std::function<void(const ReportedCondition&)> call) {
    if (!on_condition_) reported_ = condition_count();
    on_condition_ = std::move(call);
}

/// The call-back may cause further conditions, which it receives afterwards.
void Session::report_conditions() {
    if (!on_condition_ || telling_) return;
    const RaisedFlag telling(telling_);
    while (on_condition_) {
        const std::vector<ReportedCondition> changed = conditions(reported_);
        if (changed.empty()) break;
        for (const ReportedCondition& one : changed) {
            reported_ = one.number;
            const auto call = on_condition_;  // it may replace or remove itself
            if (call) call(one);
        }
    }
}

Result<void> refuse_in_a_call_back() {
    return fail(ErrorKind::refused,
                "A call-back of this rack, during a call that advances time, cannot advance time, copy the rack or "
                "close it. Nothing was done; return from the call-back first.");
}

// ---- recordings

Result<void> Session::set_trace_unit(double ns) {
    constexpr double coarsest_ns = 1e9;
    Duration unit{ns >= 0 && ns <= coarsest_ns ? std::llround(ns * 10) : -1};
    if (std::fabs(ns * 10 - static_cast<double>(unit.count())) > 1e-6) unit = Duration{-1};
    if (ns != 0) MOTIONRACK_CHECK(trace::check_unit(unit));
    trace_unit_ = unit;
    return {};
}

Result<void> Session::start_trace(const std::string& path, std::string_view signals, std::string_view version) {
    if (recorder_ && !recorder_->failed())
        return fail(ErrorKind::refused, "A recording is running and continues. Nothing was started. Stop it first.");
    RecorderSettings settings;
    MOTIONRACK_TRY(const WaveFormat format, wave_format(path));
    settings.sink = wave_sink({path, format, trace_unit_, std::string(version)});
    settings.tap = tap_.get();
    constexpr std::string_view between = " ,\t\n";
    for (std::size_t at = 0; (at = signals.find_first_not_of(between, at)) != std::string_view::npos;) {
        const std::size_t end = std::min(signals.find_first_of(between, at), signals.size());
        settings.signals.emplace_back(signals.substr(at, end - at));
        at = end;
    }
    if (recorder_ && !recorder_->can_end_again()) drop_recorder();  // a lost recording no longer blocks its name
    MOTIONRACK_TRY(recorder_, Recorder::create(rack_, settings));
    next_poll_ = now();
    return {};
}

Result<void> Session::stop_trace() {
    if (!recorder_) return fail(ErrorKind::refused, "No recording runs; nothing was done.");
    Result<void> ended = recorder_->finish();
    if (!recorder_->is_closed()) {
        ended.error().message += recorder_->can_end_again()
                                     ? " The recording continues; stop it again, or start another one."
                                     : " The recording is lost; start another one.";
        return ended;
    }
    drop_recorder();
    return ended;
}

void Session::drop_recorder() {
    recorder_.reset();
    next_poll_ = never;
}

}  // namespace motionrack::rack
