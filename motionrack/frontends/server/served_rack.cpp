#include <fmt/format.h>

#include <motionrack/frontends/server/served_rack.hpp>
#include <motionrack/frontends/server/user_commands.hpp>
#include <nlohmann/json.hpp>
#include <utility>

namespace motionrack::server {

namespace {

/// Truncates to at most `max_bytes` bytes of whole UTF-8 characters.
std::string cut(std::string text, std::size_t max_bytes) {
    if (text.size() <= max_bytes) return text;
    std::size_t end = max_bytes - 2;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
    text.resize(end);
    return text + "..";
}

}  // namespace

Result<std::unique_ptr<ServedRack>> ServedRack::open(const rack::RackConfig& config, ServedSettings settings) {
    std::unique_ptr<ServedRack> served(new ServedRack());
    MOTIONRACK_CHECK(served->make(config, std::move(settings)));
    return served;
}

Result<void> ServedRack::make(const rack::RackConfig& config, ServedSettings settings) {
    journal_ = settings.journal;
    MOTIONRACK_CHECK(pacer_.set(settings.clock, settings.factor));
    if (!settings.machine.live.empty() && (settings.clock != operate::ClockMode::real || settings.factor != 1))
        return fail(
            ErrorKind::refused,
            fmt::format("Card {} is a real one, whose time is the computer's, but the rack's clock is '{}' with "
                        "factor {:g}. Nothing was started. Serve it in real time with factor 1.",
                        settings.machine.live.front().card, operate::name_of(settings.clock), settings.factor));
    settings.machine.pace = [this, meanwhile = std::move(settings.meanwhile)](Instant now) {
        if (meanwhile) meanwhile();
        return pacer_.pace(now);
    };
    settings.machine.wall = [this] { return clock_.now(); };
    MOTIONRACK_TRY(machine_, operate::Machine::make(config, std::move(settings.machine)));
    MOTIONRACK_TRY(door_, auth::Authenticator::open(std::move(settings.door)));
    if (settings.grbl) {
        if (journal_ != nullptr) {
            settings.grbl->on_setting = [this](const std::string& sender, const std::string& text) {
                if (!settings_of_senders_.take("", std::chrono::steady_clock::now())) return;
                journal_->write(machine_->now(), "setting", fmt::format("{}: {}", sender, text));
            };
            settings.grbl->on_unknown_sender = [this](const std::string& address) {
                machine_->post([this, address] {
                    journal_->write(
                        machine_->now(), "audit",
                        fmt::format("{} at the port for senders: closed, because senders do not begin like this",
                                    address));
                });
            };
        }
        MOTIONRACK_TRY(grbl_, GrblPorts::open(*settings.grbl, *machine_, lease_));
    }
    settings.panel.version = settings.server.version = settings.version;
    settings.panel.boot = settings.server.boot = settings.boot;
    settings.panel.pacer = &pacer_;
    settings.panel.journal = journal_;
    settings.panel.link = [this] {
        return nlohmann::json{{"sender", grbl_ ? grbl_->sender() : "none"},
                              {"clients", server_ ? server_->clients() : 0}};
    };
    settings.panel.external = door_orders(*door_);
    panel_ = std::make_unique<panel::Panel>(*machine_, lease_, std::move(settings.panel));
    settings.server.rack = config.name;
    if (journal_ != nullptr) settings.server.audit = [this](const AuditEntry& entry) { write_down(entry); };
    MOTIONRACK_TRY(server_,
                   Server::open(std::move(settings.server), *panel_, *door_, lease_, std::move(settings.page)));
    return {};
}

void ServedRack::stop() {
    server_->stop();
    grbl_.reset();
}

/// Writes an audit entry to the journal; called on the network thread.
void ServedRack::write_down(const AuditEntry& entry) {
    const nlohmann::json data = {
        {"user", entry.user}, {"address", entry.address}, {"command", entry.what}, {"status", entry.status}};
    std::string text = fmt::format("{} from {}: {}: {}", entry.user.empty() ? "a stranger" : entry.user, entry.address,
                                   entry.what, entry.outcome);
    journal_->write(panel_->picture()->at(), "audit", cut(std::move(text), max_audit_bytes), panel::text_of(data));
}

}  // namespace motionrack::server
