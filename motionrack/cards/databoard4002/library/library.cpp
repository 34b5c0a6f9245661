// Start, calls and stop.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <motionrack/cards/databoard4002/library/calls.hpp>

namespace motionrack::databoard4002 {

namespace {

/// Maximum wait for Ready: longer than an access of the card takes, short enough for a stop that has to be written
/// again.
constexpr Duration library_ready_timeout = milliseconds(20);
constexpr Duration max_start = whole_seconds(1);  // of the card's program after a reset
constexpr std::uint8_t no_card = 0xFF;

DriverSettings library_settings(std::uint8_t select) {
    DriverSettings settings;
    settings.select = select;
    settings.ready_timeout = library_ready_timeout;
    return settings;
}

std::vector<FunctionInfo> all_infos() {
    std::vector<FunctionInfo> out;
    for (const functions::LibraryRow& row : functions::function_rows()) out.push_back(row.info);
    return out;
}

}  // namespace

std::span<const FunctionInfo> library_functions() {
    static const std::vector<FunctionInfo> all = all_infos();
    return all;
}

void GuardedBytePort::out(std::uint8_t port, std::uint8_t value) {
    constexpr std::array harmless = {command("D"), command("P"), command("Q"), command("R"), command("V")};
    const bool passes = port == ports::CS || port == ports::C4 ||
                        (port == ports::C2 && std::find(harmless.begin(), harmless.end(), value) != harmless.end());
    if (passes || !host_.stop_requested()) port_.out(port, value);
}

CommandLibrary::CommandLibrary(BytePort& port, Interrupt& host, std::uint8_t select)
    : guarded_(port, host),
      host_(host),
      driver_(guarded_, host, library_settings(select)),
      stopper_(port, host, library_settings(select)) {}

std::span<const FunctionInfo> CommandLibrary::functions() const {
    return library_functions();
}

Result<void> CommandLibrary::begin() {
    if (driver_.status().word != no_card) driver_.reset();
    return connect();
}

Result<void> CommandLibrary::connect() {
    const Instant until = later(host_.now(), max_start);
    while (!driver_.status().ready() && host_.now() < until && !host_.stop_requested())
        host_.pass(library_ready_timeout);
    MOTIONRACK_CHECK(driver_.connect());
    return {};
}

Result<CallAnswer> CommandLibrary::call(std::size_t function, std::span<const std::int64_t> values) {
    const functions::LibraryRow& row = functions::function_rows()[function];
    MOTIONRACK_ASSERT(values.size() == row.info.arguments.size());
    MOTIONRACK_TRY(CallAnswer answer, row.call(driver_, values));
    if (answer.value && answer.text.empty()) answer.text = fmt::format("{} {}", *answer.value, row.info.returns);
    return answer;
}

bool CommandLibrary::moving() {
    const Result<int> rate = stopper_.rate();
    return !rate || *rate != 0;
}

void CommandLibrary::stop_now() {
    static_cast<void>(stopper_.quit());
}

}  // namespace motionrack::databoard4002
