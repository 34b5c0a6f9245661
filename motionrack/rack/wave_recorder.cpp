// Gathering changes and writing them in the order of time.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/wave_recorder.hpp>

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

constexpr Duration longest_pulse = microseconds(5);
constexpr Duration direction_lead = nanoseconds(250);

}  // namespace

class WaveRecorder::StepEar final : public sim::EdgeListener {
  public:
    StepEar(WaveRecorder& recorder, std::uint32_t step, std::uint32_t direction)
        : recorder_(recorder), step_(step), direction_(direction) {}

    void edges(const sim::EdgeBatch& batch) override {
        for (std::uint32_t i = 0; i < batch.size; ++i) {
            const Instant at = batch.origin + batch.at[i] * batch.tick;
            if (high_) recorder_.push(std::min(last_ + (at - last_) / 2, last_ + longest_pulse), step_, 0);
            if (batch.step != sense_) {
                sense_ = batch.step;
                recorder_.push(std::max(high_ ? last_ + (at - last_) / 2 : Instant{0}, at - direction_lead), direction_, sense_ > 0);
            }
            recorder_.push(at, step_, 1);
            last_ = at;
            high_ = true;
        }
    }
    /// No pulse has come for long enough: the last one is over.
    void settle(Instant now) {
        if (!high_ || now - last_ < 2 * longest_pulse) return;
        recorder_.push(last_ + longest_pulse, step_, 0);
        high_ = false;
    }

  private:
    WaveRecorder& recorder_;
    std::uint32_t step_, direction_;
    Instant last_{};
    int sense_ = 0;
    bool high_ = false;
};

class WaveRecorder::LineEar final : public sim::EdgeListener {
  public:
    LineEar(WaveRecorder& recorder, std::uint32_t a, std::uint32_t b) : recorder_(recorder), a_(a), b_(b) {}

    void edges(const sim::EdgeBatch& batch) override {
        std::int64_t count = batch.first_count;
        for (std::uint32_t i = 0; i < batch.size; ++i, count += batch.step) {
            const Instant at = batch.origin + batch.at[i] * batch.tick;
            const auto phase = static_cast<unsigned>(count & 3);  // 0 00, 1 A, 2 AB, 3 B
            recorder_.push(at, a_, phase == 1 || phase == 2);
            recorder_.push(at, b_, phase >= 2);
        }
    }

  private:
    WaveRecorder& recorder_;
    std::uint32_t a_, b_;
};

WaveRecorder::WaveRecorder(Rack& rack, trace::VcdWriter writer, Duration register_period)
    : rack_(rack), writer_(std::move(writer)), register_period_(register_period) {
    buffer_.reserve(buffer_size);
}

WaveRecorder::~WaveRecorder() { rack_.kernel().observe_wires(nullptr); }

Result<std::unique_ptr<WaveRecorder>> WaveRecorder::create(Rack& rack, const WaveSettings& settings) {
    trace::VcdSettings vcd;
    vcd.timescale = settings.timescale;
    vcd.full_names = true;
    MOTIONRACK_TRY(trace::VcdWriter writer, trace::VcdWriter::create(settings.path, vcd));
    std::unique_ptr<WaveRecorder> out(new WaveRecorder(rack, std::move(writer), settings.register_period));
    if (!out->declare(settings))
        return fail(Trouble::bad_input, fmt::format("No signal fits '{}'; nothing was recorded. Signals are called like X.step, X.enc_a or "
                                                    "motion.xlmtp; * and ? stand for anything.", fmt::join(settings.signals, "', '")));
    out->id_ = rack.kernel().add(*out, sim::Phase::observers, "wave recorder");
    rack.kernel().observe_wires(out.get());
    return out;
}

bool WaveRecorder::declare(const WaveSettings& settings) {
    auto wanted = [&](const std::string& name) {
        return settings.signals.empty() ||
               std::any_of(settings.signals.begin(), settings.signals.end(), [&](const std::string& p) { return matches(p, name); });
    };
    sim::Kernel& kernel = rack_.kernel();
    bool any = false;
    wire_ids_.assign(kernel.wire_count(), -1);
    for (RunningAxis& axis : rack_.axes()) {
        const std::string name(1, axis.config.letter);
        writer_.push_scope(name);
        const bool pulses = wanted(name + ".step") || wanted(name + ".dir");
        const bool lines = axis.machine->has_encoder() && (wanted(name + ".enc_a") || wanted(name + ".enc_b"));
        if (pulses) {
            const auto step = writer_.add_wire("step"), direction = writer_.add_wire("dir", true);
            steps_.push_back(std::make_unique<StepEar>(*this, step, direction));
            axis.machine->listen_pulse_edges(steps_.back().get());
        }
        if (lines) {
            const auto a = writer_.add_wire("enc_a"), b = writer_.add_wire("enc_b");
            lines_.push_back(std::make_unique<LineEar>(*this, a, b));
            axis.machine->encoder().listen_edges(lines_.back().get());
        }
        any = any || pulses || lines;
        writer_.pop_scope();
    }
    for (std::size_t i = 0; i < kernel.wire_count(); ++i) {
        const auto wire = static_cast<sim::WireId>(i);
        const std::string& name = kernel.wire_name(wire);
        if (!wanted(name) || kernel.lazy(wire)) continue;
        const std::size_t dot = name.find('.');
        writer_.push_scope(dot == std::string::npos ? "rack" : name.substr(0, dot));
        wire_ids_[i] = writer_.add_wire(dot == std::string::npos ? name : name.substr(dot + 1), kernel.level(wire) != 0);
        writer_.pop_scope();
        any = true;
    }
    for (const auto& card : rack_.cards()) {
        CardSignals signals;
        signals.card = card.get();
        writer_.push_scope(card->name());
        for (int channel = 0; channel < card->channel_count(); ++channel) {
            const std::string letter = card->channel_name(channel);
            if (!wanted(card->name() + "." + letter + "lp")) continue;
            signals.lp.push_back(writer_.add_vector(letter + "lp", 32));
            signals.ep.push_back(writer_.add_vector(letter + "ep", 32));
            any = true;
        }
        writer_.pop_scope();
        if (!signals.lp.empty() && static_cast<int>(signals.lp.size()) == card->channel_count()) cards_.push_back(signals);
    }
    return any;
}

void WaveRecorder::begin() { rack_.kernel().schedule(id_, rack_.kernel().now()); }

void WaveRecorder::push(Instant at, std::uint32_t id, std::uint64_t value) {
    buffer_.push_back({at, id, value});
    if (buffer_.size() > buffer_size / 2) rack_.kernel().break_run();
}

void WaveRecorder::wire_changed(sim::WireId wire, int level, Instant now) {
    const std::int64_t id = wire_ids_[sim::Kernel::index(wire)];
    if (id >= 0) push(now, static_cast<std::uint32_t>(id), level != 0);
}

void WaveRecorder::act(Instant now) {
    look_at_cards(now);
    rack_.kernel().schedule(id_, now + register_period_);
}

void WaveRecorder::look_at_cards(Instant now) {
    for (const CardSignals& signals : cards_)
        for (std::size_t i = 0; i < signals.lp.size(); ++i) {
            push(now, signals.lp[i], static_cast<std::uint32_t>(signals.card->pulse_counter(static_cast<int>(i))));
            push(now, signals.ep[i], static_cast<std::uint32_t>(signals.card->encoder_counter(static_cast<int>(i))));
        }
}

void WaveRecorder::drain() {
    const Instant now = rack_.kernel().now();
    for (const auto& ear : steps_) ear->settle(now);
    std::stable_sort(buffer_.begin(), buffer_.end(), [](const Event& a, const Event& b) { return a.at < b.at; });
    for (const Event& event : buffer_) {
        last_ = std::max(last_, event.at);  // a pulse's end may be told after a later change
        writer_.change(event.id, event.value, last_);
    }
    changes_ += buffer_.size();
    buffer_.clear();
}

Result<void> WaveRecorder::finish() {
    drain();
    rack_.kernel().schedule(id_, never);
    return writer_.close(std::max(rack_.kernel().now(), last_));
}

}  // namespace motionrack::rack
