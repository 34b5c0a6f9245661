// A motion card: the logic that reads frames, two buffers, and the registers of the processor.
//
//   bus ◄── shifters ──► [ sequence S0 .. S12 ] ──► [ A | B ] ──claim──► registers ──► processor
//
// The bus steps the card, or, in undisturbed operation, passes whole frames to it.
#pragma once

#include <motionrack/cards/grating_bus/model/card_state.hpp>
#include <motionrack/cards/grating_bus/model/card_wires.hpp>
#include <motionrack/cards/grating_bus/model/error_counters.hpp>
#include <motionrack/cards/grating_bus/model/frame_age.hpp>
#include <motionrack/cards/grating_bus/model/frame_assembler.hpp>
#include <motionrack/cards/grating_bus/model/frame_pulses.hpp>
#include <motionrack/cards/grating_bus/model/line_outputs.hpp>
#include <motionrack/cards/grating_bus/model/lines.hpp>
#include <motionrack/cards/grating_bus/model/moment.hpp>
#include <motionrack/cards/grating_bus/model/settings.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/register_device.hpp>
#include <string>

namespace motionrack::grating_bus {

class Bus;
class Card;

/// Listener for every frame of a card; the kernel's run calls it at the virtual instant of the event.
class FrameListener {
  public:
    virtual ~FrameListener() = default;
    /// Reports that the card enters S1; `now` is the time of the frame.
    virtual void began(const Card& card, Instant now) { (void)card, (void)now; }
    /// Reports that the card enters S12 and has published `frame`.
    virtual void published(const Card& card, const Frame& frame, Instant now) = 0;
};

class Card final : public sim::Device, public sim::RegisterDevice {
  public:
    /// Adds the card and its wires "<name>.<pin>" to the kernel, and plugs it into the bus; before the kernel starts.
    /// `settings` must pass check().
    Card(sim::Kernel& kernel, const std::string& name, Bus& bus, const CardSettings& settings = {});
    Card(const Card&) = delete;
    Card& operator=(const Card&) = delete;

    // ---- the processor's interface: offsets of the map
    std::uint16_t read(std::uint32_t offset) override;
    void write(std::uint32_t offset, std::uint16_t value) override;
    std::uint16_t peek(std::uint32_t offset) const override;

    // ---- inspection
    const CardSettings& settings() const { return settings_; }
    sim::DeviceId id() const { return id_; }
    sim::WireId interrupt_wire() const { return wires_.interrupt(); }
    bool is_host() const { return settings_.role == CardRole::host; }
    bool is_remote() const { return settings_.role == CardRole::remote; }
    /// Returns the frame published last; nullptr: none yet, or it is being overwritten.
    const Frame* last() const { return frames_.last(); }
    bool stale() const { return age_.stale(); }
    /// Returns the instant from which the frame published last ages: its time; on a remote card, its arrival.
    Instant held_since() const { return age_.held_since(); }
    bool off() const { return state_.off != 0; }
    Moment moment() const;
    /// Return the number of published frames, and of bad frames and errors.
    std::uint32_t frames() const { return frames_.published(); }
    using enum ErrorCountersState::Counter;
    std::uint16_t counter(ErrorCounter which) const { return errors_[which]; }

    /// Delivers a frame of another crate's bus to a remote card, between two runs of the kernel. The card drops a frame
    /// with a wrong CRC or a wrong number of scales as bad.
    void take(const Frame& frame, Instant now);
    /// Sets the analog output (0 .. 3) to `microvolts`, +-10 V at most.
    void put_out(int output, int microvolts) { wires_.put_out(output, microvolts); }

    void add_listener(FrameListener& listener) { listeners_.push_back(&listener); }

    void on_scheduled(Instant) override {}
    int level_at(int pin, Instant now) const override;
    void wanted_changed(int pin, bool wanted, Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }
    bool fault(std::string_view name, double value, Instant now) override;

  private:
    friend class Bus;
    struct SequenceActions;

    bool idle() const { return state_.fsm == State::S0 && state_.starts == never; }
    /// Returns the next instant at which the card is due.
    Instant next() const;

    // sequence.cpp: called by the bus, in this order at one instant
    void sample(const Lines& lines, Instant now);
    void advance(Instant now);
    void clock_rose(Instant now);
    void begin(Instant now);
    void drive(Lines& lines, int driver) const { lines_.drive(lines, driver, off()); }

    void report_begin(Instant now) {
        for (FrameListener* listener : listeners_) listener->began(*this, now);
    }
    /// Ends the present frame. `like`: a frame with the same counts and a known CRC, or nullptr.
    void publish(Instant now, const Frame* like);
    /// Publishes the current buffer; its age counts from `since`.
    void hand_out(Instant now, Instant since);
    /// Continues a frame that began at `start` from its state at `now`.
    void take_up(Instant start, const Latched& latched, Instant now);

    void enter(State state, Instant now);
    void pulse(Instant now);
    void reset();

    sim::Kernel& kernel_;
    CardSettings settings_;
    Bus& bus_;
    CardState state_{};
    sim::DeviceId id_;
    ErrorCounters errors_;
    FramePulses pulses_;
    LineOutputs lines_;
    FrameAge age_;
    FrameAssembler frames_;
    CardWires wires_;
    std::vector<FrameListener*> listeners_;
};

}  // namespace motionrack::grating_bus
