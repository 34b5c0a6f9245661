// A card as a part: the quantities that it names itself.
#include <motionrack/rack/part_catalogue.hpp>
#include <motionrack/rack/rack.hpp>

namespace motionrack::rack {

namespace {

class CardPart final : public Part {
  public:
    explicit CardPart(Card& card) : card_(card) {}

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

  private:
    Card& card_;
};

void add_card_parts(Rack& rack, std::vector<std::unique_ptr<Part>>& parts) {
    for (const auto& card : rack.cards()) parts.push_back(std::make_unique<CardPart>(*card));
}

}  // namespace

constinit const PartKind card_part_kind = {"card", add_card_parts, nullptr};

}  // namespace motionrack::rack
