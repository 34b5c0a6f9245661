// Collects data, detects the trigger, and extracts a capture.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/panel/scope.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::panel {

namespace {

constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
constexpr Duration slack = milliseconds(20);  // longer than any slice

}  // namespace

std::string_view name_of(ScopeState state) {
    switch (state) {
        case ScopeState::idle:
            return "idle";
        case ScopeState::armed:
            return "armed";
        case ScopeState::triggered:
            return "triggered";
        case ScopeState::done:
            return "done";
    }
    return "";
}

/// Receives the recorder's changes, between runs and in order.
class Scope::Sink final : public rack::ChangeSink {
  public:
    Sink(Scope& scope, std::vector<rack::Channel> channels) : scope_(scope), channels_(std::move(channels)) {}
    void change(std::size_t index, std::int64_t value, Instant at) override {
        const std::size_t place = scope_.places_[index];
        if (place != nowhere) scope_.see(at, place, channels_[index].shown(value));
    }

  private:
    Scope& scope_;
    std::vector<rack::Channel> channels_;
};

Scope::Scope(operate::Machine& machine, ChannelRegistry& channels) : machine_(machine), book_(channels) {}

Scope::~Scope() {
    detach();
}

Result<void> Scope::arm(const ScopeSettings& settings) {
    if (settings.channels.empty() || settings.channels.size() > max_channels)
        return fail(ErrorKind::invalid_input,
                    fmt::format("{} channels are not possible; 1 to {} are.", settings.channels.size(), max_channels));
    if (settings.length <= Duration{0} || settings.pre < Duration{0} || settings.pre > settings.length)
        return fail(ErrorKind::invalid_input,
                    "The part before the trigger must lie within the length, which must be above 0.");
    std::vector<std::string> wires;
    std::vector<NumericChannel> numbers;
    for (std::size_t i = 0; i < settings.channels.size(); ++i) {
        const LiveChannel* channel = book_.find(settings.channels[i]);
        if (channel == nullptr)
            return fail(ErrorKind::invalid_input,
                        fmt::format("Unknown channel {}; the query channels lists all channels.",
                                    rack::in_quotes(settings.channels[i])));
        if (channel->reader == ChannelReader::edges)
            wires.push_back(channel->name);
        else
            numbers.push_back({channel, i, 0});
    }
    const auto trigger = std::find(settings.channels.begin(), settings.channels.end(), settings.trigger);
    if (!settings.trigger.empty() && trigger == settings.channels.end())
        return fail(ErrorKind::invalid_input,
                    fmt::format("Unknown trigger {}; it must be one of the scope's channels. Nothing was started.",
                                rack::in_quotes(settings.trigger)));
    if (!numbers.empty() &&
        (settings.period <= Duration{0} || settings.length / settings.period > static_cast<std::int64_t>(max_samples)))
        return fail(ErrorKind::refused,
                    fmt::format("{:.6g} s at {:.6g} us are more than {} samples; choose a shorter length or a longer "
                                "period. Nothing was armed.",
                                to_seconds(settings.length), to_seconds(settings.period) * 1e6, max_samples));
    detach();
    settings_ = settings;
    numbers_ = std::move(numbers);
    trigger_place_ = settings.trigger.empty() ? nowhere : static_cast<std::size_t>(trigger - settings.channels.begin());
    base_.assign(settings.channels.size(), 0);
    for (std::size_t i = 0; i < settings.channels.size(); ++i) base_[i] = book_.find(settings.channels[i])->read();
    if (!wires.empty()) MOTIONRACK_CHECK(listen_to_wires(wires));
    restart(machine_.now());
    begin_numbers();
    return {};
}

Result<void> Scope::listen_to_wires(const std::vector<std::string>& wires) {
    rack::RecorderSettings settings;
    settings.signals = wires;
    settings.tap = &machine_.instruments().tap();
    settings.sink = [this](const rack::Declaration& declared) {
        places_.clear();
        for (const rack::Channel& channel : declared.channels) {
            const auto found = std::find(settings_.channels.begin(), settings_.channels.end(), channel.name);
            places_.push_back(found == settings_.channels.end()
                                  ? nowhere
                                  : static_cast<std::size_t>(found - settings_.channels.begin()));
        }
        return std::make_shared<Sink>(*this, declared.channels);
    };
    MOTIONRACK_TRY(recorder_, rack::Recorder::create(machine_.rack(), settings));
    return {};
}

void Scope::begin_numbers() {
    if (numbers_.empty()) return;
    rows_ = (settings_.length + slack) / settings_.period + 2;
    samples_.assign(static_cast<std::size_t>(rows_) * numbers_.size(), 0);
    for (NumericChannel& number : numbers_) number.slow = number.channel->read();
    first_sample_ = machine_.now();
    written_ = seen_ = 0;
    probing_ = true;
    machine_.instruments().sampler().begin(settings_.period, [this](Instant now) { sample(now); });
}

/// Called within the kernel's run.
void Scope::sample(Instant) {
    double* row = &samples_[static_cast<std::size_t>(written_ % rows_) * numbers_.size()];
    for (const NumericChannel& number : numbers_)
        *row++ = number.channel->reader == ChannelReader::anytime ? number.channel->read() : number.slow;
    ++written_;
}

void Scope::stop() {
    detach();
    if (state_ != ScopeState::done) state_ = ScopeState::idle;
}

void Scope::detach() {
    recorder_.reset();
    if (std::exchange(probing_, false)) machine_.instruments().sampler().end();
    edges_.clear();
}

void Scope::restart(Instant now) {
    state_ = ScopeState::armed;
    armed_at_ = now;
    triggered_at_ = never;
    last_value_.reset();
    full_ = false;
}

/// Evaluates a change of the trigger channel.
void Scope::look_at(Instant at, double before, double value) {
    last_value_ = value;
    const bool above = value >= settings_.level, was = before >= settings_.level;
    const bool fits =
        above != was && (settings_.edge == TriggerEdge::either || (settings_.edge == TriggerEdge::rise) == above);
    if (!fits || at - armed_at_ < settings_.pre) return;
    state_ = ScopeState::triggered;
    triggered_at_ = at;
}

/// Handles a change of a wire.
void Scope::see(Instant at, std::size_t channel, double value) {
    if (channel == trigger_place_ && state_ == ScopeState::armed)
        look_at(at, last_value_.value_or(base_[channel]), value);
    if (edges_.size() >= max_edges) {
        if (state_ == ScopeState::triggered) {
            full_ = true;
            return;
        }
        base_[edges_.front().channel] = edges_.front().value;
        edges_.pop_front();
    }
    edges_.push_back({at, channel, value});
}

/// Searches the samples since the last slice.
void Scope::look_for_trigger() {
    const auto column = std::find_if(numbers_.begin(), numbers_.end(),
                                     [this](const NumericChannel& number) { return number.place == trigger_place_; });
    for (; seen_ < written_ && state_ == ScopeState::armed && column != numbers_.end(); ++seen_) {
        if (seen_ < written_ - rows_) continue;
        const double value = sample_of(seen_, static_cast<std::size_t>(column - numbers_.begin()));
        look_at(sample_time(seen_), last_value_.value_or(value), value);
    }
}

void Scope::forget_old(Instant now) {
    const Instant from = (state_ == ScopeState::triggered ? triggered_at_ : now) - settings_.pre;
    while (!edges_.empty() && edges_.front().at < from) {
        base_[edges_.front().channel] = edges_.front().value;
        edges_.pop_front();
    }
}

void Scope::slice(Instant now) {
    if (state_ != ScopeState::armed && state_ != ScopeState::triggered) return;
    if (recorder_) recorder_->drain();
    for (NumericChannel& number : numbers_)
        if (number.channel->reader != ChannelReader::anytime) number.slow = number.channel->read();
    if (state_ == ScopeState::armed) {
        look_for_trigger();
        if (trigger_place_ == nowhere && now - armed_at_ >= settings_.pre) {
            state_ = ScopeState::triggered;
            triggered_at_ = now;
        }
    }
    forget_old(now);
    if (state_ == ScopeState::triggered && now >= triggered_at_ - settings_.pre + settings_.length) finish();
}

void Scope::finish() {
    auto capture = std::make_shared<ScopeCapture>();
    const Instant from = triggered_at_ - settings_.pre, to = from + settings_.length;
    capture->number = ++captures_;
    capture->trigger_s = to_seconds(triggered_at_);
    capture->from_s = -to_seconds(settings_.pre);
    capture->to_s = to_seconds(settings_.length - settings_.pre);
    capture->period_s = to_seconds(settings_.period);
    capture->full = full_;
    for (std::size_t i = 0; i < settings_.channels.size(); ++i) {
        const LiveChannel* channel = book_.find(settings_.channels[i]);
        capture->traces.push_back(
            {channel->name, channel->unit, channel->reader == ChannelReader::edges, base_[i], {}, {}});
    }
    for (const ScopeEdge& edge : edges_) {
        if (edge.at > to) break;
        ScopeTrace& trace = capture->traces[edge.channel];
        trace.at.push_back(to_seconds(edge.at - triggered_at_));
        trace.value.push_back(edge.value);
    }
    bool first = true;
    for (std::int64_t row = std::max<std::int64_t>(0, written_ - rows_); row < written_ && !numbers_.empty(); ++row) {
        if (sample_time(row) < from || sample_time(row) > to) continue;
        if (std::exchange(first, false)) capture->first_sample_s = to_seconds(sample_time(row) - triggered_at_);
        for (std::size_t k = 0; k < numbers_.size(); ++k)
            capture->traces[numbers_[k].place].value.push_back(sample_of(row, k));
    }
    capture_ = std::move(capture);
    if (settings_.again) {
        const std::optional<double> level = last_value_;
        restart(to);
        last_value_ = level;
        seen_ = written_;
        return;
    }
    detach();
    state_ = ScopeState::done;
}

nlohmann::json to_json(const ScopeCapture& capture) {
    nlohmann::json traces = nlohmann::json::array();
    for (const ScopeTrace& trace : capture.traces) {
        nlohmann::json one = {
            {"name", trace.name}, {"unit", trace.unit}, {"edges", trace.edges}, {"values", trace.value}};
        if (trace.edges) {
            one["at"] = trace.at;
            one["before"] = trace.before;
        }
        traces.push_back(std::move(one));
    }
    return {{"number", capture.number}, {"trigger_at", capture.trigger_s}, {"from", capture.from_s},
            {"to", capture.to_s},       {"period", capture.period_s},      {"first_sample", capture.first_sample_s},
            {"full", capture.full},     {"traces", std::move(traces)}};
}

}  // namespace motionrack::panel
