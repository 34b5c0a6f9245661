// The bus of a crate: steps its cards and decoders through the instants at which the bus changes.
//
//   host ──clk hold read_n addr──►┌─────┐◄──data── decoder ◄── scales
//   slave 1 ◄─────────────────────┤ bus │
//   slave 2 ◄─────────────────────└─────┘
//
// A frame is one step (a "span") while a single host drives, all cards have equal settings and timing, and no listener
// watches single lines. The decoder is then latched at the pulse, and every card receives the counts at S12. A
// disturbance within a frame makes the bus continue from the present state, state by state.
#pragma once

#include <motionrack/cards/grating_bus/model/card.hpp>
#include <motionrack/cards/grating_bus/model/decoder.hpp>
#include <motionrack/cards/grating_bus/model/lines.hpp>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <vector>

namespace motionrack::grating_bus {

class Bus final : public sim::Device {
  public:
    /// Wires of the bus by number: the lines, the conflict flag, then addr and data bit by bit.
    static constexpr int vector_pins = 5, conflict_pin = 5, addr_pins = 6,
                         data_pins = addr_pins + bits_of_line(Line::addr),
                         pin_count = data_pins + bits_of_line(Line::data);

    /// Adds the bus and its wires "<name>.clk", "<name>.addr", "<name>.addr0", "<name>.conflict" .. to the kernel.
    explicit Bus(sim::Kernel& kernel, const std::string& name = "bus");

    // ---- before the kernel starts; drivers are numbered in the order of plugging
    void plug(Card& card);
    void plug(Decoder& decoder);

    // ---- inspection
    const std::vector<Card*>& cards() const { return cards_; }
    const std::vector<Decoder*>& decoders() const { return decoders_; }
    /// Returns the name of driver `n` in the kernel.
    const std::string& driver_name(int n) const;
    /// Returns the names of all bus wires: "bus.clk", "bus.addr3" ..
    const std::vector<std::string>& wire_names() const { return wire_names_; }
    /// Returns the present level of a line, bit by bit.
    std::uint32_t level(Line line) const;
    const Lines& lines() const { return state_.lines; }
    sim::DeviceId id() const { return id_; }
    /// Returns true while the present frame is processed as one step.
    bool in_span() const { return state_.span != 0; }
    Instant span_start() const { return state_.start; }

    void on_scheduled(Instant now) override;
    int level_at(int pin, Instant now) const override;
    void wanted_changed(int pin, bool wanted, Instant now) override;
    void forced_changed(int pin, bool forced, int level, Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

    // ---- for the cards of the bus
    /// Ends the span: from `now` on, steps state by state, at least until the next pulse.
    void interrupt_span(Instant now);
    /// Calls interrupt_span() if a span is in progress whose frame is not published yet.
    void leave_frame(Instant now) {
        if (state_.span != 0 && state_.published == 0) interrupt_span(now);
    }
    /// Reacts to a change of the outputs of a card or a decoder, or of its next due instant.
    void look_again(Instant now);
    /// Records that a wire of a card has got or lost its listeners.
    void wanted(bool wanted, Instant now);

  private:
    struct State {
        Lines lines;
        std::uint32_t span = 0;       // the present frame, up to the next pulse, is one step
        std::uint32_t published = 0;  // the span has passed S12
        Instant start{};              // start of the span
        Instant done = never;         // S12 of the span
        std::uint32_t wanted = 0;     // watched wires of the bus and its cards
        std::uint32_t clk_was = 0;
        std::uint32_t reported = 0;  // reported conflicts, one bit per line
        std::uint32_t begun = 0;
    };
    static_assert(std::has_unique_object_representations_v<State>, "padding would get into the state's hash");

    /// Checks the directions after all cards are plugged in.
    void begin();
    bool regular() const;
    void begin_span(Instant now);
    void publish_span(Instant now);
    void step(Instant now);
    void settle(Instant now);
    /// Puts the outputs of all cards on the lines.
    void drive();
    /// Lets hosts that have just pulled READ low sample it, and give their address if it is low. Returns whether one
    /// did.
    bool give_addresses();
    void schedule();
    void show();
    const CardSettings& host() const { return cards_[static_cast<std::size_t>(host_)]->settings(); }
    /// The data that the decoder outputs at `now` within a span, and the instant at which it outputs the next count.
    struct DecoderOutput {
        std::uint32_t out;
        Instant next;
    };
    DecoderOutput span_output(Instant now) const;
    std::uint32_t span_level(Line line, Instant now) const;
    std::uint32_t wire_level(int pin, Instant now) const;

    sim::Kernel& kernel_;
    sim::DeviceId id_{};
    std::array<sim::WireId, pin_count> wires_{};
    std::vector<std::string> wire_names_;
    std::vector<Card*> cards_;
    std::vector<Decoder*> decoders_;
    std::vector<sim::DeviceId> drivers_;
    std::vector<int> card_driver_, decoder_driver_;
    int host_ = -1;       // index of the only host in cards_; -1: none or several
    bool alike_ = false;  // all cards have equal settings that fit the only decoder, apart from faults
    State state_{};
};

}  // namespace motionrack::grating_bus
