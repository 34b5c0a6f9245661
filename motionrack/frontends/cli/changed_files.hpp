// Part programs whose files change while they run.
#pragma once

#include <map>
#include <string>

namespace motionrack::cli {

/// Warns where the file of a program, or of a subprogram beside it, is not what was read from it before it ran.
/// `subprograms`: texts by names. Programs that are no files (standard input, the built-in example) never change.
void warn_of_changes(const std::string& program, const std::string& text,
                     const std::map<std::string, std::string>& subprograms);

}  // namespace motionrack::cli
