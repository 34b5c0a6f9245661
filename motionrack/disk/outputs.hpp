// Rules for the output paths of commands.
#pragma once

#include <motionrack/base/result.hpp>
#include <string>
#include <vector>

namespace motionrack::disk {

/// Returns true for a device, a pipe, or a path in /dev or /proc. These are written in place without loss.
bool is_device(const std::string& path);

/// Checks all outputs before a command starts. An output must not be an input of the command, a symbolic link, or
/// another output, under any name. Empty names and "-" are skipped. Errors: refused, a sentence.
Result<void> may_write(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

}  // namespace motionrack::disk
