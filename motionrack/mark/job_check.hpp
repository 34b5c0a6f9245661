// Checks constraints between keys whose values are valid individually.
#pragma once

#include <motionrack/mark/marking_job.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::mark {

/// Reports each violation as an error with its position in the file.
void check_job(const rack::TomlNode& root, const MarkingJob& job, rack::Problems& problems);

}  // namespace motionrack::mark
