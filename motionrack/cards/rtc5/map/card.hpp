// The map of the RTC5 in the types shared by all cards: list commands with parameters, status words bit by bit, pins.
#pragma once

#include <array>
#include <motionrack/base/card_map.hpp>
#include <motionrack/cards/rtc5/map/commands.hpp>
#include <motionrack/cards/rtc5/map/pins.hpp>
#include <motionrack/cards/rtc5/map/status.hpp>

namespace motionrack::rtc5::map {

template <std::size_t n>
constexpr std::array<FieldInfo, n> fields_of(const BitInfo (&bits)[n]) {
    std::array<FieldInfo, n> found{};
    for (std::size_t i = 0; i < n; ++i) found[i] = {bits[i].name, std::uint32_t{1} << bits[i].bit, bits[i].meaning};
    return found;
}
inline constexpr auto status_fields = fields_of(status_bits);
inline constexpr auto marking_info_fields = fields_of(marking_info_bits);
inline constexpr auto startstop_info_fields = fields_of(startstop_info_bits);
inline constexpr auto list_status_fields = fields_of(list_status_bits);

/// Status words that the card answers to queries. The card has no bus, so the offsets only distinguish them.
inline constexpr RegisterInfo words[] = {
    {"STATUS", 0, 32, Access::read, false, "", "answer of get_status, no register on a bus", status_fields},
    {"MARKING_INFO", 4, 32, Access::read_clears, false, "",
     "answer of get_marking_info, which clears all but the LIMIT bits; no register on a bus", marking_info_fields},
    {"STARTSTOP_INFO", 8, 32, Access::read_clears, false, "", "answer of get_startstop_info; no register on a bus",
     startstop_info_fields},
    {"LIST_STATUS", 12, 32, Access::read, false, "", "answer of read_status, no register on a bus", list_status_fields},
};
static_assert(declared<registers_flaw(words)>());

/// Text of a list command, as in "(X, Y, Angle): about the centre X, Y, laser on".
struct CommandText {
    std::array<char, 256> text{};
    std::size_t size = 0;
    constexpr void add(std::string_view more) {
        for (const char c : more) text[size++] = c;
    }
    constexpr std::string_view view() const { return {text.data(), size}; }
};
inline constexpr auto command_texts = [] {
    std::array<CommandText, op_count> found{};
    for (std::size_t i = 0; i < op_count; ++i) {
        const ListCommandInfo& command = list_commands[i];
        for (int p = 0; p < command.param_count(); ++p) {
            found[i].add(p == 0 ? "(" : ", ");
            found[i].add(command.params[static_cast<std::size_t>(p)].name);
        }
        if (command.param_count() > 0) found[i].add("): ");
        found[i].add(command.meaning);
    }
    return found;
}();
/// The list commands; the source does not give their codes, so the numbers are the project's own.
inline constexpr auto commands = [] {
    std::array<CommandInfo, op_count> found{};
    for (std::size_t i = 0; i < op_count; ++i) {
        found[i].name = list_commands[i].name;
        found[i].code = static_cast<std::uint32_t>(i);
        found[i].meaning = command_texts[i].view();
    }
    return found;
}();
static_assert(declared<commands_flaw(commands)>());

inline constexpr CardMap card = {"rtc5",
                                 "Control of laser scan heads: lists of vectors, processing on the fly by encoders or "
                                 "position words, field correction",
                                 words,
                                 commands,
                                 {},
                                 pins};

}  // namespace motionrack::rtc5::map
