// The RTC5 on the wires of a rack: Engine in virtual time.
//
//   enc0_a ─┐ enc0_b ─┐ ..  start_n ─┐ mcbsp ─┐          tick k is at k * 10 us; it sees the changes before
//   ────────▼─────────▼──────────────▼────────▼──┬──────────┬──    that instant and outputs x, y and the laser's
//                                             tick k     tick k+1  changes of its 10 us
//
// While stationary and without listeners for x and y, the card schedules nothing; it executes pending ticks on demand.
#pragma once

#include <array>
#include <motionrack/cards/rtc5/model/conditions.hpp>
#include <motionrack/cards/rtc5/model/engine.hpp>
#include <motionrack/sim/blocks/snapshot_state.hpp>
#include <motionrack/sim/kernel.hpp>
#include <string>

namespace motionrack::rtc5 {

class Card final : public sim::DeferringDevice, private Sink {
  public:
    /// Adds the card and its wires "<name>.<pin>" to the kernel. `settings` must pass check().
    Card(sim::Kernel& kernel, const std::string& name, const Settings& settings = {});

    /// Returns the engine for commands and answers, advanced to the present instant. Allowed only between runs; a run
    /// invalidates the reference.
    Engine& engine();
    /// Returns the engine read-only, without advancing it to the present instant.
    const Engine& engine() const { return engine_; }
    /// Returns the engine read-only, advanced to the present instant; also allowed during a run.
    const Engine& caught_up();
    /// Copies the data that a snapshot does not contain: see Engine::copy_beside_state().
    void copy_beside_state(const Card& other) { engine_.copy_beside_state(other.engine_); }
    /// Sets the receiver of the samples and laser changes of every executed tick; nullptr: none. It must not call the
    /// card.
    void watch(Sink* sink) { watcher_ = sink; }
    sim::DeviceId id() const { return id_; }
    sim::WireId busy_wire() const;

    void on_scheduled(Instant now) override;
    void on_wire(int pin, int level, Instant now) override;
    int level_at(int pin, Instant now) const override;
    void wanted_changed(int pin, bool wanted, Instant now) override;
    void sync(Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(engine_.mutable_state()); }

  private:
    /// State of the input wires, and pending changes of the laser's wire.
    struct WireLevels {
        std::array<std::int64_t, encoder_count> levels{};  ///< lines A and B of an encoder as bits 0 and 1
        std::array<std::int64_t, encoder_count> changed_at{-1, -1}, last_step{};
        std::int64_t change_count = 0;
        std::array<std::int64_t, 2 * half_us_per_tick>
            changes{};  ///< ticks of the kernel; levels alternate from !laser
        std::int64_t laser = 0, reported_unwritten = 0, reported_flags = 0, reported_lost = 0;
    };

    void samples(const Samples& block) override {
        if (watcher_ != nullptr) watcher_->samples(block);
    }
    void laser(std::int64_t half_us, bool on) override;
    void catch_up(Instant now);
    void plan(Instant now);
    void put_out();
    void count_line(std::size_t encoder, std::int64_t bit, int level, Instant now);
    void notify();
    void report(CardCondition code, std::int64_t a, std::int64_t tick);
    sim::WireId wire(std::size_t pin) const { return wires_[pin]; }

    sim::Kernel& kernel_;
    Engine engine_;
    sim::DeviceId id_{};
    std::array<sim::WireId, std::size(map::pins)> wires_{};
    WireLevels lines_;
    Sink* watcher_ = nullptr;
    sim::SnapshotState lists_, inputs_;
};

}  // namespace motionrack::rtc5
