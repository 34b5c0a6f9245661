// Results of an analysis as text and as JSON.
#pragma once

#include <motionrack/decode/analysis.hpp>
#include <string>

namespace motionrack::decode {

/// Returns tables with the first `shown` entries of each list.
std::string analysis_text(const Analysis& analysis, const std::string& name, std::size_t shown);

/// Returns all stored results; numbers in counts, seconds and counts/s.
std::string analysis_json(const Analysis& analysis, const std::string& name);

/// Warnings for the reader: lines without a level, X and Z. A truncated file is not included.
std::vector<std::string> analysis_warnings(const Analysis& analysis);

}  // namespace motionrack::decode
