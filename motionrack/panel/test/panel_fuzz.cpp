#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <motionrack/auth/control_lease.hpp>
#include <motionrack/panel/panel.hpp>
#include <motionrack/panel/test/panel_fuzz.hpp>
#include <motionrack/rack/config.hpp>

namespace motionrack::panel::fuzz {

namespace {

using nlohmann::json;

constexpr const char* rack_text =
    "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\ninitial_position_mm = 10\n[axis.Y]\ncard = "
    "\"m\"\nchannel = \"y\"\n"
    "[card.p]\ntype = \"databoard4002\"\n[card.l]\ntype = \"rtc5\"\nlist_memory = 2000\n[scanner.head]\ncard = \"l\"\n";
constexpr int max_lines = 16;

/// Sends line after line, a slice apart.
class Asker {
  public:
    explicit Asker(std::string_view bytes) : left_(bytes) {}
    void attach(operate::Machine& machine, Panel& panel) {
        machine_ = &machine;
        panel_ = &panel;
    }
    void next() {
        if (machine_ == nullptr) return;
        if (asked_ == 0) ask("take_control", json::object());
        const std::size_t end = std::min(left_.find('\n'), left_.size());
        const std::string_view line = left_.substr(0, end);
        left_.remove_prefix(std::min(end + 1, left_.size()));
        json fields = json::parse(line, nullptr, false);
        std::string name = "status";
        if (fields.is_object() && fields.contains("command") && fields["command"].is_string()) {
            name = fields["command"].get<std::string>();
            fields.erase("command");
        }
        if (!fields.is_discarded()) ask(name, fields);
        if (left_.empty() || asked_ > max_lines) machine_->quit();
    }
    std::string problem() const {
        if (!problem_.empty()) return problem_;
        return answered_ == asked_ ? "" : fmt::format("{} commands were answered {} times", asked_, answered_.load());
    }

  private:
    void ask(const std::string& name, const json& fields) {
        ++asked_;
        panel_->ask({"anna", auth::Role::maintain, "w1"}, name, fields, [this, name](const Answer& answer) {
            ++answered_;
            if (answer.body.contains("done") == answer.body.contains("error"))
                problem_ = name + " was answered by neither done nor error";
            if (answer.body.contains("error") && answer.body["error"]["message"].get<std::string>().size() < 10)
                problem_ = name + " was refused without a sentence";
            static_cast<void>(text_of(answer.body));
        });
    }
    std::string_view left_;
    operate::Machine* machine_ = nullptr;
    Panel* panel_ = nullptr;
    int asked_ = 0;
    std::atomic<int> answered_{0};
    std::string problem_;
};

}  // namespace

std::string check_orders(std::string_view bytes) {
    static const rack::RackConfig config = *rack::read_rack_text(rack_text).config;
    Asker asker(bytes);
    auth::ControlLease lease;
    {
        operate::MachineSettings settings;
        settings.pace = [&asker](Instant) {
            asker.next();
            return true;
        };
        const auto machine = operate::Machine::make(config, std::move(settings));
        if (!machine) return machine.error().message;
        {
            Panel panel(**machine, lease, {});
            asker.attach(**machine, panel);
            (*machine)->run();
        }
    }
    return asker.problem();
}

}  // namespace motionrack::panel::fuzz
