// Requests are checked in the caller's thread and executed on the motion thread.
#include <fmt/format.h>

#include <motionrack/base/fnv.hpp>
#include <motionrack/operate/journal_writer.hpp>
#include <motionrack/panel/panel.hpp>
#include <motionrack/panel/panel_context.hpp>
#include <motionrack/panel/record_loss.hpp>
#include <motionrack/panel/status_writer.hpp>
#include <utility>

namespace motionrack::panel {

using nlohmann::json;

namespace {

/// Maximum length of a call's arguments in the journal; those of each function fit.
constexpr std::size_t max_argument_bytes = 400;

}  // namespace

const std::string& StatusSnapshot::status_text() const {
    std::call_once(written_, [this] { text_ = write_(status_); });
    return text_;
}

std::string session_mark(std::string_view session) {
    return fmt::format("{:016x}", fnv_of(session));
}

/// The part of the panel that runs on the motion thread.
class Panel::Inside {
  public:
    Inside(Panel& panel, operate::Machine& machine, auth::ControlLease& lease, PanelSettings settings)
        : panel_(panel),
          context_(machine, lease, std::move(settings)),
          writer_(machine),
          logbook_(context_.settings.journal,
                   [this](Instant at, const std::string& kind, const std::string& text, const std::string& data) {
                       context_.book.add({0, at, kind, text, json::parse(data, nullptr, false)});
                   }),
          loss_(context_) {
        for (const std::span<const OperationHandler> table :
             {control_doers(), motion_doers(), program_doers(), card_doers(), library_doers(), scope_doers(),
              mark_doers(), looking_doers()})
            for (const OperationHandler& doer : table) doers_[doer.name] = &doer;
        for (const std::span<const OperationSpec> table : {commands(), queries()})
            for (const OperationSpec& row : table) MOTIONRACK_ASSERT(row.external || doers_.count(row.name) == 1);
        machine.listen([this](const operate::Status& status) { observe(status); },
                       [this](const operate::StopReport& report) { logbook_.stopped(report); });
        show(machine.status());
    }

    /// Call every slice: reports changes, and publishes a status periodically.
    void observe(const operate::Status& status) {
        loss_.poll();
        look_for_control();
        logbook_.see(status);
        answer_orders();
        context_.scope.slice(status.at);
        context_.driven.add(status);
        const auto real = std::chrono::steady_clock::now();
        if (real - shown_ < context_.settings.picture_every) return;
        shown_ = real;
        report_conditions(real);
        show(status);
    }

    void carry_out(const OperationSpec& row, const Caller& caller, const json& fields, const Reply& reply) {
        if (row.lease)
            if (const Result<void> held = context_.lease.check(caller.session); !held)
                return reply(error_answer(held.error()));
        if (const Result<void> may = loss_.may(row); !may) return reply(error_answer(may.error()));
        const OperationHandler& doer = *doers_.at(row.name);
        const auto ready = [this, &row, caller, fields, reply](Result<json> result) {
            finish(row, caller, fields, reply, std::move(result));
        };
        if (doer.later != nullptr) return doer.later(context_, caller, fields, ready);
        ready(doer.now(context_, caller, fields));
    }

    PanelContext& context() { return context_; }

  private:
    /// Ends a service when the session that started it loses control.
    void look_for_control() {
        operate::Service& service = context_.machine.service();
        if (!service.on()) return;
        const auto holder = context_.lease.holder();
        if (holder && holder->session == service.session()) return;
        context_.machine.post([&service, session = service.session()] { service.end_of(session); });
    }

    void show(const operate::Status& status) {
        std::atomic_store(&panel_.picture_, std::make_shared<const StatusSnapshot>(status, writer_.writer(context_)));
        context_.channels.show(status.sequence, status.at);
    }

    /// Reports conditions of cards and parts: lost steps, missed edges.
    void report_conditions(std::chrono::steady_clock::time_point real) {
        if (real - polled_ < 20 * context_.settings.picture_every) return;
        polled_ = real;
        rack::Rack& rack = context_.machine.rack();
        const std::vector<sim::Condition> all = rack.kernel().conditions();
        const std::uint64_t first = rack.kernel().dropped_conditions();
        for (std::uint64_t i = std::max(reported_, first); i < first + all.size(); ++i) {
            const sim::Condition& condition = all[static_cast<std::size_t>(i - first)];
            context_.book.add({0,
                               condition.at,
                               "condition",
                               rack.describe(condition),
                               {{"device", rack.kernel().device_name(condition.device)}}});
        }
        reported_ = first + all.size();
    }

    /// Answers a query or a failed command immediately. An executed command becomes an event, and its answer waits for
    /// its journal entry.
    void finish(const OperationSpec& row, const Caller& caller, const json& fields, const Reply& reply,
                Result<json> result) {
        if (!result) return reply(error_answer(result.error()));
        Answer answer = done(std::move(*result));
        const bool reported = row.role != auth::Role::observe && !row.high_rate && !answer.body.value("again", false);
        answer.body.erase("again");
        if (!reported) return reply(std::move(answer));
        taken_.push_back(
            {&row, caller, fields, [&row, reply, answer = std::move(answer)](const Result<std::int64_t>& kept) {
                 reply(RecordLoss::answer(row, answer, kept));
             }});
    }

    /// Writes executed commands to the journal after their effects on the machine, so that the next run knows
    /// everything that was answered.
    void answer_orders() {
        for (Taken& one : std::exchange(taken_, {})) {
            // A stop has an entry already; a second one would let strangers fill the journal.
            if (one.row->name == "stop" && one.caller.user.empty()) {
                one.safe(0);
                continue;
            }
            const json data = {{"command", one.row->name}, {"user", one.caller.user}};
            const Event& event = context_.book.add(
                {0, context_.machine.now(), "command", sentence(*one.row, one.caller, one.fields), data});
            if (context_.settings.journal != nullptr)
                context_.settings.journal->write(event.at, event.kind, event.text, text_of(data), std::move(one.safe));
            else
                one.safe(event.number);
        }
    }

    static std::string sentence(const OperationSpec& row, const Caller& caller, const json& fields) {
        std::string out = fmt::format("{}: {}", caller.user.empty() ? "unknown user" : caller.user, row.name);
        for (const auto& [name, value] : fields.items()) {
            std::string shown = text_of(value);
            if (shown.size() > (value.is_object() ? max_argument_bytes : 60U))
                shown = fmt::format("({} characters)", shown.size());
            out += fmt::format(" {}={}", name, shown);
        }
        return out;
    }

    /// An executed command; `safe` is called when its entry is in the journal.
    struct Taken {
        const OperationSpec* row;
        Caller caller;
        json fields;
        journal::Journal::Done safe;
    };

    Panel& panel_;
    PanelContext context_;
    StatusWriter writer_;
    operate::JournalWriter logbook_;
    RecordLoss loss_;
    std::map<std::string_view, const OperationHandler*> doers_;
    std::vector<Taken> taken_;
    std::chrono::steady_clock::time_point shown_{}, polled_{};
    std::uint64_t reported_ = 0;
};

Panel::Panel(operate::Machine& machine, auth::ControlLease& lease, PanelSettings settings)
    : inside_(std::make_unique<Inside>(*this, machine, lease, std::move(settings))) {}

Panel::~Panel() = default;

void Panel::ask(const Caller& caller, std::string_view name, const json& fields, std::function<void(Answer)> reply) {
    const OperationSpec* row = find_row(name);
    if (row == nullptr) return reply(refused_answer(404, "invalid_input", unknown_operation("command or query", name)));
    if (caller.role < row->role)
        return reply(
            refused_answer(caller.role == auth::Role::none ? 401 : 403, "denied",
                           fmt::format("{} needs the role {}; {} has the role {}. Nothing was done.", row->name,
                                       auth::name_of(row->role), caller.user.empty() ? "the caller" : caller.user,
                                       auth::name_of(caller.role))));
    if (const Result<void> good = check_fields(*row, fields); !good) return reply(error_answer(good.error()));
    if (row->external) {
        const auto& handlers = inside_->context().settings.external;
        const auto found = handlers.find(row->name);
        if (found == handlers.end())
            return reply(refused_answer(409, "refused",
                                        fmt::format("{} is not available: the machine is not served over a network. "
                                                    "Nothing was done.",
                                                    row->name)));
        return reply(found->second(caller, fields));
    }
    inside_->context().machine.post([this, row, caller, fields, answer = Reply(std::move(reply))] {
        inside_->carry_out(*row, caller, fields, answer);
    });
}

void Panel::stop(const Caller& caller) {
    ask(caller, "stop", json::object(), [](const Answer&) {});
}

void Panel::left(std::string session) {
    operate::Machine& machine = inside_->context().machine;
    machine.post([&machine, session = std::move(session)] {
        machine.manual().jogs().end_of(session);
        machine.service().end_of(session);
    });
}

void Panel::subscribe(std::vector<std::string> channels,
                      std::function<void(Result<std::shared_ptr<ChannelSet>>)> ready) {
    inside_->context().machine.post([this, channels = std::move(channels), ready = std::move(ready)] {
        ready(inside_->context().channels.set_of(channels));
    });
}

void Panel::on_event(std::function<void(const Event&)> call) {
    inside_->context().book.listen(std::move(call));
}

const json& Panel::openapi() {
    return panel::openapi();
}

}  // namespace motionrack::panel
