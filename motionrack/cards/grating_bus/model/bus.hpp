// The bus of a crate: steps its cards and decoders through the instants at which something happens on it.
//
//   host ──clk hold read_n addr──►┌─────┐◄──data── decoder ◄── scales
//   slave 1 ◄─────────────────────┤ bus │
//   slave 2 ◄─────────────────────└─────┘
//
// While one host drives, everybody is set alike, nobody is late and nobody looks at single lines, a frame is one step:
// the decoder is latched at the pulse and every card gets the counts at S12 (a "span"). Whatever disturbs that within a
// frame makes the bus take the frame up where it is and go on state by state.
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
    /// Its wires by number: the lines, whether there is a conflict, then addr and data bit by bit.
    static constexpr int vector_pins = 5, conflict_pin = 5, addr_pins = 6,
                         data_pins = addr_pins + bits_of_line(Line::addr),
                         pin_count = data_pins + bits_of_line(Line::data);

    /// Adds the bus and its wires "<name>.clk", "<name>.addr", "<name>.addr0", "<name>.conflict" .. to the kernel.
    explicit Bus(sim::Kernel& kernel, const std::string& name = "bus");

    // ---- before the kernel starts; the order of plugging is the drivers' numbering
    void plug(Card& card);
    void plug(Decoder& decoder);

    // ---- looking
    const std::vector<Card*>& cards() const { return cards_; }
    const std::vector<Decoder*>& decoders() const { return decoders_; }
    /// The name of driver `n` as the kernel has it.
    const std::string& driver_name(int n) const;
    /// "bus.clk", "bus.addr3" .. of all its wires.
    const std::vector<std::string>& wire_names() const { return wire_names_; }
    /// A line's level now.
    std::uint32_t level(Line line) const;
    const Lines& lines() const { return state_.lines; }
    sim::DeviceId id() const { return id_; }
    /// Whether the frame under way is one step.
    bool in_span() const { return state_.span != 0; }
    Instant span_start() const { return state_.start; }

    void on_scheduled(Instant now) override;
    int level_at(int pin, Instant now) const override;
    void wanted_changed(int pin, bool wanted, Instant now) override;
    void forced_changed(int pin, bool forced, int level, Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

    // ---- for its cards
    /// From `now` on the bus goes state by state, until the next pulse at least.
    void interrupt_span(Instant now);
    /// The same, if a frame is under way.
    void leave_frame(Instant now) {
        if (state_.span != 0 && state_.published == 0) interrupt_span(now);
    }
    /// After anything that a card or decoder drives, or when it is next due, has changed.
    void look_again(Instant now);
    /// Somebody began or ceased to look at a wire of a card.
    void wanted(bool wanted, Instant now);

  private:
    struct State {
        Lines lines;
        std::uint32_t span = 0;       // the frame under way, and what follows until the next pulse, is one step
        std::uint32_t published = 0;  // of a span: S12 has been
        Instant start{};              // of the span
        Instant done = never;         // of the span: S12
        std::uint32_t wanted = 0;     // wires of the bus and its cards that somebody looks at
        std::uint32_t clk_was = 0;
        std::uint32_t told = 0;  // conflicts were reported, a bit a line
        std::uint32_t begun = 0;
    };
    static_assert(std::has_unique_object_representations_v<State>, "padding would get into the state's hash");

    /// All cards are in: their directions are looked at.
    void begin();
    bool regular() const;
    void begin_span(Instant now);
    void publish_span(Instant now);
    void step(Instant now);
    void settle(Instant now);
    /// All cards put on the lines what they drive.
    void drive();
    /// Hosts that have just pulled READ low look at it, and give their address if it is low. Whether one looked.
    bool give_addresses();
    void schedule();
    void show();
    const CardSettings& host() const { return cards_[static_cast<std::size_t>(host_)]->settings(); }
    /// What the decoder drives, or drove last, at `now` of the span, and when the next count comes out.
    struct Output {
        std::uint32_t out;
        Instant next;
    };
    Output span_output(Instant now) const;
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
    int host_ = -1;       // the one host's index in cards_; -1: none or several
    bool alike_ = false;  // all cards are set alike and fit the one decoder, whatever happens to them
    State state_{};
};

}  // namespace motionrack::grating_bus
