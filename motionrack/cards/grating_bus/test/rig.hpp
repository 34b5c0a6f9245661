// A crate: moving scales, a decoder, motion cards on one bus, and a listener for every frame.
#pragma once

#include <memory>
#include <motionrack/cards/grating_bus/model/bus.hpp>
#include <string>
#include <vector>

namespace motionrack::grating_bus {

/// Motion at a constant velocity in whole counts: count(t) = from + t * per_second / 1e10, t in ticks, rounded down.
class EvenMotion final : public sim::PositionFunction {
  public:
    EvenMotion(std::int64_t from, std::int64_t per_second) : from_(from), per_second_(per_second) {}
    std::int64_t count(Instant t) const override {
        __extension__ using Wide = __int128;
        const Wide distance = Wide{t.count()} * per_second_;
        constexpr std::int64_t second = whole_seconds(1).count();
        return from_ + static_cast<std::int64_t>(distance / second) - (distance % second < 0);
    }
    double rate(Instant) const override { return static_cast<double>(per_second_); }
    void watch(int, std::int64_t, std::int64_t) override {}
    int add_listener(sim::PositionListener&) override { return 0; }
    void set_edge_listener(sim::EdgeListener*) override {}
    void deliver_edges() override {}

  private:
    std::int64_t from_, per_second_;
};

/// A frame and the instant at which it was published.
struct Heard {
    Instant at{};
    Frame frame;
};

class RecordingListener final : public FrameListener {
  public:
    void published(const Card&, const Frame& frame, Instant now) override { heard.push_back({now, frame}); }
    std::vector<Heard> heard;
};

/// Returns a constant speed in counts/s for each scale.
inline std::vector<std::int64_t> speeds(int scales) {
    std::vector<std::int64_t> out;
    for (int n = 0; n < scales; ++n) out.push_back((n % 2 == 0 ? 1 : -1) * (20'000'000 - 1'234'567 * (n % 13)));
    return out;
}

/// Subscribes to wires on request.
class Watcher final : public sim::Device {
  public:
    explicit Watcher(sim::Kernel& kernel) : kernel_(kernel), id_(kernel.add(*this, sim::Phase::observers, "watcher")) {}
    void connect() {
        for (std::size_t i = 0; i < kernel_.wire_count(); ++i) kernel_.listen(static_cast<sim::WireId>(i), id_, 0);
    }
    void watch(bool on) {
        for (std::size_t i = 0; i < kernel_.wire_count(); ++i) kernel_.subscribe(static_cast<sim::WireId>(i), id_, on);
    }
    void on_scheduled(Instant) override {}

  private:
    sim::Kernel& kernel_;
    sim::DeviceId id_;
};

struct Crate {
    explicit Crate(const std::vector<CardSettings>& settings, int scales = 4,
                   const DecoderSettings& decoder_settings = {}, bool hear = true) {
        DecoderSettings own = decoder_settings;
        own.scales = scales;
        decoder = std::make_unique<Decoder>(kernel, "decoder", bus, own);
        for (const std::int64_t speed : speeds(scales)) {
            motions.push_back(std::make_unique<EvenMotion>(1'000 * speed % 77'777, speed));
            decoder->connect(static_cast<int>(motions.size()) - 1, motions.back().get());
        }
        for (const CardSettings& s : settings) {
            listeners.push_back(std::make_unique<RecordingListener>());
            cards.push_back(
                std::make_unique<Card>(kernel, std::string("c").append(std::to_string(cards.size())), bus, s));
            if (hear) cards.back()->add_listener(*listeners.back());
        }
        watcher.connect();
        kernel.start();
    }
    void run(Duration time) { run_to(kernel.now() + time); }
    void run_to(Instant at) {
        while (kernel.run_until(at) == sim::RunEnd::broken) {  // an interrupt
        }
    }
    /// Starts or stops watching all wires.
    void watch_wires(bool on = true) { watcher.watch(on); }
    std::uint16_t status(std::size_t card) const { return cards[card]->peek(offset("STATUS")); }
    const std::vector<Heard>& heard(std::size_t card) const { return listeners[card]->heard; }
    std::int64_t truth(int scale, Instant at) const { return motions[static_cast<std::size_t>(scale)]->count(at); }
    std::vector<std::string> sentences() const {
        std::vector<std::string> out;
        for (const sim::Condition& c : kernel.conditions())
            out.push_back(c.device == bus.id() ? describe(c, bus) : describe(c, kernel.device_name(c.device)));
        return out;
    }

    sim::Kernel kernel;
    Bus bus{kernel};
    Watcher watcher{kernel};
    std::unique_ptr<Decoder> decoder;
    std::vector<std::unique_ptr<EvenMotion>> motions;
    std::vector<std::unique_ptr<RecordingListener>> listeners;
    std::vector<std::unique_ptr<Card>> cards;
};

inline CardSettings host_settings(int scales = 4) {
    CardSettings out;
    out.role = CardRole::host;
    out.scales = scales;
    return out;
}
inline CardSettings slave_settings(int scales = 4) {
    CardSettings out;
    out.scales = scales;
    return out;
}
/// Returns the settings of a host and of `slaves` slaves.
inline std::vector<CardSettings> crew(int slaves, int scales = 4) {
    std::vector<CardSettings> out{host_settings(scales)};
    out.insert(out.end(), static_cast<std::size_t>(slaves), slave_settings(scales));
    return out;
}

}  // namespace motionrack::grating_bus
