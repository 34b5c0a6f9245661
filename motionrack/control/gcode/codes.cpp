// Names, groups and explanations of G and M codes.
#include <fmt/format.h>

#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/words.hpp>

namespace motionrack::control::gcode {

GroupG group_of_g(int tenths) {
    return static_cast<GroupG>(rule_of_g(tenths).group);
}

GroupM group_of_m(int code) {
    return static_cast<GroupM>(rule_of_m(code).group);
}

std::string name_of_g(int tenths) {
    return tenths % 10 == 0 ? fmt::format("G{}", tenths / 10) : fmt::format("G{}.{}", tenths / 10, tenths % 10);
}

std::string members_of_g(GroupG group) {
    std::string names;
    for (const WordRule& rule : words_g()) {
        if (rule.group != group) continue;
        if (!names.empty()) names += ' ';
        names += name_of_g(rule.code);
    }
    return names;
}

std::string members_of_m(GroupM group) {
    std::string names;
    for (const WordRule& rule : words_m()) {
        if (rule.group == group) names += fmt::format("{}M{}", names.empty() ? "" : " ", rule.code);
    }
    return names;
}

std::string known_m_codes() {
    std::string names;
    for (int code = 0; code < 100; ++code)
        if (group_of_m(code) != m_unknown) names += fmt::format("{}M{}", names.empty() ? "" : " ", code);
    return names;
}

bool is_for_senders(int tenths) {
    return rule_of_g(tenths).refusal.empty();
}

std::string why_not_g(int tenths) {
    const std::string_view why = rule_of_g(tenths).refusal;
    return name_of_g(tenths).append(why.empty() ? " is not a known command; the line was not executed" : why);
}

std::string why_not_m(int code) {
    if (const std::string_view why = rule_of_m(code).refusal; !why.empty()) return fmt::format("M{}{}", code, why);
    return fmt::format("M{} is not a known command; known are {}", code, known_m_codes());
}

}  // namespace motionrack::control::gcode
