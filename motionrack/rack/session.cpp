// Opening, time and the bus.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/session.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

Session::Session(const RackConfig& config) : rack_(config), tap_(std::make_unique<WireTap>(rack_.kernel())) {
    rack_.input_log().keep_no_more();
    rack_.start();
}

Session::~Session() = default;

Result<std::unique_ptr<Session>> Session::open(std::string_view path_or_text) {
    const RackReading reading = read_rack(path_or_text);
    if (reading.config) return std::unique_ptr<Session>(new Session(*reading.config));
    Error all = reading.errors.front();
    all.message = all.text();
    all.file.clear();
    all.place = {};
    for (std::size_t i = 1; i < reading.errors.size(); ++i) all.message += '\n' + reading.errors[i].text();
    return tl::unexpected<Error>(std::move(all));
}

// ---- time -------------------------------------------------------------------------------------------------------------

Result<void> Session::room_for(Duration time) const {
    if (now() <= latest - time) return {};
    return fail(Trouble::refused,
                fmt::format("The rack's time is {:.0f} s and ends at {:.0f} s; nothing was run. Open a new rack.",
                            to_seconds(now()), to_seconds(latest)));
}

Result<void> Session::advance(std::uint64_t ns) {
    if (ns > most_ns)
        return fail(Trouble::refused, fmt::format("{} ns are more than one call may run, {} ns; nothing was run. Call "
                                                  "several times.",
                                                  ns, most_ns));
    const Duration time = nanoseconds(static_cast<std::int64_t>(ns));
    MOTIONRACK_CHECK(room_for(time));
    run_to(now() + time);
    return {};
}

void Session::run_to(Instant until) {
    while (rack_.kernel().run_until(until) == sim::RunEnd::broken) {
    }
}

// ---- the bus ----------------------------------------------------------------------------------------------------------

Result<Card*> Session::find_card(std::string_view name) {
    if (Card* card = rack_.card(name)) return card;
    std::string known;
    for (const auto& card : rack_.cards()) known += (known.empty() ? "" : ", ") + card->name();
    return fail(Trouble::bad_input, fmt::format("There is no card {} in this rack; its cards are: {}. Nothing was done.",
                                                in_quotes(name), known));
}

Result<Card*> Session::bus_of(std::string_view name, int bits, std::uint32_t address, bool writing) {
    MOTIONRACK_TRY(Card * card, find_card(name));
    const std::span<const int> widths = card->bus_widths();
    if (std::find(widths.begin(), widths.end(), bits) == widths.end())
        return fail(Trouble::refused,
                    fmt::format("Card {} is a {}: its bus makes accesses of {} bits, not of {}. Nothing was done.",
                                card->name(), card->map().name, fmt::join(widths, ", "), bits));
    std::uint32_t first = ~0u, last = 0;
    for (const RegisterInfo& reg : card->map().registers) {
        if ((reg.access == Access::write) != writing) continue;
        if (reg.offset == address) return card;
        first = std::min(first, reg.offset);
        last = std::max(last, reg.offset);
    }
    return fail(Trouble::refused,
                fmt::format("Card {} has no register to {} at offset 0x{:02x}; there are some from 0x{:02x} to 0x{:02x}, "
                            "{} bytes apart at least. Nothing was done.",
                            card->name(), writing ? "write" : "read", address, first, last, bits / 8));
}

Result<std::uint32_t> Session::read(std::string_view card, int bits, std::uint32_t address) {
    MOTIONRACK_TRY(Card * on, bus_of(card, bits, address, false));
    MOTIONRACK_CHECK(room_for(milliseconds(1)));
    return on->bus_read(bits, address);
}

Result<void> Session::write(std::string_view card, int bits, std::uint32_t address, std::uint32_t value) {
    MOTIONRACK_TRY(Card * on, bus_of(card, bits, address, true));
    MOTIONRACK_CHECK(room_for(milliseconds(1)));
    on->bus_write(bits, address, value);
    return {};
}

}  // namespace motionrack::rack
