// Commands and queries of the panel about users: invite, revoke, list.
#pragma once

#include <functional>
#include <map>
#include <motionrack/auth/authenticator.hpp>
#include <motionrack/panel/panel.hpp>
#include <string>

namespace motionrack::server {

/// Handlers for PanelSettings::external; the authenticator must outlive the panel.
std::map<std::string, panel::Handler, std::less<>> door_orders(auth::Authenticator& door);

/// "2026-01-31T12:00:00Z"
std::string utc_text(auth::WallTime time);

}  // namespace motionrack::server
