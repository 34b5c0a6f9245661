// Interface to a service manager (systemd): state notifications and the state folder.
#pragma once

#include <filesystem>
#include <string_view>

namespace motionrack::cli {

/// Sends "READY=1" or "STOPPING=1" to the service manager, if one runs.
void notify_service_manager(std::string_view state);

/// Returns the folder for persistent state: systemd's state directory, else ~/.local/state/motionrack, which is created
/// if missing. Empty if neither exists.
std::filesystem::path state_folder();

/// Raises the limit of open files and connections to the maximum this process may have.
void allow_many_files();

}  // namespace motionrack::cli
