// Collects changes and writes them in order of time.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <motionrack/rack/wave_recorder.hpp>
#include <motionrack/rack/wire_access.hpp>

namespace motionrack::rack {

namespace {

/// Shell-like match: * any text, ? any character.
bool matches(std::string_view pattern, std::string_view text) {
    std::size_t p = 0, t = 0, star = std::string_view::npos, mark = 0;
    while (t < text.size()) {
        if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
            ++p, ++t;
        } else if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            mark = t;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            t = ++mark;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

constexpr Duration max_pulse_width = microseconds(5);
/// Delay of the record of a pulse's end: until the next pulse, or the time of two pulses. It also applies to the
/// encoder counts caused by the pulse.
constexpr Duration recorded_within = 2 * max_pulse_width;
constexpr Duration direction_lead = nanoseconds(250);

}  // namespace

class WaveRecorder::StepListener final : public sim::EdgeListener {
  public:
    StepListener(WaveRecorder& recorder, std::size_t step, std::size_t direction)
        : recorder_(recorder), step_(step), direction_(direction) {}

    void edges(const sim::EdgeBatch& batch) override {
        for (std::uint32_t i = 0; i < batch.size; ++i) {
            const Instant at = batch.origin + batch.at[i] * batch.tick;
            if (high_) recorder_.push(std::min(last_ + (at - last_) / 2, last_ + max_pulse_width), step_, 0);
            if (batch.step != sense_) {
                sense_ = batch.step;
                recorder_.push(std::max(high_ ? last_ + (at - last_) / 2 : Instant{0}, at - direction_lead), direction_,
                               sense_ > 0);
            }
            recorder_.push(at, step_, 1);
            last_ = at;
            high_ = true;
        }
    }
    /// Ends the last pulse if no pulse has come for long enough.
    void settle(Instant now) {
        if (!high_ || now - last_ < recorded_within) return;
        recorder_.push(last_ + max_pulse_width, step_, 0);
        high_ = false;
    }

  private:
    WaveRecorder& recorder_;
    std::size_t step_, direction_;
    Instant last_{};
    int sense_ = 0;
    bool high_ = false;
};

class WaveRecorder::LineListener final : public sim::EdgeListener {
  public:
    LineListener(WaveRecorder& recorder, std::size_t a, std::size_t b) : recorder_(recorder), a_(a), b_(b) {}

    void edges(const sim::EdgeBatch& batch) override {
        std::int64_t count = batch.first_count;
        for (std::uint32_t i = 0; i < batch.size; ++i, count += batch.step) {
            const Instant at = batch.origin + batch.at[i] * batch.tick;
            const auto phase = static_cast<unsigned>(count & 3);  // 0 00, 1 A, 2 AB, 3 B
            recorder_.push(at, a_, phase == 1 || phase == 2);
            recorder_.push(at, b_, phase >= 2, recorder_.place_of(a_));
        }
    }

  private:
    WaveRecorder& recorder_;
    std::size_t a_, b_;
};

std::int64_t WaveRecorder::RecordedCounter::value() const {
    return card->counter({{}, channel, encoder});
}

// ---- selection

WireTap::WireTap(sim::Kernel& kernel)
    : kernel_(kernel), id_(kernel.add(*this, sim::Phase::observers, "tap")), followers_(kernel.wire_count()) {
    for (std::size_t i = 0; i < kernel.wire_count(); ++i)
        if (kernel.lazy(static_cast<sim::WireId>(i))) kernel.listen(static_cast<sim::WireId>(i), id_, 0);
}

void WireTap::follow(sim::WireId wire, bool wanted) {
    followers_[sim::Kernel::index(wire)] += wanted ? 1 : -1;
    kernel_.subscribe(wire, id_, followers_[sim::Kernel::index(wire)] > 0);
}

WaveRecorder::WaveRecorder(Rack& rack, const WaveSettings& settings)
    : rack_(rack), patterns_(settings.signals), tap_(settings.tap), register_period_(settings.register_period) {
    buffer_.reserve(buffer_size);
    lag_ = recorded_within;
}

WaveRecorder::~WaveRecorder() {
    stop_listening();
}

Result<std::unique_ptr<WaveRecorder>> WaveRecorder::create(Rack& rack, const WaveSettings& settings) {
    std::unique_ptr<WaveRecorder> out(new WaveRecorder(rack, settings));
    out->choose_axes();
    out->choose_wires();
    out->choose_counters();
    if (out->signals_.empty())
        return fail(ErrorKind::invalid_input,
                    fmt::format("No signal fits '{}'; nothing was recorded. Signals are called like X.step, X.enc_a or "
                                "motion.xlmtp; * and ? stand for anything.",
                                fmt::join(settings.signals, "', '")));
    if (settings.sink) {
        out->sink_ = settings.sink(out->signals_);
    } else {
        const Duration unit = settings.unit > Duration{0} ? settings.unit : out->coarsest_unit();
        MOTIONRACK_TRY(out->sink_, make_wave_sink({settings.path, settings.format, unit, rack.kernel().now(),
                                                   rack.config().name, settings.version},
                                                  out->signals_));
    }
    if (!rack.started()) {
        out->id_ = rack.kernel().add(*out, sim::Phase::observers, "wave recorder");
        out->is_device_ = true;
    }
    out->listen();
    return out;
}

bool WaveRecorder::wanted(const std::string& name) const {
    return patterns_.empty() ||
           std::any_of(patterns_.begin(), patterns_.end(), [&](const std::string& p) { return matches(p, name); });
}

const std::string* WaveRecorder::wanted_name(sim::WireId wire) const {
    for (std::size_t i = 0;; ++i) {
        const std::string& name = rack_.kernel().wire_name(wire, i);
        if (name.empty()) return nullptr;
        if (wanted(name)) return &name;
    }
}

std::size_t WaveRecorder::add(WaveSignal signal) {
    signals_.push_back(std::move(signal));
    return signals_.size() - 1;
}

/// Lines of a bus shared by cards have edges as close as its timing allows, those of a scale as close as its count
/// rate does.
Duration WaveRecorder::coarsest_unit() const {
    Duration unit = nanoseconds(100);
    for (const auto& card : rack_.cards())
        for (const WaveSignal& signal : signals_)
            if (card->shows(signal.scope, signal.name)) unit = std::min(unit, card->edge_unit());
    for (const RunningStage& stage : rack_.stages())
        for (const WaveSignal& signal : signals_)
            if (signal.scope == stage.config.name && signal.name.rfind("scale.", 0) == 0)
                while (unit > 2 * parts::edge_spacing(scale_settings(stage.config))) unit = unit / 10;
    return unit;
}

void WaveRecorder::choose_axes() {
    for (RunningAxis& axis : rack_.axes()) {
        const std::string name(1, axis.config.letter);
        parts::AxisMechanics& machine = *axis.machine;
        const bool pulses = !axis.servo && (wanted(name + ".step") || wanted(name + ".dir"));
        const bool lines = machine.has_encoder() && (wanted(name + ".enc_a") || wanted(name + ".enc_b"));
        if (pulses) {
            const std::size_t step = add({name, "step"}), direction = add({name, "dir", false, 1, 1});
            steps_.push_back(std::make_unique<StepListener>(*this, step, direction));
            heard_.emplace_back(axis.pulse_listeners.get(), steps_.back().get());
        }
        if (lines) {
            const parts::QuadratureLevels now = machine.encoder_lines(rack_.kernel().now());
            const std::size_t a = add({name, "enc_a", false, 1, now.a != 0}),
                              b = add({name, "enc_b", false, 1, now.b != 0});
            lines_.push_back(std::make_unique<LineListener>(*this, a, b));
            const std::int64_t counts = axis.config.encoder_counts_per_rev / axis.config.pulses_per_rev();
            lag_ = std::max(lag_, (counts + 1) * recorded_within);
            heard_.emplace_back(axis.encoder_listeners.get(), lines_.back().get());
        }
    }
}

void WaveRecorder::choose_wires() {
    const sim::Kernel& kernel = rack_.kernel();
    const std::map<std::string, double> volts = volts_of_wires(rack_.config());
    wire_signals_.assign(kernel.wire_count(), -1);
    wires_begin_ = signals_.size();
    for (std::size_t i = 0; i < kernel.wire_count(); ++i) {
        const auto wire = static_cast<sim::WireId>(i);
        const std::string* chosen = wanted_name(wire);
        if (chosen == nullptr) continue;
        const std::string& name = *chosen;
        if (kernel.lazy(wire)) {
            if (tap_ == nullptr || patterns_.empty()) continue;
            followed_.push_back(wire);
        }
        const std::size_t dot = name.find('.');
        const bool plain = dot == std::string::npos;
        WaveSignal signal{plain ? "rack" : name.substr(0, dot), plain ? name : name.substr(dot + 1)};
        if (const auto analog = volts.find(name); analog != volts.end()) signal.unit = analog->second;
        signal.is_number = signal.unit != 1 || kernel.wire_bits(wire) > 1;
        signal.initial = kernel.level(wire);
        wire_signals_[i] = static_cast<std::int64_t>(add(std::move(signal)));
    }
    wires_end_ = signals_.size();
}

void WaveRecorder::choose_counters() {
    for (const auto& card : rack_.cards())
        for (const CardCounter& each : card->counters()) {
            if (!wanted(card->name() + "." + each.name)) continue;
            RecordedCounter counter{card.get(), each.channel, each.encoder, 0};
            counter.signal = add({card->name(), each.name, true, 1, counter.value()});
            counters_.push_back(counter);
        }
}

// ---- recording

void WaveRecorder::begin() {
    MOTIONRACK_ASSERT(is_device_);
    rack_.kernel().schedule(id_, rack_.kernel().now());
}

void WaveRecorder::push(Instant at, std::size_t signal, std::int64_t value, std::uint32_t place) {
    if (buffer_.size() == buffer_size) {
        ++lost_;
        return;
    }
    buffer_.push_back({at, static_cast<std::uint32_t>(signal), place, value});
    if (buffer_.size() > buffer_size / 2) rack_.kernel().break_run();
}

void WaveRecorder::wire_changed(sim::WireId wire, int level, Instant now) {
    const std::int64_t signal = wire_signals_[sim::Kernel::index(wire)];
    if (signal >= 0) push(now, static_cast<std::size_t>(signal), level);
}

void WaveRecorder::on_scheduled(Instant now) {
    look_at_cards(now);
    rack_.kernel().schedule(id_, now + register_period_);
}

void WaveRecorder::look_at_cards(Instant now) {
    for (const RecordedCounter& counter : counters_) push(now, counter.signal, counter.value());
}

void WaveRecorder::drain() {
    write_before(never);
}

void WaveRecorder::drain_settled() {
    write_before(rack_.kernel().now() - lag_);
}

void WaveRecorder::write_before(Instant end) {
    const Instant now = rack_.kernel().now();
    for (const auto& listener : steps_) listener->settle(now);
    std::stable_sort(buffer_.begin(), buffer_.end(), [](const WaveEvent& a, const WaveEvent& b) {
        return a.at != b.at ? a.at < b.at : a.place < b.place;
    });
    const auto rest =
        std::partition_point(buffer_.begin(), buffer_.end(), [end](const WaveEvent& event) { return event.at < end; });
    for (auto event = buffer_.begin(); event != rest; ++event) {
        last_ = std::max(last_, event->at);  // after drain() a pulse's end may follow a later change
        sink_->change(event->signal, event->value, last_);
        ++changes_;
    }
    buffer_.erase(buffer_.begin(), rest);
}

/// Parts of the rack store their listeners, so this follows everything that can fail.
void WaveRecorder::listen() {
    for (const auto& [fork, listener] : heard_) fork->add(*listener);
    recording_ = true;
    for (const sim::WireId wire : followed_) tap_->follow(wire, true);
    rack_.wire_listeners().add(*this);
}

void WaveRecorder::stop_listening() {
    for (const auto& [fork, listener] : heard_) fork->remove(*listener);
    heard_.clear();
    if (!recording_) return;
    recording_ = false;
    rack_.wire_listeners().remove(*this);
    if (is_device_) rack_.kernel().schedule(id_, never);
    for (const sim::WireId wire : followed_) tap_->follow(wire, false);
}

Result<void> WaveRecorder::finish() {
    poll();
    drain();
    Result<void> ended = sink_->close(std::max(rack_.kernel().now(), last_));
    if (ended && lost_ > 0)
        ended = fail(ErrorKind::io,
                     fmt::format("{} changes of one instant exceed the limit of a recording and were omitted.", lost_));
    failed_ = !ended;
    if (ended) stop_listening();
    return ended;
}

}  // namespace motionrack::rack
