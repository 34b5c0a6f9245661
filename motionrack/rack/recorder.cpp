// Collects changes and hands them over, in order of time unless they are events.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <motionrack/rack/recorder.hpp>
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

class Recorder::StepListener final : public sim::EdgeListener {
  public:
    StepListener(Recorder& recorder, std::size_t step, std::size_t direction)
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
    Recorder& recorder_;
    std::size_t step_, direction_;
    Instant last_{};
    int sense_ = 0;
    bool high_ = false;
};

class Recorder::LineListener final : public sim::EdgeListener {
  public:
    LineListener(Recorder& recorder, std::size_t a, std::size_t b) : recorder_(recorder), a_(a), b_(b) {}

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
    Recorder& recorder_;
    std::size_t a_, b_;
};

class Recorder::EventListener final : public sim::EdgeListener {
  public:
    /// `counts`: values are counts after the edge, else directions.
    EventListener(Recorder& recorder, std::size_t channel, bool counts)
        : recorder_(recorder), channel_(channel), counts_(counts) {}

    void edges(const sim::EdgeBatch& batch) override {
        std::int64_t count = batch.first_count;
        for (std::uint32_t i = 0; i < batch.size; ++i, count += batch.step)
            recorder_.push(batch.origin + batch.at[i] * batch.tick, channel_, counts_ ? count : batch.step);
    }

  private:
    Recorder& recorder_;
    std::size_t channel_;
    bool counts_;
};

// ---- selection

RecorderTap::RecorderTap(sim::Kernel& kernel)
    : kernel_(kernel), id_(kernel.add(*this, sim::Phase::observers, "tap")), followers_(kernel.wire_count()) {
    for (std::size_t i = 0; i < kernel.wire_count(); ++i)
        if (kernel.lazy(static_cast<sim::WireId>(i))) kernel.listen(static_cast<sim::WireId>(i), id_, 0);
}

void RecorderTap::follow(sim::WireId wire, bool wanted) {
    followers_[sim::Kernel::index(wire)] += wanted ? 1 : -1;
    kernel_.subscribe(wire, id_, followers_[sim::Kernel::index(wire)] > 0);
}

sim::DeviceId RecorderTap::lend(sim::Device* sampler) {
    sampler_ = sampler;
    kernel_.schedule(id_, never);
    return id_;
}

Recorder::Recorder(Rack& rack, const RecorderSettings& settings)
    : rack_(rack),
      patterns_(settings.signals),
      tap_(settings.tap),
      period_(settings.period),
      events_(settings.events),
      breaks_(settings.breaks),
      wants_all_(settings.signals.empty() && settings.sampled.empty()) {
    lag_ = recorded_within;
}

Recorder::~Recorder() {
    stop_listening();
}

Result<std::unique_ptr<Recorder>> Recorder::create(Rack& rack, const RecorderSettings& settings) {
    std::unique_ptr<Recorder> out(new Recorder(rack, settings));
    out->choose_axes();
    out->choose_wires();
    out->choose_counters();
    for (const SampledChannel& one : settings.sampled) out->add_sampled(one);
    if (out->declared_.channels.empty())
        return fail(ErrorKind::invalid_input,
                    fmt::format("No signal fits '{}'; nothing was recorded. Signals are called like X.step, X.enc_a or "
                                "motion.xlmtp; * and ? stand for anything.",
                                fmt::join(settings.signals, "', '")));
    out->declared_.start = rack.kernel().now();
    out->declared_.edge_unit = out->edge_unit();
    out->declared_.rack_name = rack.config().name;
    MOTIONRACK_TRY(out->sink_, settings.sink(out->declared_));
    if (!rack.started()) {
        out->id_ = rack.kernel().add(*out, sim::Phase::observers, "recorder");
        out->is_device_ = true;
    }
    out->reserve_buffer();
    out->listen();
    return out;
}

bool Recorder::wanted(const std::string& name) const {
    return wants_all_ ||
           std::any_of(patterns_.begin(), patterns_.end(), [&](const std::string& p) { return matches(p, name); });
}

const std::string* Recorder::wanted_name(sim::WireId wire) const {
    for (std::size_t i = 0;; ++i) {
        const std::string& name = rack_.kernel().wire_name(wire, i);
        if (name.empty()) return nullptr;
        if (wanted(name)) return &name;
    }
}

std::size_t Recorder::add(Channel channel) {
    declared_.channels.push_back(std::move(channel));
    return declared_.channels.size() - 1;
}

void Recorder::add_sampled(SampledChannel one) {
    one.channel.initial = one.read();
    sampled_.emplace_back(add(std::move(one.channel)), std::move(one.read));
}

/// Returns the coarsest time unit that shows every edge: the timing of shared buses and the count rates of scales limit
/// it.
Duration Recorder::edge_unit() const {
    Duration unit = nanoseconds(100);
    for (const auto& card : rack_.cards())
        for (const Channel& channel : declared_.channels)
            if (card->shows(channel.scope(), channel.short_name())) unit = std::min(unit, card->edge_unit());
    for (const RunningStage& stage : rack_.stages())
        for (const Channel& channel : declared_.channels)
            if (channel.scope() == stage.config.name && channel.short_name().starts_with("scale."))
                while (unit > 2 * parts::edge_spacing(scale_settings(stage.config))) unit = unit / 10;
    return unit;
}

void Recorder::choose_axes() {
    for (RunningAxis& axis : rack_.axes()) {
        if (!axis.servo) choose_pulses(axis);
        if (axis.machine->has_encoder()) choose_encoder(axis);
    }
}

void Recorder::choose_pulses(RunningAxis& axis) {
    const std::string name(1, axis.config.letter);
    sim::EdgeListener* listener = nullptr;
    if (events_) {
        if (!wanted(name + ".steps")) return;
        const std::size_t steps = add({name + ".steps", ChannelKind::steps, "step"});
        listener = others_.emplace_back(std::make_unique<EventListener>(*this, steps, false)).get();
    } else {
        if (!wanted(name + ".step") && !wanted(name + ".dir")) return;
        const std::size_t step = add({name + ".step"}), direction = add({name + ".dir", ChannelKind::level, {}, 1, 1});
        listener = steps_.emplace_back(std::make_unique<StepListener>(*this, step, direction)).get();
    }
    heard_.emplace_back(axis.pulse_listeners.get(), listener);
}

void Recorder::choose_encoder(RunningAxis& axis) {
    const std::string name(1, axis.config.letter);
    const Instant now = rack_.kernel().now();
    if (events_) {
        if (!wanted(name + ".encoder")) return;
        const std::size_t counts =
            add({name + ".encoder", ChannelKind::counts, "count", 1, axis.machine->encoder().count(now)});
        others_.push_back(std::make_unique<EventListener>(*this, counts, true));
    } else {
        if (!wanted(name + ".enc_a") && !wanted(name + ".enc_b")) return;
        const parts::QuadratureLevels levels = axis.machine->encoder_lines(now);
        const std::size_t a = add({name + ".enc_a", ChannelKind::level, {}, 1, levels.a != 0}),
                          b = add({name + ".enc_b", ChannelKind::level, {}, 1, levels.b != 0});
        others_.push_back(std::make_unique<LineListener>(*this, a, b));
        const std::int64_t counts = axis.config.encoder_counts_per_rev / axis.config.pulses_per_rev();
        lag_ = std::max(lag_, (counts + 1) * recorded_within);
    }
    heard_.emplace_back(axis.encoder_listeners.get(), others_.back().get());
}

void Recorder::choose_wires() {
    const sim::Kernel& kernel = rack_.kernel();
    const std::map<std::string, double> volts = volts_of_wires(rack_.config());
    wire_channels_.assign(kernel.wire_count(), -1);
    wires_begin_ = declared_.channels.size();
    for (std::size_t i = 0; i < kernel.wire_count(); ++i) {
        const auto wire = static_cast<sim::WireId>(i);
        const std::string* chosen = wanted_name(wire);
        if (chosen == nullptr) continue;
        if (kernel.lazy(wire)) {
            if (tap_ == nullptr || patterns_.empty()) continue;
            followed_.push_back(wire);
        }
        Channel channel{*chosen};
        if (kernel.wire_bits(wire) > 1) channel.kind = ChannelKind::number;
        if (const auto analog = volts.find(*chosen); analog != volts.end() && analog->second != 1) {
            channel.kind = ChannelKind::number;
            channel.unit = "V";
            channel.scale = analog->second;
        }
        channel.initial = kernel.level(wire);
        wire_channels_[i] = static_cast<std::int64_t>(add(std::move(channel)));
    }
    wires_end_ = declared_.channels.size();
}

void Recorder::choose_counters() {
    for (const auto& card : rack_.cards())
        for (const CardCounter& each : card->counters()) {
            const std::string name = card->name() + "." + each.name;
            if (!wanted(name)) continue;
            const Channel channel{name, ChannelKind::counter, each.encoder ? "count" : "step"};
            add_sampled({channel, [of = card.get(), each] { return of->counter(each); }});
        }
}

// ---- recording

void Recorder::begin(Duration after) {
    MOTIONRACK_ASSERT(is_device_ || tap_ != nullptr);
    if (!is_device_) id_ = tap_->lend(this);
    borrows_device_ = !is_device_;
    rack_.kernel().schedule(id_, later(rack_.kernel().now(), after));
}

void Recorder::push(Instant at, std::size_t channel, std::int64_t value, std::uint32_t place) {
    if (buffer_.size() == buffer_size_) {
        ++lost_;
        return;
    }
    buffer_.push_back({at, static_cast<std::uint32_t>(channel), place, value});
    if (buffer_.size() > buffer_size_ / 2) rack_.kernel().break_run();
}

void Recorder::wire_changed(sim::WireId wire, int level, Instant now) {
    const std::int64_t channel = wire_channels_[sim::Kernel::index(wire)];
    if (channel >= 0) push(now, static_cast<std::size_t>(channel), level);
}

void Recorder::on_scheduled(Instant now) {
    if (breaks_) {
        due_ = true;
        rack_.kernel().break_run();
    } else {
        sample(now);
    }
    rack_.kernel().schedule(id_, later(now, period_));
}

void Recorder::sample(Instant now) {
    for (const auto& [channel, read] : sampled_) push(now, channel, read());
}

/// Orders the changes before `end` by time; returns their end.
std::vector<Recorder::BufferedChange>::iterator Recorder::order_before(Instant end) {
    const auto is_before = [](const BufferedChange& a, const BufferedChange& b) {
        return a.at != b.at ? a.at < b.at : a.place < b.place;
    };
    if (!std::is_sorted(buffer_.begin(), buffer_.end(), is_before))
        std::stable_sort(buffer_.begin(), buffer_.end(), is_before);
    return std::partition_point(buffer_.begin(), buffer_.end(),
                                [end](const BufferedChange& one) { return one.at < end; });
}

void Recorder::hand_over(Instant end) {
    const Instant now = rack_.kernel().now();
    for (const auto& listener : steps_) listener->settle(now);
    const auto rest = events_ ? buffer_.end() : order_before(end);
    for (auto one = buffer_.begin(); one != rest; ++one) {
        if (!events_)
            one->at = last_ = std::max(last_, one->at);  // after drain() a pulse's end may follow a later change
        sink_->change(one->channel, one->value, one->at);
    }
    buffer_.erase(buffer_.begin(), rest);
    sink_->settle(std::min(now, end));
}

/// Edges come in bursts, samples one period after another.
void Recorder::reserve_buffer() {
    const bool samples_alone = heard_.empty() && wires_begin_ == wires_end_;
    buffer_size_ = samples_alone ? std::min(max_buffered, max_samples_buffered * sampled_.size()) : max_buffered;
    buffer_.reserve(buffer_size_);
}

/// Parts of the rack store their listeners, so this follows everything that can fail.
void Recorder::listen() {
    for (const auto& [fork, listener] : heard_) fork->add(*listener);
    recording_ = true;
    for (const sim::WireId wire : followed_) tap_->follow(wire, true);
    if (wires_begin_ != wires_end_) rack_.wire_listeners().add(*this);
}

void Recorder::stop_listening() {
    for (const auto& [fork, listener] : heard_) fork->remove(*listener);
    heard_.clear();
    if (!recording_) return;
    recording_ = false;
    rack_.wire_listeners().remove(*this);
    if (is_device_) rack_.kernel().schedule(id_, never);
    if (borrows_device_) tap_->lend(nullptr);
    for (const sim::WireId wire : followed_) tap_->follow(wire, false);
}

Result<void> Recorder::finish() {
    poll();
    drain();
    Result<void> ended = sink_->close(std::max(rack_.kernel().now(), last_));
    closed_ = ended.has_value();
    if (closed_ && lost_ > 0)
        ended = fail(ErrorKind::io,
                     fmt::format("{} {} of one instant exceed the limit of a recording and were omitted. The recording "
                                 "has all others; select fewer signals to record all.",
                                 lost_, events_ ? "events" : "changes"));
    failed_ = !ended;
    if (!can_end_again()) stop_listening();
    return ended;
}

}  // namespace motionrack::rack
