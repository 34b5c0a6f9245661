// Texts of the messages for the conditions that a chip reports.
#include <fmt/format.h>

#include <motionrack/cards/mcx314/chip/chip_conditions.hpp>

namespace motionrack::mcx314 {

std::string describe(const sim::Condition& condition, const std::string& card) {
    switch (condition.code) {
        case drive_ignored:
            return fmt::format(
                "{}: drive command {:02X}h was ignored because axis {} is driving; wait for its end or stop it first",
                card, condition.a, "XYZU"[condition.b & 3]);
        case path_ignored:
            return fmt::format(
                "{}: interpolation command {:02X}h was ignored: the next segment is queued already, an axis is used "
                "twice or has a drive of its own, or a bit pattern runs; wait for CNEXT or the end of the drive",
                card, condition.a);
        case pattern_full:
            return fmt::format(
                "{}: command 38h was ignored: three words of the bit pattern are stacked already; wait until BPSC is "
                "below 3",
                card);
        case pattern_ran_out:
            return fmt::format(
                "{}: the bit pattern ended after {} basic pulses without its end code, because no further words were "
                "stacked; stack them earlier, reduce the speed, or end with both bits of an axis set",
                card, condition.a);
        case step_ignored:
            return fmt::format(
                "{}: command 3Ah was ignored: no interpolation that waits for it (WR5 CMPLS at its command) runs, or "
                "its last step is not finished",
                card);
        case unknown_command:
            if (condition.b == 1)
                return fmt::format(
                    "{}: command {:02X}h belongs to the MCX314As, and this is an MCX314; nothing was done; set variant "
                    "= \"mcx314as\" for the card, or leave the command out",
                    card, condition.a);
            return fmt::format("{}: command {:02X}h does not exist on this model; nothing was done", card, condition.a);
        case output_held:
            return fmt::format(
                "{}: outputs stay low, bits {:04X}h of WR{}: a stop of the machine cleared them; write them low first, "
                "then high",
                card, condition.b, condition.a);
        default:
            return fmt::format("{}: condition {}", card, condition.code);
    }
}

}  // namespace motionrack::mcx314
