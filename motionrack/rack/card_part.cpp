// A card as a part: the quantities and faults that it names itself, and the values of its faults.
#include <algorithm>
#include <array>
#include <motionrack/base/result.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/table_part.hpp>

namespace motionrack::rack {

namespace {

/// Less than half a period, in steps of 0.1 ns.
double max_frame_jitter_ns(const RackCard& card) {
    return std::min(card.grating_bus.period_us * 500 - 0.1, max_push);
}

/// Faults of all types of card; each card names those that it has.
constexpr std::array<FaultRow<RackCard>, 11> card_faults = {{
    {"watchdog.hang", 0, 1, "", "1: the firmware hangs until the watchdog restarts it"},
    {"esl.broken", 0, 1, "", "1: the wire of the limit switch on the left is broken; 0 repairs it"},
    {"esr.broken", 0, 1, "", "1: the wire of the limit switch on the right is broken; 0 repairs it"},
    {"ems.broken", 0, 1, "", "1: the wire of the emergency stop is broken; 0 repairs it"},
    {"ref.broken", 0, 1, "", "1: the wire of the reference switch is broken; 0 repairs it"},
    {"off", 0, 1, "", "1: the card has no power; 0: power returns, the card is reset"},
    {"reset", 0, 1, "", "1: the card is reset"},
    {"late", 0, max_push, "ns", "delay of the frames of the slave"},
    {"miss_edge", 0, max_push, "edges", "number of the next edges of HOLD that the slave misses"},
    {"jitter", 0, 0, "ns", "maximum delay of the host's frames", nullptr, max_frame_jitter_ns},
    {"no_latch", 0, 1, "", "1: the decoder does not latch its counts; 0 repairs it"},
}};

class CardPart final : public Part {
  public:
    CardPart(Card& card, const RackCard& config) : card_(card), config_(config) {}

    const std::string& name() const override { return card_.name(); }
    std::string subject() const override { return "Card " + name(); }
    bool is_card() const override { return true; }
    std::vector<Quantity> quantities() override {
        std::vector<Quantity> out;
        for (const std::string_view one : card_.quantity_names())
            out.push_back({std::string(one), card_.quantity_doc(one), ValueKind::measures,
                           [&card = card_, one](Instant) { return *card.quantity(one); }});
        return out;
    }
    std::optional<double> quantity(std::string_view quantity_name, Instant) override {
        return card_.quantity(quantity_name);
    }

    std::vector<std::string_view> fault_names() const override {
        const std::span<const std::string_view> names = card_.fault_names();
        return {names.begin(), names.end()};
    }
    FaultRange fault_range(std::string_view fault) const override {
        const FaultRow<RackCard>* row = find_row(std::span<const FaultRow<RackCard>>(card_faults), fault);
        MOTIONRACK_ASSERT(row != nullptr);  // a test covers all rows
        return range_of_row(*row, config_);
    }
    sim::DeviceId device_of(std::string_view) const override { return card_.device(); }
    bool inject(sim::Kernel& kernel, std::string_view fault, double value) override {
        return card_.fault(fault, value, kernel.now());
    }

  private:
    Card& card_;
    const RackCard& config_;
};

void add_card_parts(Rack& rack, std::vector<std::unique_ptr<Part>>& parts) {
    for (std::size_t i = 0; i < rack.cards().size(); ++i)
        parts.push_back(std::make_unique<CardPart>(*rack.cards()[i], rack.config().cards[i]));
}

}  // namespace

constinit const PartKind card_part_kind = {"card", add_card_parts, nullptr, nullptr};

}  // namespace motionrack::rack
