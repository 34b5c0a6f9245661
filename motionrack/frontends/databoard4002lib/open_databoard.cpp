// Calls of an open card, its stop and its time.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/frontends/databoard4002lib/card_table.hpp>

namespace motionrack::databoard4002lib {

namespace {

constexpr std::uint8_t no_card_answers = 0xFF;
constexpr Duration max_sleep = milliseconds(10);  // between two checks for a stop

databoard4002::DriverSettings stopper_settings(std::uint8_t number) {
    databoard4002::DriverSettings settings;
    settings.select = number;
    return settings;
}

}  // namespace

OpenDataboard::OpenDataboard(std::shared_ptr<DataboardBus> bus, rack::Card* card, BytePort& port, Interrupt& time,
                             std::uint8_t number)
    : bus_(std::move(bus)),
      card_(card),
      number_(number),
      time_(time, *bus_, *stop_),
      library_(port, time_, number),
      stopper_(port, time_, stopper_settings(number)) {}

Result<void> OpenDataboard::connect() {
    const Result<void> connected = library_.connect();
    MOTIONRACK_CHECK(check_live());
    return connected;
}

Result<void> OpenDataboard::reset() {
    const Result<void> begun = library_.begin();
    MOTIONRACK_CHECK(check_live());
    return begun;
}

Result<std::int64_t> OpenDataboard::call(std::string_view function, std::span<const std::int64_t> values) {
    const std::span<const FunctionInfo> functions = library_.functions();
    const auto found = std::find_if(functions.begin(), functions.end(),
                                    [function](const FunctionInfo& each) { return each.name == function; });
    MOTIONRACK_ASSERT(found != functions.end() && found->arguments.size() == values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        if (const ArgumentInfo& argument = found->arguments[i]; !is_possible(argument, values[i]))
            return fail(ErrorKind::invalid_input, fmt::format("{} is {}, but must be {}. Nothing was done.",
                                                              argument.name, values[i], range_text(argument)));
    const Result<CallAnswer> answer = library_.call(static_cast<std::size_t>(found - functions.begin()), values);
    MOTIONRACK_CHECK(check_answers());
    if (!answer) return tl::unexpected<Error>(answer.error());
    return answer->value.value_or(0);
}

Result<void> OpenDataboard::check_live() const {
    if (bus_->port && bus_->port->trouble()) return tl::unexpected<Error>(*bus_->port->trouble());
    return {};
}

Result<void> OpenDataboard::check_answers() {
    const std::uint8_t word = stopper_.status().word;
    MOTIONRACK_CHECK(check_live());
    if (word != no_card_answers) return {};
    return fail(ErrorKind::machine,
                fmt::format("No card answers under the number {} (STAT reads FFh), so neither its position nor its "
                            "motion is known. Check the number and its straps, and the card's supply.",
                            number_));
}

Result<void> OpenDataboard::check_stop(std::string_view effect) const {
    if (!time_.stop_requested()) return {};
    return fail(ErrorKind::stopped, fmt::format("Card {} was stopped, and the stop holds. {} Call "
                                                "databoard4002_reset_stop() once it may move again.",
                                                number_, effect));
}

Result<void> OpenDataboard::stop() {
    const Result<void> sent = stopper_.quit();
    MOTIONRACK_CHECK(check_answers());
    return sent;
}

// ---- time, the virtual card

Result<void> OpenDataboard::advance(Duration duration) {
    if (bus_->session) return bus_->session->advance(static_cast<std::uint64_t>(duration / nanoseconds(1)));
    const Instant end = later(now(), duration);
    while (now() < end && !time_.stop_requested()) time_.pass(std::clamp(end - now(), Duration{0}, max_sleep));
    return {};
}

Result<rack::Card*> OpenDataboard::virtual_card(std::string_view missing) const {
    if (card_ != nullptr) return card_;
    return fail(ErrorKind::refused,
                fmt::format("Card {} is a real card, which has no {} here. Nothing was done.", number_, missing));
}

Result<void> OpenDataboard::set_wire(std::string_view wire, double value) {
    MOTIONRACK_CHECK(virtual_card("wires that a program could set"));
    return bus_->session->set_wire(wire, value);
}

}  // namespace motionrack::databoard4002lib
