// The handshake and the commands.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/cards/databoard4002/driver/driver.hpp>

namespace motionrack::databoard4002 {

Driver::Driver(BytePort& port, Interrupt& interrupt, const DriverSettings& settings)
    : port_(port), interrupt_(interrupt), settings_(settings) {
    MOTIONRACK_ASSERT(settings.ready_timeout > Duration{0} && settings.poll > Duration{0} &&
                      settings.counts_per_mm > 0);
}

std::string StatusByte::stops() const {
    std::string out;
    auto add = [&out](bool active, const char* what) {
        if (active) out += out.empty() ? what : std::string(" and ") + what;
    };
    add(end_stop_left(), "the left end stop");
    add(end_stop_right(), "the right end stop");
    add(emergency(), "the emergency stop");
    if (!out.empty()) out += out.find(" and ") == std::string::npos ? " is active" : " are active";
    return out;
}

// ---- handshake

StatusByte Driver::status() {
    port_.out(ports::CS, settings_.select);
    return {port_.in(ports::STAT)};
}

Result<void> Driver::wait_ready(const char* what) {
    const Instant until = later(interrupt_.now(), settings_.ready_timeout);
    while (!status().ready()) {
        if (interrupt_.now() >= until)
            return fail(ErrorKind::machine,
                        fmt::format("Card {} was not Ready for {} within {:.0f} ms, so it was not sent. If this lasts "
                                    "longer than a second, its watchdog has not helped: reset the card.",
                                    settings_.select, what, to_seconds(settings_.ready_timeout) * 1e3));
        interrupt_.pass(settings_.poll);
    }
    return {};
}

Result<void> Driver::send(std::uint8_t code) {
    const char name[] = {static_cast<char>(code), 0};
    MOTIONRACK_CHECK(wait_ready(name));
    port_.out(ports::C2, code);
    return {};
}

Result<void> Driver::send(std::uint8_t code, std::int64_t value, int bytes) {
    MOTIONRACK_CHECK(send(code));
    for (int i = 0; i < bytes; ++i) {
        MOTIONRACK_CHECK(wait_ready("an argument byte"));
        port_.out(ports::DATA, static_cast<std::uint8_t>(value >> (8 * i)));
    }
    return {};
}

Result<std::int64_t> Driver::ask(std::uint8_t code, int bytes) {
    MOTIONRACK_CHECK(send(code));
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) {
        MOTIONRACK_CHECK(wait_ready("an answer byte"));
        value |= std::uint64_t{port_.in(ports::DATA)} << (8 * i);
    }
    const int unused = 64 - 8 * bytes;
    return static_cast<std::int64_t>(value << unused) >> unused;
}

Result<void> Driver::in_range(const char* what, std::int64_t value, std::int64_t min, std::int64_t max) const {
    if (value >= min && value <= max) return {};
    return fail(ErrorKind::refused, fmt::format("{} of card {} is {}, but must be {} to {}. Nothing was sent.", what,
                                                settings_.select, value, min, max));
}

Result<int> Driver::connect() {
    const std::uint8_t word = status().word;
    if (word == 0xFF)
        return fail(
            ErrorKind::machine,
            fmt::format("No card answers under the number {} (STAT reads FFh). Check the number and its straps.",
                        settings_.select));
    MOTIONRACK_CHECK(enable_events(0));
    MOTIONRACK_CHECK(clear_watch_out());
    met_reset_ = false;
    return version();
}

void Driver::reset() {
    port_.out(ports::CS, settings_.select);
    port_.out(ports::C3, 0);
    enables_ = 0;
    quit_due_ = false;
}

// ---- commands

Result<void> Driver::athome() {
    return send(command("A"));
}
Result<void> Driver::go() {
    return send(command("G"));
}
Result<void> Driver::initialise() {
    return send(command("I"));
}
Result<void> Driver::lock() {
    return send(command("L"));
}
Result<void> Driver::manual() {
    return send(command("M"));
}
Result<void> Driver::on_regulation() {
    return send(command("O"));
}
Result<void> Driver::quit() {
    Result<void> sent = send(command("Q"));
    quit_due_ = !sent;
    return sent;
}
Result<void> Driver::clear_watch_out() {
    return send(command("W"));
}

Result<void> Driver::set_deviation(std::int64_t counts) {
    MOTIONRACK_CHECK(in_range("The deviation D", counts, 0, map::max_24));
    return send(command("D"), counts, 3);
}

Result<void> Driver::set_number(std::int64_t counts) {
    MOTIONRACK_CHECK(in_range("The distance N", counts, map::min_24, map::max_24));
    return send(command("N"), counts, 3);
}

Result<void> Driver::set_target(std::int64_t counts) {
    MOTIONRACK_CHECK(in_range("The target P", counts, map::min_24, map::max_24));
    return send(command("P"), counts, 3);
}

Result<void> Driver::set_rate(int rate) {
    MOTIONRACK_CHECK(in_range("The rate R", rate, 0, map::max_rate));
    return send(command("R"), rate, 2);
}

Result<void> Driver::set_slope(const SlopeTable& table) {
    MOTIONRACK_CHECK(send(command("S")));
    for (int i = 0; i < SlopeTable::size; ++i) {
        MOTIONRACK_CHECK(wait_ready("a byte of the slope table"));
        port_.out(ports::DATA, table.byte(i));
    }
    return {};
}

Result<std::int64_t> Driver::deviation() {
    return ask(command("D"), 3);
}
Result<std::int64_t> Driver::position() {
    return ask(command("P"), 3);
}

Result<int> Driver::rate() {
    MOTIONRACK_TRY(const std::int64_t value, ask(command("R"), 2));
    return static_cast<int>(value);
}

Result<int> Driver::version() {
    MOTIONRACK_TRY(const std::int64_t value, ask(command("V"), 1));
    return static_cast<int>(value & 0xFF);
}

// ---- mm

Result<std::int64_t> Driver::to_counts(double mm) const {
    const double counts = std::floor(mm * settings_.counts_per_mm + 0.5);
    if (!(counts >= static_cast<double>(map::min_24) && counts <= static_cast<double>(map::max_24)))
        return fail(ErrorKind::refused,
                    fmt::format("The position {} mm is beyond what card {} can count: {:.3f} to {:.3f} mm. Nothing "
                                "was moved.",
                                mm, settings_.select, to_mm(map::min_24), to_mm(map::max_24)));
    return static_cast<std::int64_t>(counts);
}

Result<double> Driver::position_mm() {
    MOTIONRACK_TRY(const std::int64_t counts, position());
    return to_mm(counts);
}

}  // namespace motionrack::databoard4002
