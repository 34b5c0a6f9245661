// Collects edges and samples, detects the trigger, and extracts a capture.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <motionrack/panel/scope.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::panel {

namespace {

constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

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
        const double shown = channels_[index].shown(value);
        const std::size_t wires = scope_.places_.size();
        if (index >= wires)
            scope_.see_sample(at, scope_.numbers_[index - wires], shown);
        else if (scope_.places_[index] != nowhere)
            scope_.see_edge(at, scope_.places_[index], shown);
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
                    fmt::format("{} channels were chosen; it must be 1 to {}. Nothing was armed.",
                                settings.channels.size(), max_channels));
    if (settings.length <= Duration{0} || settings.pre < Duration{0} || settings.pre > settings.length)
        return fail(ErrorKind::invalid_input,
                    "The length must be above 0, and the part before the trigger within it. Nothing was armed.");
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
    MOTIONRACK_CHECK(record(wires));
    restart(machine_.now());
    return {};
}

Result<void> Scope::record(const std::vector<std::string>& wires) {
    rack::RecorderSettings settings;
    settings.signals = wires;
    settings.period = settings_.period;
    settings.tap = &machine_.instruments().tap();
    for (NumericChannel& number : numbers_) {
        number.slow = number.channel->read();
        settings.sampled.push_back({{number.channel->name, rack::ChannelKind::quantity},
                                    [&number] { return std::bit_cast<std::int64_t>(number.value()); }});
    }
    settings.sink = [this](const rack::Declaration& declared) {
        places_.clear();
        for (std::size_t i = 0; i + numbers_.size() < declared.channels.size(); ++i) {
            const auto found =
                std::find(settings_.channels.begin(), settings_.channels.end(), declared.channels[i].name);
            places_.push_back(found == settings_.channels.end()
                                  ? nowhere
                                  : static_cast<std::size_t>(found - settings_.channels.begin()));
        }
        return std::make_shared<Sink>(*this, declared.channels);
    };
    MOTIONRACK_TRY(recorder_, rack::Recorder::create(machine_.rack(), settings));
    if (!numbers_.empty()) recorder_->begin();
    return {};
}

void Scope::stop() {
    detach();
    if (state_ != ScopeState::done) state_ = ScopeState::idle;
}

void Scope::detach() {
    recorder_.reset();
    edges_.clear();
    for (NumericChannel& number : numbers_) number.samples.clear();
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
void Scope::see_edge(Instant at, std::size_t place, double value) {
    if (place == trigger_place_ && state_ == ScopeState::armed) look_at(at, last_value_.value_or(base_[place]), value);
    if (edges_.size() >= max_edges) {
        if (state_ == ScopeState::triggered) {
            full_ = true;
            return;
        }
        base_[edges_.front().channel] = edges_.front().value;
        edges_.pop_front();
    }
    edges_.push_back({at, place, value});
}

void Scope::see_sample(Instant at, NumericChannel& number, double value) {
    if (number.place == trigger_place_ && state_ == ScopeState::armed) look_at(at, last_value_.value_or(value), value);
    if (number.samples.empty()) number.first = at;
    number.samples.push_back(value);
}

void Scope::forget_old(Instant now) {
    const Instant from = (state_ == ScopeState::triggered ? triggered_at_ : now) - settings_.pre;
    while (!edges_.empty() && edges_.front().at < from) {
        base_[edges_.front().channel] = edges_.front().value;
        edges_.pop_front();
    }
    for (NumericChannel& number : numbers_)
        for (; !number.samples.empty() && number.first < from; number.first += settings_.period)
            number.samples.pop_front();
}

void Scope::slice(Instant now) {
    if (state_ != ScopeState::armed && state_ != ScopeState::triggered) return;
    if (recorder_) recorder_->drain();
    for (NumericChannel& number : numbers_)
        if (number.channel->reader != ChannelReader::anytime) number.slow = number.channel->read();
    if (state_ == ScopeState::armed && trigger_place_ == nowhere && now - armed_at_ >= settings_.pre) {
        state_ = ScopeState::triggered;
        triggered_at_ = now;
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
    for (const NumericChannel& number : numbers_) {
        std::vector<double>& values = capture->traces[number.place].value;
        Instant at = number.first;
        for (auto value = number.samples.begin(); value != number.samples.end() && at <= to; ++value) {
            values.push_back(*value);
            at += settings_.period;
        }
        if (!values.empty()) capture->first_sample_s = to_seconds(number.first - triggered_at_);
    }
    capture_ = std::move(capture);
    if (settings_.again) {
        const std::optional<double> level = last_value_;
        restart(to);
        last_value_ = level;
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
