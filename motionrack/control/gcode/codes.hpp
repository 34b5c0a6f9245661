// Which G and M codes there are, their modal groups, and what to say of those that this reader refuses.
#pragma once

#include <motionrack/control/gcode/block.hpp>
#include <string>

namespace motionrack::control::gcode {

/// Group of a G code in tenths (0 .. 999); g_refused, g_unknown.
GroupG group_of_g(int tenths);

/// Group of an M code (0 .. 99); m_unknown.
GroupM group_of_m(int code);

/// "G38.2", "G1".
std::string name_of_g(int tenths);

/// "G0, G1, G2, G3, ..." of one group.
std::string members_of_g(GroupG group);
std::string members_of_m(GroupM group);

/// "M0 M1 .."
std::string known_m_codes();

/// Whether a line from a sender may have the code, as Grbl 1.1 takes it.
bool is_for_senders(GroupG group, int tenths);

/// Why a refused or unknown code is not done, and what to do instead.
std::string why_not_g(int tenths);
std::string why_not_m(int code);

}  // namespace motionrack::control::gcode
