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

Result<CommandSchedule::Order> CommandSchedule::read(const ScheduledText& text) {
    const std::string_view action = text.action;
    const std::size_t equals = action.find('=');
    const std::string_view name = action.substr(0, equals);
    Order out{text.at, Kind::stop, 1, text.text, false};
    const auto plain = [&](Kind kind) {
        out.kind = kind;
        return equals == std::string_view::npos;
    };
    const auto part = [&](Kind kind, double most) {
        out.kind = kind;
        out.value = equals == std::string_view::npos ? std::nan("") : number_of(action.substr(equals + 1));
        return out.value >= 0.01 && out.value <= most;
    };
    const bool good = (name == "stop" && plain(Kind::stop)) || (name == "hold" && plain(Kind::hold)) ||
                      (name == "resume" && plain(Kind::resume)) || (name == "feed" && part(Kind::feed, 2)) ||
                      (name == "rapid" && part(Kind::rapid, 1));
    if (good) return out;
    return fail(ErrorKind::invalid_input,
                fmt::format("The order {} is none: orders are hold, resume, stop, feed=PART (0.01 "
                            ".. 2) and rapid=PART (0.01 .. 1), each with its "
                            "time, such as feed=0.5@1.5s. Nothing was moved.",
                            in_quotes(text.text)));
}

Result<std::unique_ptr<CommandSchedule>> CommandSchedule::create(Rack& rack, const std::vector<ScheduledText>& orders) {
    std::unique_ptr<CommandSchedule> plan(new CommandSchedule(rack));
    for (const ScheduledText& text : orders) {
        MOTIONRACK_TRY(Order order, read(text));
        plan->needs_stream_ = plan->needs_stream_ || order.kind != Kind::stop;
        plan->orders_.push_back(std::move(order));
    }
    std::stable_sort(plan->orders_.begin(), plan->orders_.end(),
                     [](const Order& a, const Order& b) { return a.at < b.at; });
    MOTIONRACK_CHECK(plan->check_holds());
    plan->id_ = rack.kernel().add(*plan, sim::Phase::observers, "orders");
    return plan;
}

Result<void> CommandSchedule::check_holds() const {
    const Order* holds = nullptr;
    for (const Order& order : orders_) {
        if (order.kind == Kind::hold) holds = &order;
        if (order.kind == Kind::resume || order.kind == Kind::stop) holds = nullptr;
    }
    if (holds == nullptr) return {};
    return fail(
        ErrorKind::refused,
        fmt::format(
            "After the order {} the job would stand for ever; add a resume or a stop after it. Nothing was moved.",
            in_quotes(holds->text)));
}

void CommandSchedule::begin() {
    aim();
}

void CommandSchedule::aim() {
    const Instant now = rack_.kernel().now();
    for (const Order& order : orders_)
        if (!order.done && order.at >= now) return rack_.kernel().schedule(id_, order.at);
    rack_.kernel().schedule(id_, never);
}

void CommandSchedule::on_scheduled(Instant now) {
    rack_.kernel().break_run();
    for (const Order& order : orders_)
        if (order.at > now) return rack_.kernel().schedule(id_, order.at);
}

std::optional<Instant> CommandSchedule::ask_stop() {
    if (std::exchange(asked_, true) || stop_flag_) return std::nullopt;
    Order order{rack_.kernel().now() + asked_ahead, Kind::stop, 1, "stop", false};
    const auto after = std::upper_bound(orders_.begin(), orders_.end(), order.at,
                                        [](Instant at, const Order& one) { return at < one.at; });
    orders_.insert(after, order);
    aim();
    return order.at;
}

void CommandSchedule::apply_due() {
    for (Order& order : orders_)
        if (!order.done && order.at <= rack_.kernel().now()) {
            order.done = true;
            apply(order);
        }
}

void CommandSchedule::halt() {
    if (stop_flag_.exchange(true) || stream_ == nullptr) return;
    stream_->stop();
}

void CommandSchedule::apply(const Order& order) {
    if (order.kind == Kind::stop) {
        stop_flag_ = true;
        rack_.stop_latch().order();
    }
    if (order.kind == Kind::hold || order.kind == Kind::resume) holds_ = order.kind == Kind::hold;
    if (stream_ == nullptr) return;
    switch (order.kind) {
        case Kind::stop:
            stream_->stop();
            break;
        case Kind::hold:
            stream_->hold();
            break;
        case Kind::resume:
            stream_->resume();
            break;
        case Kind::feed:
            stream_->set_overrides(feed_ = order.value, rapid_);
            break;
        case Kind::rapid:
            stream_->set_overrides(feed_, rapid_ = order.value);
            break;
    }
}

bool CommandSchedule::pending() const {
    return std::any_of(orders_.begin(), orders_.end(), [](const Order& order) { return !order.done; });
}

std::vector<std::string> CommandSchedule::not_done() const {
    std::vector<std::string> out;
    for (const Order& order : orders_)
        if (!order.done) out.push_back("the run ended before the order " + order.text);
    return out;
}

}  // namespace motionrack::rack
