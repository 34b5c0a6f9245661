#include <algorithm>
#include <motionrack/grbl/gcode_lines.hpp>

namespace motionrack::grbl {

int GcodeLines::motion_mode() const {
    const control::gcode::ModalState& modes = interpreter().modes();
    return modes.motion != control::gcode::no_motion ? modes.motion / 10 : was_g80_ ? 80 : 0;
}

std::optional<std::int32_t> GcodeLines::executed_n_word() const {
    if (n_words_.empty() || n_words_.front().first != machine_.stream().current_line()) return std::nullopt;
    return n_words_.front().second;
}

bool GcodeLines::has_room() const {
    return machine_.programs().has_room() && machine_.stream().moves() < planner_blocks;
}

std::size_t GcodeLines::free_blocks() const {
    return planner_blocks - std::min(planner_blocks, machine_.stream().moves());
}

void GcodeLines::begin_check() {
    check_ = machine_.stream().interpreter();
    if (check_->modes().motion == control::gcode::no_motion && !was_g80_) (void)check_->line("G0", 0);
}

control::gcode::Outcome<void> GcodeLines::execute(const std::string& text, std::int32_t n_word) {
    if (interpreter().modes().motion == control::gcode::no_motion && !was_g80_) (void)machine_.line("G0", line_number_);
    const auto read = machine_.line(text, line_number_ + 1);
    if (!read) return read;
    ++line_number_;
    if (n_word > 0) n_words_.push_back({line_number_, n_word});
    return {};
}

void GcodeLines::note_motion_mode(const control::gcode::Block& block) {
    using namespace control::gcode;
    if (block.has_g(g_motion)) was_g80_ = block.g[g_motion] == 800;
}

void GcodeLines::drop_executed_n_words() {
    while (!n_words_.empty() && n_words_.front().first < machine_.stream().current_line()) n_words_.pop_front();
}

void GcodeLines::reset() {
    n_words_.clear();
    check_.reset();
    was_g80_ = false;
    line_number_ = 0;
}

}  // namespace motionrack::grbl
