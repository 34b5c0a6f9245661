// Which names a command may write to.
#pragma once

#include <motionrack/base/result.hpp>
#include <string>
#include <vector>

namespace motionrack::disk {

/// A device, a pipe, or a name in /dev or /proc: written as it is, and nothing is lost by it.
bool is_device(const std::string& path);

/// The one rule of all commands, before anything is done: no output is something that the command reads, a symbolic
/// link, or another output of it; by whatever name. Empty names and "-" are left out. Errors: refused, a sentence.
Result<void> may_write(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

}  // namespace motionrack::disk
