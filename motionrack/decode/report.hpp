// What an analysis found, for people and as JSON.
#pragma once

#include <motionrack/decode/analysis.hpp>
#include <string>

namespace motionrack::decode {

/// Tables; of each list the first `shown` entries.
std::string analysis_text(const Analysis& analysis, const std::string& name, std::size_t shown);

/// Everything that was kept; numbers in counts, seconds and counts a second.
std::string analysis_json(const Analysis& analysis, const std::string& name);

/// What a reader should be warned of: lines without a level, X and Z, a file that is cut off is not among them.
std::vector<std::string> analysis_warnings(const Analysis& analysis);

}  // namespace motionrack::decode
