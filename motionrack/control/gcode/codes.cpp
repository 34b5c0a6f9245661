// The tables of G and M codes.
#include <fmt/format.h>

#include <array>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/lathe_cycle.hpp>

namespace motionrack::control::gcode {

namespace {

struct CodeG {
    std::int16_t tenths;
    GroupG group;
};

constexpr CodeG known_g[] = {
    {0, g_motion},         {10, g_motion},        {20, g_motion},       {30, g_motion},       {50, g_motion},
    {51, g_motion},        {52, g_refused},       {53, g_refused},      {800, g_motion},      {730, g_motion},
    {740, g_motion},       {840, g_motion},       {850, g_motion},      {860, g_motion},      {890, g_motion},
    {870, g_refused},      {880, g_refused},      {70, g_refused},      {80, g_refused},      {700, g_motion},
    {710, g_motion},       {711, g_motion},       {712, g_motion},      {720, g_motion},      {721, g_motion},
    {722, g_motion},       {810, g_motion},       {820, g_motion},      {830, g_motion},      {40, g_nonmodal},
    {100, g_nonmodal},     {280, g_nonmodal},     {281, g_nonmodal},    {300, g_nonmodal},    {301, g_nonmodal},
    {530, g_nonmodal},     {920, g_nonmodal},     {921, g_nonmodal},    {922, g_nonmodal},    {923, g_nonmodal},
    {170, g_plane},        {180, g_plane},        {190, g_plane},       {900, g_distance},    {910, g_distance},
    {901, g_arc_distance}, {911, g_arc_distance}, {930, g_feed_mode},   {940, g_feed_mode},   {200, g_units},
    {210, g_units},        {400, g_cutter},       {431, g_tool_length}, {490, g_tool_length}, {980, g_retract},
    {990, g_retract},      {540, g_system},       {550, g_system},      {560, g_system},      {570, g_system},
    {580, g_system},       {590, g_system},       {610, g_path},        {611, g_path},        {640, g_path},
    {382, g_motion},       {383, g_motion},       {384, g_motion},      {385, g_motion},      {410, g_cutter},
    {411, g_cutter},       {420, g_cutter},       {421, g_cutter},      {430, g_tool_length}, {432, g_tool_length},
    {591, g_system},       {592, g_system},       {593, g_system},      {950, g_refused},     {330, g_refused},
    {331, g_refused},      {760, g_refused},      {960, g_refused},     {970, g_spindle}};

struct CodeM {
    std::int16_t code;
    GroupM group;
};

constexpr CodeM known_m[] = {{0, m_stop},        {1, m_stop},      {2, m_stop},      {30, m_stop},     {6, m_tool},
                             {3, m_spindle},     {4, m_spindle},   {5, m_spindle},   {7, m_mist},      {8, m_flood},
                             {9, m_coolant_off}, {60, m_stop},     {61, m_tool},     {48, m_override}, {49, m_override},
                             {50, m_override},   {51, m_override}, {52, m_override}, {53, m_override}, {70, m_state},
                             {71, m_state},      {72, m_state},    {73, m_state},    {62, m_io},       {63, m_io},
                             {64, m_io},         {65, m_io},       {66, m_io},       {67, m_io},       {68, m_io},
                             {98, m_program},    {99, m_program}};

template <class Group, std::size_t size, class List>
constexpr std::array<Group, size> make_table(Group unknown, const List& list) {
    std::array<Group, size> table = {};
    for (auto& group : table) group = unknown;
    for (const auto& [code, group] : list) table[code] = group;
    return table;
}

constexpr auto table_g = make_table<GroupG, 1000>(g_unknown, known_g);
constexpr auto table_m = make_table<GroupM, 100>(m_unknown, known_m);

}  // namespace

GroupG group_of_g(int tenths) {
    return tenths < 0 || tenths >= 1000 ? g_unknown : table_g[tenths];
}

GroupM group_of_m(int code) {
    return code < 0 || code >= 100 ? m_unknown : table_m[code];
}

std::string name_of_g(int tenths) {
    return tenths % 10 == 0 ? fmt::format("G{}", tenths / 10) : fmt::format("G{}.{}", tenths / 10, tenths % 10);
}

std::string members_of_g(GroupG group) {
    std::string names;
    for (const CodeG& known : known_g) {
        if (known.group != group) continue;
        if (!names.empty()) names += ' ';
        names += name_of_g(known.tenths);
    }
    return names;
}

std::string members_of_m(GroupM group) {
    std::string names;
    for (const CodeM& known : known_m) {
        if (known.group == group) names += fmt::format("{}M{}", names.empty() ? "" : " ", known.code);
    }
    return names;
}

std::string known_m_codes() {
    std::string names;
    for (int code = 0; code < 100; ++code)
        if (table_m[static_cast<std::size_t>(code)] != m_unknown)
            names += fmt::format("{}M{}", names.empty() ? "" : " ", code);
    return names;
}

bool is_for_senders(GroupG group, int tenths) {
    const bool turns = group == g_motion && is_turning(static_cast<std::int16_t>(tenths));
    return group != g_spindle && !turns && !(group == g_system && tenths > 590) &&
           !(group == g_tool_length && (tenths == 430 || tenths == 432));
}

std::string why_not_g(int tenths) {
    const std::string name = name_of_g(tenths);
    if (tenths == 52 || tenths == 53) {
        return name +
               ": NURBS are not supported; let the CAM program write G5 (cubic) or G5.1 (quadratic) curves, or arcs";
    }
    if (tenths == 430 || tenths == 432) {
        return name + ": lines from a sender have no tool table; write the tool's length itself, e.g. G43.1 Z12.5";
    }
    if (tenths >= 591 && tenths <= 593) return name + ": lines from a sender have six work systems, G54 to G59";
    if (tenths == 950 || tenths == 330 || tenths == 331 || tenths == 760) {
        return name + " needs the angle of the spindle, which this machine does not measure; use G94 (mm/min) or G93";
    }
    if (is_turning(static_cast<std::int16_t>(tenths)) && group_of_g(tenths) == g_motion)
        return name + ": lines from a sender have no contour to turn; run the program as a file";
    if (tenths == 70)
        return "G7: X is a radius here, never a diameter; let the CAM program write radii, and leave G7 out";
    if (tenths == 80) return "G8: X is always a radius here; leave it out";
    if (tenths == 870)
        return name +
               ": back boring needs an oriented spindle stop, which this machine does not have; use "
               "G85, G86 or G89";
    if (tenths == 880) return name + ": a manual retract of the tool is not possible here; use G86 or G89";
    if (tenths == 960) return name + ": spindle speed is always in rev/min here (G97); leave it out";
    if (tenths == 970) return name + ": spindle speed is always in rev/min; leave it out";
    return name + " is not a known command; the line was not executed";
}

std::string why_not_m(int code) {
    if (code == 56) return "M56 (parking override) is not supported: this machine does not park; leave it out";
    return fmt::format("M{} is not a known command; known are {}", code, known_m_codes());
}

}  // namespace motionrack::control::gcode
