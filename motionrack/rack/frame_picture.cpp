// Draws a frame as waves.
#include <fmt/format.h>

#include <motionrack/rack/frame_monitor.hpp>
#include <motionrack/rack/recorder.hpp>
#include <motionrack/trace/svg_waves.hpp>

namespace motionrack::rack {

namespace {

namespace gb = grating_bus;

std::string state_name(std::uint32_t state) {
    return fmt::format("S{}", state);
}
std::string address_name(std::uint32_t address) {
    return fmt::format("{}", address);
}

/// Collects the changes of selected wires.
class Collector final : public sim::Kernel::WireObserver {
  public:
    struct Chosen {
        sim::WireId wire;
        trace::SvgWave wave;
    };
    void wire_changed(sim::WireId wire, int level, Instant now) override {
        for (Chosen& one : chosen)
            if (one.wire == wire) one.wave.changes.emplace_back(to_seconds(now), static_cast<std::uint32_t>(level));
    }
    std::vector<Chosen> chosen;
};

void choose(Collector& collector, const sim::Kernel& kernel, const std::string& wire, trace::SvgWave wave) {
    const sim::WireId id = kernel.find_wire(wire);
    wave.changes.emplace_back(0, static_cast<std::uint32_t>(kernel.level(id)));
    collector.chosen.push_back({id, std::move(wave)});
}

void choose_all(Collector& collector, const sim::Kernel& kernel, const gb::Bus& bus) {
    for (const gb::Card* card : bus.cards()) {
        const std::string& name = kernel.device_name(card->id());
        choose(collector, kernel, name + ".state", {name, true, {}, state_name, 0});
    }
    for (const gb::LineType& line : gb::line_types) {
        const bool address = line.name == "addr";
        choose(collector, kernel, fmt::format("bus.{}", line.name),
               {std::string(line.name), line.bits > 1, {}, address ? address_name : nullptr, line.rest});
    }
    choose(collector, kernel, "bus.conflict", {"conflict", false, {}, nullptr, 0});
    const gb::Card& first = *bus.cards().front();
    choose(collector, kernel, kernel.device_name(first.id()) + ".frame_done", {"frame_done", false, {}, nullptr, 0});
}

void run_to(sim::Kernel& kernel, Instant at) {
    while (kernel.run_until(at) == sim::RunEnd::broken) {
    }
}

}  // namespace

Result<std::string> frame_picture(const RackConfig& config, int frame) {
    Rack rack(config);
    const gb::Bus* bus = grating_bus_of(rack);
    if (bus == nullptr || bus->cards().empty())
        return fail(ErrorKind::refused,
                    "The rack has no card of type grating_bus, so it has no frames to draw. Nothing was written.");
    RecorderTap tap(rack.kernel());
    rack.start();
    const gb::CardSettings& settings = bus->cards().front()->settings();
    const Duration length = settings.timing.frame_time(settings.scales);
    const Instant from = settings.offset + frame * settings.period;
    run_to(rack.kernel(), from - settings.timing.clock);
    Collector collector;
    choose_all(collector, rack.kernel(), *bus);
    for (const Collector::Chosen& one : collector.chosen) tap.follow(one.wire, true);
    rack.kernel().observe_wires(&collector);
    const Instant end = from + length + length / 8;
    run_to(rack.kernel(), end);
    rack.kernel().observe_wires(nullptr);
    std::vector<trace::SvgWave> waves;
    for (Collector::Chosen& one : collector.chosen) {
        for (auto& change : one.wave.changes) change.first -= to_seconds(from);
        waves.push_back(std::move(one.wave));
    }
    std::vector<trace::SvgMark> marks;
    const int every = std::max(1, settings.scales / 8);
    for (int k = 0; k < settings.scales; k += every)
        marks.push_back({to_seconds(settings.timing.sample_at(k)), fmt::format("word {}", k)});
    const std::string title =
        fmt::format("Frame of {} scales, {} card{}: {:.0f} ns", settings.scales, bus->cards().size(),
                    bus->cards().size() == 1 ? "" : "s", to_seconds(length) * 1e9);
    return trace::svg_waves(title, waves, marks, -to_seconds(settings.timing.clock), to_seconds(end - from),
                            {1300, 0, true});
}

}  // namespace motionrack::rack
