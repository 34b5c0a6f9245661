// Formats the messages of the card's conditions.
#include <fmt/format.h>

#include <motionrack/cards/rtc5/map.hpp>
#include <motionrack/cards/rtc5/model/conditions.hpp>

namespace motionrack::rtc5 {

namespace {

std::string flag_sentence(std::int64_t number) {
    for (const BitInfo& bit : map::marking_info_bits)
        if (bit.bit == number)
            return fmt::format("{}: {}. {}", bit.name, bit.meaning,
                               number < 4 ? "The output is clipped to the field's edge, and the list continues; the "
                                            "part is too fast or the drawing starts too late"
                                          : "The list continues");
    return fmt::format("bit {} of the marking info was set", number);
}

std::string what_happened(const sim::Condition& c) {
    switch (static_cast<CardCondition>(c.code)) {
        case CardCondition::flag_set:
            return flag_sentence(c.a);
        case CardCondition::start_lost:
            return "an external start was lost: a list was running, or eight starts were waiting";
        case CardCondition::unwritten_place:
            return fmt::format("the list reached the empty position {} and ended; set_end_of_list is missing", c.a);
    }
    return fmt::format("condition {} ({}, {})", c.code, c.a, c.b);
}

}  // namespace

std::string describe(const sim::Condition& condition, std::string_view card) {
    return fmt::format("card {}: at {:.5f} s {}", card, static_cast<double>(condition.b) * 1e-5,
                       what_happened(condition));
}

}  // namespace motionrack::rtc5
