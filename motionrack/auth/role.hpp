// Maximum rights of a caller: each role includes the rights of the roles before it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace motionrack::auth {

enum class Role : std::uint8_t {
    none,     ///< STOP and pairing only
    observe,  ///< reads status and data
    operate,  ///< moves the machine
    maintain  ///< injects faults, writes registers, invites users
};

inline constexpr std::array<std::string_view, 4> role_names = {"none", "observe", "operate", "maintain"};
constexpr std::string_view name_of(Role role) {
    return role_names[static_cast<std::size_t>(role)];
}
constexpr std::optional<Role> role_named(std::string_view name) {
    for (std::size_t i = 0; i < role_names.size(); ++i)
        if (role_names[i] == name) return static_cast<Role>(i);
    return std::nullopt;
}

}  // namespace motionrack::auth
