// A card as a part: the quantities and faults that it names itself, whose values its plug-in has.
#include <algorithm>
#include <motionrack/base/result.hpp>
#include <motionrack/rack/part_catalogue.hpp>
#include <motionrack/rack/rack.hpp>
#include <span>

namespace motionrack::rack {

namespace {

class CardPart final : public Part {
  public:
    CardPart(Card& card, const RackCard& config)
        : card_(card), config_(config), faults_(find_card_plugin(config.type)->faults) {}

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
        const auto row =
            std::find_if(faults_.begin(), faults_.end(), [&](const CardFault& one) { return one.name == fault; });
        MOTIONRACK_ASSERT(row != faults_.end());  // a test covers all rows
        return {std::string(row->unit), row->doc, row->min, row->max_of == nullptr ? row->max : row->max_of(config_)};
    }
    sim::DeviceId device_of(std::string_view) const override { return card_.device(); }
    bool inject(sim::Kernel& kernel, std::string_view fault, double value) override {
        return card_.fault(fault, value, kernel.now());
    }
    std::optional<std::string> describe(const sim::Condition& condition, const sim::Kernel&) const override {
        if (!card_.speaks_for(condition.device)) return std::nullopt;
        return card_.describe(condition);
    }

  private:
    Card& card_;
    const RackCard& config_;
    std::span<const CardFault> faults_;
};

void add_card_parts(Rack& rack, std::vector<std::unique_ptr<Part>>& parts) {
    for (std::size_t i = 0; i < rack.cards().size(); ++i)
        parts.push_back(std::make_unique<CardPart>(*rack.cards()[i], rack.config().cards[i]));
}

}  // namespace

constexpr PartKind card_part_kind = {"card", add_card_parts, nullptr, nullptr, nullptr, nullptr};

}  // namespace motionrack::rack
