#include <motionrack/grbl/pending_answer.hpp>
#include <utility>

namespace motionrack::grbl {

void PendingAnswer::begin(PendingAction action, bool program_ends) {
    line_ = PendingLine{action, program_ends};
}

void PendingAnswer::silence() {
    if (line_) line_->silent = true;
}

bool PendingAnswer::begins_validation() {
    return !std::exchange(line_->validated, true);
}

void PendingAnswer::push(std::string_view text) {
    if (!line_->silent) answers_.push(text);
}

void PendingAnswer::finish(int error) {
    if (!std::exchange(line_, std::nullopt)->silent) answers_.answer(error);
}

}  // namespace motionrack::grbl
