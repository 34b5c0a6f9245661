// A chip in its own kernel, with the functions of a host: write, read, advance the time, drive a wire, check the
// interrupt.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/test/commands.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/position_function.hpp>
#include <string>
#include <vector>

namespace motionrack::mcx314::outside {

inline constexpr unsigned X = 1, Y = 2, Z = 4, U = 8;
inline constexpr Duration tick = nanoseconds(125);

/// Records the ticks of the edges of one axis.
class EdgeLog final : public sim::EdgeListener {
  public:
    struct Edge {
        std::int64_t tick = 0;
        int step = 0;
        std::int64_t count = 0;
        friend bool operator==(const Edge&, const Edge&) = default;
    };
    void edges(const sim::EdgeBatch& batch) override {
        for (std::uint32_t i = 0; i < batch.size; ++i)
            list.push_back({(batch.origin + batch.tick * std::int64_t{batch.at[i]}) / outside::tick, batch.step,
                            batch.first_count + batch.step * std::int64_t{i}});
    }
    std::vector<Edge> list;
};

/// Records every change of some wires.
class WireLog final : public sim::Kernel::WireObserver {
  public:
    struct Change {
        std::string wire;
        int level = 0;
        std::int64_t tick = 0;
        friend bool operator==(const Change&, const Change&) = default;
    };
    explicit WireLog(sim::Kernel& kernel) : kernel_(kernel) { kernel.observe_wires(this); }
    void wire_changed(sim::WireId wire, int level, Instant now) override {
        list.push_back({kernel_.wire_name(wire), level, now / outside::tick});
    }
    std::vector<Change> of(const std::string& wire) const {
        std::vector<Change> out;
        for (const Change& change : list)
            if (change.wire == wire) out.push_back(change);
        return out;
    }
    std::vector<Change> list;

  private:
    sim::Kernel& kernel_;
};

/// Subscribes to changes of wires, as a connected card would.
class Follower final : public sim::Device {
  public:
    explicit Follower(sim::Kernel& kernel) : kernel_(kernel), id_(kernel.add(*this, sim::Phase::parts, "follower")) {}
    void listen(const std::string& wire) { kernel_.listen(kernel_.find_wire(wire), id_, 0); }
    void follow(const std::string& wire, bool wanted) { kernel_.subscribe(kernel_.find_wire(wire), id_, wanted); }
    void on_scheduled(Instant) override {}

  private:
    sim::Kernel& kernel_;
    sim::DeviceId id_;
};

/// A position set by the test, as the encoder connected to xeca and xecb.
class HandWheel final : public sim::PositionFunction {
  public:
    std::int64_t count(Instant) const override { return count_; }
    double rate(Instant) const override { return 0; }
    void watch(int, std::int64_t below, std::int64_t above) override { below_ = below, above_ = above; }
    int add_listener(sim::PositionListener& listener) override { return listener_ = &listener, 0; }
    void set_edge_listener(sim::EdgeListener*) override {}
    void deliver_edges() override {}
    /// Moves count by count to `to`, and notifies watches.
    void turn(std::int64_t to, Instant now) {
        while (count_ != to) {
            count_ += to > count_ ? 1 : -1;
            if ((count_ > below_ || below_ == sim::unwatched_below) &&
                (count_ < above_ || above_ == sim::unwatched_above))
                continue;
            ++crossings;
            if (listener_ != nullptr) listener_->crossed(now);
        }
    }
    int crossings = 0;

  private:
    std::int64_t count_ = 0;
    std::int64_t below_ = sim::unwatched_below, above_ = sim::unwatched_above;
    sim::PositionListener* listener_ = nullptr;
};

/// Advances the time by `time`, also if an interrupt breaks the run.
inline void advance(sim::Kernel& kernel, Duration time) {
    const Instant until = kernel.now() + time;
    while (kernel.run_until(until) == sim::RunEnd::broken) {
    }
}

class Bench : public Commands<Bench> {
  public:
    explicit Bench(Variant variant = Variant::mcx314) : Bench(ChipOptions{variant}) {}
    explicit Bench(const ChipOptions& options) : chip(kernel, "c", options) {}

    // ---- the bus
    void write(int number, unsigned value) {
        chip.write(static_cast<std::uint32_t>(2 * number), static_cast<std::uint16_t>(value));
    }
    unsigned read(int number) { return chip.read(static_cast<std::uint32_t>(2 * number)); }
    unsigned status(unsigned axis, int number) {
        command(axis, 0x0F);
        return read(number);
    }
    std::int32_t counter(unsigned axis, unsigned code) {
        command(axis, code);
        const std::uint32_t low = read(6);
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(read(7)) << 16 | low);
    }
    std::int32_t lp(unsigned axis) { return counter(axis, 0x10); }
    std::int32_t ep(unsigned axis) { return counter(axis, 0x11); }
    std::int32_t cv(unsigned axis) { return counter(axis, 0x12); }
    /// Writes R, SV, V, A and D, and AO = 0.
    void speeds(unsigned axes, std::int64_t r, std::int64_t sv, std::int64_t v, std::int64_t a = 200) {
        data(axes, 0x00, r);
        data(axes, 0x04, sv);
        data(axes, 0x05, v);
        data(axes, 0x02, a);
        data(axes, 0x03, a);
        data(axes, 0x0D, 0);
    }

    // ---- time and wires
    void start() { kernel.start(); }
    void advance(Duration time) { outside::advance(kernel, time); }
    /// Runs until the interrupt line is active or `time` has passed; returns true if it is active.
    bool wait(Duration time) {
        const Instant until = kernel.now() + time;
        while (!interrupt() && kernel.now() < until) kernel.run_until(until);
        return interrupt();
    }
    /// Runs until none of the axes drives, at most `max_duration`; returns false if any still drives.
    bool finish(unsigned axes, Duration max_duration = whole_seconds(100)) {
        const Instant until = kernel.now() + max_duration;
        while ((read(0) & axes) != 0 && kernel.now() < until) advance(microseconds(50));
        return (read(0) & axes) == 0;
    }
    void wire(const std::string& pin, int level) {
        kernel.force(kernel.find_wire("c." + pin), level);
        kernel.settle();
    }
    int level(const std::string& pin) { return kernel.level(kernel.find_wire("c." + pin)); }
    bool interrupt() { return kernel.level(chip.interrupt_wire()) == 0; }
    std::int64_t count(int axis) { return chip.pulses(axis).count(kernel.now()); }

    sim::Kernel kernel;
    Chip chip;
};

}  // namespace motionrack::mcx314::outside
