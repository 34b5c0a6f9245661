// Parses and executes scheduled commands.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/base/numbers.hpp>
#include <motionrack/rack/command_schedule.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <utility>

namespace motionrack::rack {

namespace {

constexpr Duration asked_ahead = microseconds(1);

}  // namespace

bool CommandSchedule::knows(std::string_view action) {
    const std::string_view name = action.substr(0, action.find('='));
    return name == "stop" || name == "hold" || name == "resume" || name == "feed" || name == "rapid";
}

Result<CommandSchedule::ScheduledCommand> CommandSchedule::read(const ScheduledText& text) {
    const std::string_view action = text.action;
    const std::size_t equals = action.find('=');
    const std::string_view name = action.substr(0, equals);
    ScheduledCommand out{text.at, CommandKind::stop, 1, text.text, false};
    const auto plain = [&](CommandKind kind) {
        out.kind = kind;
        return equals == std::string_view::npos;
    };
    const auto part = [&](CommandKind kind, double max_value) {
        out.kind = kind;
        out.value = equals == std::string_view::npos ? std::nan("") : number_of(action.substr(equals + 1));
        return out.value >= 0.01 && out.value <= max_value;
    };
    const bool good = (name == "stop" && plain(CommandKind::stop)) || (name == "hold" && plain(CommandKind::hold)) ||
                      (name == "resume" && plain(CommandKind::resume)) ||
                      (name == "feed" && part(CommandKind::feed, 2)) ||
                      (name == "rapid" && part(CommandKind::rapid, 1));
    if (good) return out;
    return fail(
        ErrorKind::invalid_input,
        fmt::format("Unknown command {}. Nothing was moved. Commands are hold, resume, stop, feed=PART (0.01 .. 2) and "
                    "rapid=PART (0.01 .. 1), each with its time, such as feed=0.5@1.5s.",
                    in_quotes(text.text)));
}

Result<std::unique_ptr<CommandSchedule>> CommandSchedule::create(Rack& rack,
                                                                 const std::vector<ScheduledText>& commands) {
    std::unique_ptr<CommandSchedule> plan(new CommandSchedule(rack));
    for (const ScheduledText& text : commands) {
        MOTIONRACK_TRY(ScheduledCommand command, read(text));
        plan->needs_stream_ = plan->needs_stream_ || command.kind != CommandKind::stop;
        plan->commands_.push_back(std::move(command));
    }
    std::stable_sort(plan->commands_.begin(), plan->commands_.end(),
                     [](const ScheduledCommand& a, const ScheduledCommand& b) { return a.at < b.at; });
    MOTIONRACK_CHECK(plan->check_holds());
    plan->id_ = rack.kernel().add(*plan, sim::Phase::observers, "commands");
    return plan;
}

Result<void> CommandSchedule::check_holds() const {
    const ScheduledCommand* holds = nullptr;
    for (const ScheduledCommand& command : commands_) {
        if (command.kind == CommandKind::hold) holds = &command;
        if (command.kind == CommandKind::resume || command.kind == CommandKind::stop) holds = nullptr;
    }
    if (holds == nullptr) return {};
    return fail(ErrorKind::refused,
                fmt::format("The job would never end after {}. Nothing was moved. Add a resume or a stop after it.",
                            in_quotes(holds->text)));
}

void CommandSchedule::begin() {
    aim();
}

void CommandSchedule::aim() {
    const Instant now = rack_.kernel().now();
    for (const ScheduledCommand& command : commands_)
        if (!command.done && command.at >= now) return rack_.kernel().schedule(id_, command.at);
    rack_.kernel().schedule(id_, never);
}

void CommandSchedule::on_scheduled(Instant now) {
    rack_.kernel().break_run();
    for (const ScheduledCommand& command : commands_)
        if (command.at > now) return rack_.kernel().schedule(id_, command.at);
}

std::optional<Instant> CommandSchedule::ask_stop() {
    if (std::exchange(asked_, true) || stop_flag_) return std::nullopt;
    ScheduledCommand command{rack_.kernel().now() + asked_ahead, CommandKind::stop, 1, "stop", false};
    const auto after = std::upper_bound(commands_.begin(), commands_.end(), command.at,
                                        [](Instant at, const ScheduledCommand& one) { return at < one.at; });
    commands_.insert(after, command);
    aim();
    return command.at;
}

void CommandSchedule::apply_due() {
    for (ScheduledCommand& command : commands_)
        if (!command.done && command.at <= rack_.kernel().now()) {
            command.done = true;
            apply(command);
        }
}

void CommandSchedule::halt() {
    if (stop_flag_.exchange(true) || stream_ == nullptr) return;
    stream_->stop();
}

void CommandSchedule::apply(const ScheduledCommand& command) {
    if (command.kind == CommandKind::stop) {
        stop_flag_ = true;
        rack_.stop_latch().stop();
    }
    if (command.kind == CommandKind::hold || command.kind == CommandKind::resume)
        holds_ = command.kind == CommandKind::hold;
    if (stream_ == nullptr) return;
    switch (command.kind) {
        case CommandKind::stop:
            stream_->stop();
            break;
        case CommandKind::hold:
            stream_->hold();
            break;
        case CommandKind::resume:
            stream_->resume();
            break;
        case CommandKind::feed:
            stream_->set_overrides(feed_ = command.value, rapid_);
            break;
        case CommandKind::rapid:
            stream_->set_overrides(feed_, rapid_ = command.value);
            break;
    }
}

bool CommandSchedule::pending() const {
    return std::any_of(commands_.begin(), commands_.end(),
                       [](const ScheduledCommand& command) { return !command.done; });
}

std::vector<std::string> CommandSchedule::not_done() const {
    std::vector<std::string> out;
    for (const ScheduledCommand& command : commands_)
        if (!command.done) out.push_back("the run ended before the command " + command.text);
    return out;
}

}  // namespace motionrack::rack
