// Messages for the card's conditions.
#include <fmt/format.h>

#include <motionrack/cards/databoard4002/model/conditions.hpp>
#include <motionrack/cards/databoard4002/slope_table.hpp>

namespace motionrack::databoard4002 {

namespace {

/// Formats a command byte as readable text.
std::string byte_text(std::int64_t code) {
    return code > 0x20 && code < 0x7F ? fmt::format("'{}'", static_cast<char>(code)) : fmt::format("{:02X}h", code);
}

const char* flaw_text(std::int64_t flaw) {
    switch (static_cast<SlopeFlaw>(flaw)) {
        case SlopeFlaw::speed_zero:
            return "has the speed 0, so the move stops there";
        case SlopeFlaw::descending:
            return "ends before the preceding one, so it is never used";
        case SlopeFlaw::too_far:
            return "ends beyond 8,388,607 counts, farther than any move";
        case SlopeFlaw::none:
            break;
    }
    return "is in order";
}

std::string what_happened(const sim::Condition& c) {
    switch (static_cast<CardCondition>(c.code)) {
        case CardCondition::access_lost:
            if (c.b < 0) return fmt::format("an INP {} came while the card was not Ready; it changed nothing", c.a);
            return fmt::format("an OUT {} of {:02X}h came while the card was not Ready and was lost", c.a, c.b);
        case CardCondition::unknown_command:
            return fmt::format("the command {} is unknown and did nothing", byte_text(c.a));
        case CardCondition::arguments_dropped:
            return fmt::format("the arguments of {} were cut short after {} bytes by another command", byte_text(c.a),
                               c.b);
        case CardCondition::data_unexpected:
            return fmt::format("a data byte {:02X}h came that no command waits for; it was dropped", c.a);
        case CardCondition::during_move:
            return fmt::format(
                "the command {} came during a move; the move keeps its target and table until G replaces it",
                byte_text(c.a));
        case CardCondition::move_refused:
            return fmt::format(
                "a move from {} to {} was refused: targets are -8,388,608 to 8,388,607 and a move is at most "
                "8,388,607 counts long",
                c.b, c.a);
        case CardCondition::go_in_emergency:
            return fmt::format("G was refused at {} because the emergency stop is active; release it and send G again",
                               c.a);
        case CardCondition::move_aborted:
            return fmt::format("the emergency stop ended the move to {} at {}", c.b, c.a);
        case CardCondition::table_flawed:
            return fmt::format("interval {} of the slope table {}", c.b, flaw_text(c.a));
        case CardCondition::position_wrapped:
            return fmt::format("the counter left its 24 bits at {}; positions read now are 16,777,216 off", c.a);
        case CardCondition::rate_exceeded:
            return fmt::format("the encoder reached {} counts/s, above the limit of the inputs; counts are lost", c.a);
        case CardCondition::counts_lost:
            return fmt::format("the encoder is slow enough again; {} counts were lost, so search the reference again",
                               c.a);
        case CardCondition::line_too_quick:
            return fmt::format(
                "the line O{} changed faster than the input can follow; counts are lost, so search the reference again",
                c.a);
        case CardCondition::watchdog_reset:
            return "the watchdog restarted the firmware, which had hung; position and settings are lost";
    }
    return fmt::format("condition {} ({}, {})", c.code, c.a, c.b);
}

}  // namespace

std::string describe(const sim::Condition& condition, std::string_view card) {
    return fmt::format("card {}: at {:.6f} s {}", card, to_seconds(condition.at), what_happened(condition));
}

}  // namespace motionrack::databoard4002
