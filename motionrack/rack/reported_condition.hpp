// The conditions of a rack with their numbers, sources and sentences, for programs outside.
#pragma once

#include <cstdint>
#include <motionrack/rack/rack.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

/// A reported event as a sentence.
struct ReportedCondition {
    std::uint64_t number = 0;  ///< starts at 1; a gap shows that older ones were dropped
    Instant at{};
    std::string source;  ///< name of the card or other part; "rack" if none reported it
    int code = 0;        ///< condition code of this kind of device
    std::string sentence;
};

/// Returns the conditions with numbers above `since`, oldest first; the kernel stores the most recent ones.
std::vector<ReportedCondition> reported_conditions(Rack& rack, std::uint64_t since = 0);

}  // namespace motionrack::rack
