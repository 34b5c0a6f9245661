// The comparisons of each kind of file.
#pragma once

#include <motionrack/trace/diff.hpp>

namespace motionrack::trace {

/// VCD files or tables of changes.
Result<Diff> diff_changes(const std::string& a, const std::string& b, FileKind kind, const DiffSettings& settings);
/// CSV tables with a row a sample or event.
Result<Diff> diff_tables(const std::string& a, const std::string& b, const DiffSettings& settings);
/// The earliest first; those without an instant before all.
void sort_differences(Diff& diff);

}  // namespace motionrack::trace
