// Checks accesses against a card's bus: its widths, its registers, its windows.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/bus_access.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

Result<Card*> card_named(Rack& rack, std::string_view name) {
    if (Card* card = rack.card(name)) return card;
    std::string known;
    for (const auto& card : rack.cards()) known += (known.empty() ? "" : ", ") + card->name();
    return fail(
        ErrorKind::invalid_input,
        fmt::format("Unknown card {}; the cards of this rack are: {}. Nothing was done.", in_quotes(name), known));
}

Result<Card*> card_for_access(Rack& rack, std::string_view name, int bits, std::uint32_t address, bool writing) {
    MOTIONRACK_TRY(Card * card, card_named(rack, name));
    const std::span<const int> widths = card->bus_widths();
    if (widths.empty())
        return fail(
            ErrorKind::refused,
            fmt::format("Card {} is of type {}: it has no registers on a bus. Nothing was done; use its own commands.",
                        card->name(), card->map().name));
    if (std::find(widths.begin(), widths.end(), bits) == widths.end())
        return fail(ErrorKind::refused,
                    fmt::format("Card {} is a {}: its bus makes accesses of {} bits, not of {}. Nothing was done.",
                                card->name(), card->map().name, fmt::join(widths, ", "), bits));
    const auto bytes = static_cast<std::uint32_t>(bits) / 8;
    const std::uint32_t base = card->bus_base();
    if (!writing && address >= base && address % bytes == 0 && card->in_window(address - base)) return card;
    std::uint32_t first = ~0u, last = 0;
    for (const RegisterInfo& reg : card->map().registers) {
        if ((reg.access == Access::write) != writing) continue;
        const std::uint32_t begin = base + reg.offset, end = begin + static_cast<std::uint32_t>(reg.width) / 8;
        if (address >= begin && address < end && (address - begin) % bytes == 0) return card;
        first = std::min(first, begin);
        last = std::max(last, end - bytes);
    }
    return fail(
        ErrorKind::refused,
        fmt::format("Card {} has nothing to {} with {} bits at offset 0x{:02x}; its registers are from 0x{:02x} to "
                    "0x{:02x}{}. Nothing was done.",
                    card->name(), writing ? "write" : "read", bits, address, first, last,
                    bytes > 1 ? fmt::format(", {} bytes apart", bytes) : ""));
}

}  // namespace motionrack::rack
