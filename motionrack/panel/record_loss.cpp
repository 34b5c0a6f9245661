#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <motionrack/panel/record_loss.hpp>
#include <motionrack/rack/rtc5_card.hpp>

namespace motionrack::panel {

namespace {

/// Commands that stop the machine, take or release control of it, or move it out of the way manually.
constexpr std::array<std::string_view, 12> taken_without_record = {
    "stop", "hold",   "reset",    "mark_stop",    "set_estop",       "acknowledge_alarm",
    "jog",  "jog_by", "jog_stop", "take_control", "release_control", "renew_control"};

bool is_taken_without_record(const OperationSpec& row) {
    return row.role == auth::Role::observe ||
           std::find(taken_without_record.begin(), taken_without_record.end(), row.name) != taken_without_record.end();
}

}  // namespace

void RecordLoss::poll() {
    if (lost_ || context_.settings.journal == nullptr) return;
    const std::string failure = context_.settings.journal->failure();
    if (failure.empty()) return;
    lost_ = true;
    context_.machine.forbid_starts(
        "journal", failure +
                       " The machine holds, and nothing is started. Stop it, remove the cause, and start the "
                       "program again; all positions are invalid then.");
    rack::Rack& rack = context_.machine.rack();
    for (const auto& card : rack.cards())
        if (rtc5::Card* marks = rack::rtc5_card_of(rack, card->name())) marks->engine().set_control_mode(0);
}

Result<void> RecordLoss::may(const OperationSpec& row) const {
    if (!lost_ || is_taken_without_record(row)) return {};
    return context_.machine.conditions().may_start(std::string(row.name).c_str());
}

Answer RecordLoss::answer(const OperationSpec& row, Answer answer, const Result<std::int64_t>& kept) {
    if (kept) return answer;
    if (is_taken_without_record(row)) {
        answer.body["unrecorded"] = kept.error().message;
        return answer;
    }
    return refused_answer(500, "io",
                          fmt::format("{} So '{}' is not recorded. The machine holds; its status shows whether the "
                                      "program has started. Stop it, and remove the cause.",
                                      kept.error().message, row.name));
}

}  // namespace motionrack::panel
