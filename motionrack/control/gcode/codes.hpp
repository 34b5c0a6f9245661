// Names, modal groups and explanations of G and M codes, from the table in words.cpp.
#pragma once

#include <motionrack/control/gcode/block.hpp>
#include <string>

namespace motionrack::control::gcode {

/// Returns the group of a G code in tenths (0 .. 999), or g_refused, g_unknown.
GroupG group_of_g(int tenths);

/// Returns the group of an M code (0 .. 99), or m_unknown.
GroupM group_of_m(int code);

/// Returns the name of a G code in tenths: "G38.2", "G1".
std::string name_of_g(int tenths);

/// Returns the names of the codes of one group: "G0, G1, G2, G3, ...".
std::string members_of_g(GroupG group);
std::string members_of_m(GroupM group);

/// Returns the names of all M codes: "M0 M1 ..".
std::string known_m_codes();

/// Returns true if lines from a sender may use a supported G code, given in tenths; as in Grbl 1.1.
bool is_for_senders(int tenths);

/// Explains why a refused or unknown code is not supported, with a remedy.
std::string why_not_g(int tenths);
std::string why_not_m(int code);

}  // namespace motionrack::control::gcode
