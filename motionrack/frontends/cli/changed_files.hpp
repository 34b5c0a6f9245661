// Detection of part programs whose files change during a run.
#pragma once

#include <map>
#include <string>

namespace motionrack::cli {

/// Warns if the file of a program or of a subprogram beside it differs from the text read before the run.
/// `subprograms`: texts by name. Standard input and the built-in example never change.
void warn_of_changes(const std::string& program, const std::string& text,
                     const std::map<std::string, std::string>& subprograms);

}  // namespace motionrack::cli
