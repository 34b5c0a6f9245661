// Lines pass to the executor as it has room for them.
#include <motionrack/control/program_feed.hpp>
#include <utility>

namespace motionrack::control {

ProgramFeed::ProgramFeed(StreamExecutor& executor, std::string_view text, const gcode::Settings& settings,
                         std::string file)
    : executor_(executor),
      program_flow_(text, settings, std::move(file)),
      budget_(settings.max_steps),
      steps_before_(executor.further_steps()) {}

gcode::Outcome<void> ProgramFeed::feed() {
    std::string_view text;
    while (more_ && executor_.has_room()) {
        more_ = program_flow_.next(text);
        gcode::Outcome<void> fed = more_ ? line(text) : program_over();
        if (fed) continue;
        more_ = false;
        return fed;
    }
    return {};
}

gcode::Outcome<void> ProgramFeed::line(std::string_view text) {
    if (auto taken = budget_.take_line(text, executor_.further_steps() - steps_before_, program_flow_); !taken)
        return taken;
    if (auto read = executor_.line(text, program_flow_.number(), program_flow_); !read) return read;
    const gcode::Block& block = executor_.interpreter().block();
    if (block.has_m(gcode::m_stop)) ended_ = ended_ || block.m[gcode::m_stop] == 2 || block.m[gcode::m_stop] == 30;
    return {};
}

gcode::Outcome<void> ProgramFeed::program_over() {
    if (auto over = executor_.program_over(); !over) {
        over.error().file = program_flow_.file();
        return over;
    }
    if (program_flow_.has_faults()) return tl::unexpected<gcode::Problem>(program_flow_.take_fault());
    return {};
}

}  // namespace motionrack::control
