// What must hold between the keys of a job that are good by themselves.
#pragma once

#include <motionrack/mark/marking_job.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::mark {

/// Each mistake is an error with its place.
void check_job(const rack::TomlNode& root, const MarkingJob& job, rack::Problems& problems);

}  // namespace motionrack::mark
