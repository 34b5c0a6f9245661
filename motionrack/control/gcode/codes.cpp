// The tables of G and M codes.
#include <fmt/format.h>

#include <array>
#include <motionrack/control/gcode/codes.hpp>

namespace motionrack::control::gcode {

namespace {

struct CodeG {
    std::int16_t tenths;
    GroupG group;
};

constexpr CodeG known_g[] = {
    {0, g_motion},         {10, g_motion},       {20, g_motion},       {30, g_motion},    {50, g_motion},
    {51, g_motion},        {52, g_refused},      {53, g_refused},      {800, g_motion},
    {810, g_motion},       {820, g_motion},      {830, g_motion},      {40, g_nonmodal},  {100, g_nonmodal},
    {280, g_nonmodal},     {281, g_nonmodal},    {300, g_nonmodal},    {301, g_nonmodal}, {530, g_nonmodal},
    {920, g_nonmodal},     {921, g_nonmodal},    {922, g_nonmodal},    {923, g_nonmodal}, {170, g_plane},
    {180, g_plane},        {190, g_plane},       {900, g_distance},    {910, g_distance}, {901, g_arc_distance},
    {911, g_arc_distance}, {930, g_feed_mode},   {940, g_feed_mode},   {200, g_units},    {210, g_units},
    {400, g_cutter},       {431, g_tool_length}, {490, g_tool_length}, {980, g_retract},  {990, g_retract},
    {540, g_system},       {550, g_system},      {560, g_system},      {570, g_system},   {580, g_system},
    {590, g_system},       {610, g_path},        {611, g_path},        {640, g_path},     {382, g_motion},
    {383, g_motion},      {384, g_motion},     {385, g_motion},     {410, g_cutter},   {411, g_cutter},
    {420, g_cutter},       {421, g_cutter},      {430, g_refused},     {432, g_refused},  {591, g_refused},
    {592, g_refused},      {593, g_refused},     {950, g_refused},     {330, g_refused},  {331, g_refused},
    {760, g_refused},      {960, g_refused},     {970, g_refused}};

struct CodeM {
    std::int16_t code;
    GroupM group;
};

constexpr CodeM known_m[] = {{0, m_stop}, {1, m_stop},    {2, m_stop},       {30, m_stop},
                             {6, m_tool}, {3, m_spindle}, {4, m_spindle},    {5, m_spindle},
                             {7, m_mist}, {8, m_flood},   {9, m_coolant_off}};

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

std::string why_not_g(int tenths) {
    const std::string name = name_of_g(tenths);
    if (tenths == 52 || tenths == 53) {
        return name + ": NURBS are not supported; let the CAM program put out G5 (cubic) or G5.1 (quadratic) curves, or arcs";
    }
    if (tenths == 430 || tenths == 432) {
        return name + ": there is no tool table; write the tool's length itself, e.g. G43.1 Z12.5";
    }
    if (tenths >= 591 && tenths <= 593) return name + ": there are six work systems, G54 to G59";
    if (tenths == 950 || tenths == 330 || tenths == 331 || tenths == 760) {
        return name + " needs the angle of the spindle, which this machine does not measure; use G94 (mm/min) or G93";
    }
    if (tenths == 960 || tenths == 970)
        return name + ": spindle speed is always in rev/min here (as G97); leave it out";
    return name + " is not a known command; nothing of this line was done";
}

std::string why_not_m(int code) {
    if (code == 56) return "M56 (parking override) is not supported: this machine does not park; leave it out";
    if (code == 98 || code == 99) return fmt::format("M{}: subprograms are not supported; write the lines out", code);
    return fmt::format("M{} is not a known command; known are M0 M1 M2 M3 M4 M5 M6 M7 M8 M9 M30", code);
}

}  // namespace motionrack::control::gcode
