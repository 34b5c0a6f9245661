// The virtual DataBoard 4002: ports in front, an 8748's firmware behind, exact to the pass of the firmware (RULES.md).
//
//          C2, C4, DATA  ┌───────────┐ rate, dir ┌─────────┐ pulses   fout
//   host ───────────────►│ firmware  ├──────────►│ divider ├────────►
//          Ready, STAT   └─▲───▲───▲─┘     │     └────▲────┘
//                          │   │   │       └─► volts ─┴─ gate ◄── esl, esr      vout, sign, relay
//               counter ◄──┘   │   └── stops ◄──────────────────── ems
//               o1, o2   zero, ref
//
// The model does not poll. It computes only the passes that can have an effect: an access is due, the counter leaves
// the interval of the table, or a wire changes. The cost of a move depends on its slope steps, not on its counts.
#pragma once

#include <cstdint>
#include <motionrack/cards/databoard4002/model/command_collector.hpp>
#include <motionrack/cards/databoard4002/model/condition_reporter.hpp>
#include <motionrack/cards/databoard4002/model/event_register.hpp>
#include <motionrack/cards/databoard4002/model/host_ports.hpp>
#include <motionrack/cards/databoard4002/model/output_stage.hpp>
#include <motionrack/cards/databoard4002/model/pass_schedule.hpp>
#include <motionrack/cards/databoard4002/model/pins.hpp>
#include <motionrack/cards/databoard4002/model/position_counter.hpp>
#include <motionrack/cards/databoard4002/model/positioner.hpp>
#include <motionrack/cards/databoard4002/model/settings.hpp>
#include <motionrack/cards/databoard4002/model/state.hpp>
#include <motionrack/cards/databoard4002/model/watchdog.hpp>
#include <motionrack/sim/byte_device.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/position_function.hpp>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::databoard4002 {

class Card final : public sim::DeferringDevice,
                   public sim::ByteDevice,
                   private sim::PositionListener,
                   private sim::PulseTrain::Owner {
  public:
    /// Adds the card and its wires "<name>.<pin>" to the kernel. `settings` must pass check().
    Card(sim::Kernel& kernel, const std::string& name, const Settings& settings = {});
    Card(const Card&) = delete;
    Card& operator=(const Card&) = delete;

    // ---- the bus: valid while the card is selected
    std::uint8_t in(std::uint8_t port) override;
    void out(std::uint8_t port, std::uint8_t value) override;
    std::uint8_t peek(std::uint8_t port) const override;

    // ---- the machine side
    /// FOUT as a position over time: pulses since power-up, signed by SIGN.
    sim::PositionFunction& pulses() { return outputs_.train(); }
    /// Connects the source that turns the encoder at O1 and O2, in counts of all edges (method 1: in counts); before
    /// the kernel starts. Without a source the card counts the wires o1 and o2.
    void connect_encoder(sim::PositionFunction& counts);
    /// Disconnects the source and forces the wires o1 and o2 to its present levels (`taken`), or releases them and
    /// reconnects it. While disconnected, the card counts the forced levels.
    void take_encoder(bool taken);

    // ---- inspection
    /// Returns the counter, -8,388,608 .. 8,388,607.
    std::int32_t position() const { return static_cast<std::int32_t>(signed24(counter_.value(kernel_.now()))); }
    bool moving() const { return positioner_.moving(); }
    bool locked() const { return positioner_.locked(); }
    bool hung() const { return watchdog_.hung(); }
    /// Rate at the output, negative backwards; 0 at standstill.
    int output_rate() const { return outputs_.signed_rate(); }
    /// FOUT in Hz, 0 without pulses.
    double fout_hz() const { return outputs_.fout_hz(); }
    std::uint8_t event_word() const { return events_.word(); }
    const SlopeTable& table() const { return positioner_.table(); }
    const Settings& settings() const { return settings_; }
    sim::DeviceId id() const { return id_; }
    sim::WireId interrupt_wire() const { return pins_.wire(interrupt_pin); }

    void on_scheduled(Instant now) override;
    void on_wire(int pin, int level, Instant now) override;
    int level_at(int pin, Instant now) const override;
    void wanted_changed(int pin, bool wanted, Instant now) override;
    void sync(Instant now) override { outputs_.sync(now); }
    std::span<std::byte> state() override { return sim::bytes_of(state_); }
    /// Sets or clears a fault: watchdog.hang (the firmware hangs); esl.broken, esr.broken, ems.broken, ref.broken (the
    /// input's wire is broken, so the input is active).
    bool fault(std::string_view name, double value, Instant now) override;
    static std::span<const std::string_view> fault_names();

  private:
    void reschedule();
    void begin();
    void reset();
    void pass(Instant now);
    void access(Work kind, std::uint8_t port, std::uint8_t value);
    void look_at_zero(Instant now);
    void crossed(Instant now) override;
    void rate_changed(double before, double rate, Instant now) override;

    void train_watched() override { reschedule(); }
    Instant train_now() const override { return kernel_.now(); }

    sim::Kernel& kernel_;
    Settings settings_;
    State state_{};
    sim::DeviceId id_;
    ConditionReporter conditions_;
    PassSchedule passes_;
    Watchdog watchdog_;
    Pins pins_;
    PositionCounter counter_;
    EventRegister events_;
    Positioner positioner_;
    OutputStage outputs_;
    CommandCollector commands_;
    HostPorts ports_;
};

}  // namespace motionrack::databoard4002
