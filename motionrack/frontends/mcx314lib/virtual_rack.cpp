// The virtual rack of the library on Linux: a session with a complete rack.
#include <motionrack/frontends/mcx314lib/virtual_rack.hpp>
#include <motionrack/rack/session.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::mcx314lib {

namespace {

class CardOfRack final : public VirtualCard {
  public:
    explicit CardOfRack(rack::Card& card) : card_(card) {}
    const std::string& name() const override { return card_.name(); }
    RegisterPort& registers() override { return *card_.port(); }
    Interrupt& interrupt() override { return *card_.port(); }
    Result<std::int64_t> inspect(std::string_view name) const override { return card_.inspect(name); }

  private:
    rack::Card& card_;
};

class SessionRack final : public VirtualRack {
  public:
    explicit SessionRack(std::unique_ptr<rack::Session> session) : session_(std::move(session)) {
        for (const rack::RackCard& each : session_->rack().config().cards)
            if (each.type == "mcx314")
                cards_.push_back(std::make_unique<CardOfRack>(*session_->rack().card(each.name)));
    }
    std::vector<VirtualCard*> cards() override {
        std::vector<VirtualCard*> out;
        for (const auto& card : cards_) out.push_back(card.get());
        return out;
    }
    Result<void> advance(std::uint64_t ns) override { return session_->advance(ns); }
    Result<void> set_wire(std::string_view name, double value) override { return session_->set_wire(name, value); }

  private:
    std::unique_ptr<rack::Session> session_;
    std::vector<std::unique_ptr<CardOfRack>> cards_;
};

static_assert(VirtualRack::max_ns == rack::Session::max_ns);

}  // namespace

Result<std::shared_ptr<VirtualRack>> VirtualRack::open(std::string_view path_or_text) {
    MOTIONRACK_TRY(auto session, rack::Session::open(path_or_text));
    return std::make_shared<SessionRack>(std::move(session));
}

std::string in_quotes(std::string_view text) {
    return rack::in_quotes(text);
}

}  // namespace motionrack::mcx314lib
