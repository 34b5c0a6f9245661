// What a service manager (systemd) gives to and wants to know of a program that it runs.
#pragma once

#include <filesystem>
#include <string_view>

namespace motionrack::cli {

/// Tells the service manager, if there is one: "READY=1", "STOPPING=1".
void tell_service_manager(std::string_view state);

/// The folder for what this user's programs keep: systemd's state directory, else ~/.local/state/motionrack, made if it
/// is missing. Empty: there is none.
std::filesystem::path state_folder();

/// Lets this program hold as many files and connections open as it may.
void allow_many_files();

}  // namespace motionrack::cli
