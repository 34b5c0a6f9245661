// The orders and queries of the panel that are about people: invite, unpair, users.
#pragma once

#include <functional>
#include <map>
#include <motionrack/auth/authenticator.hpp>
#include <motionrack/panel/panel.hpp>
#include <string>

namespace motionrack::server {

/// For PanelSettings::elsewhere; the door must outlive the panel.
std::map<std::string, panel::Handler, std::less<>> door_orders(auth::Authenticator& door);

/// "2026-01-31T12:00:00Z"
std::string utc_text(auth::WallTime time);

}  // namespace motionrack::server
