// Comparisons of each kind of file.
#pragma once

#include <motionrack/trace/diff.hpp>

namespace motionrack::trace {

/// Compares VCD files or tables of changes.
Result<Diff> diff_changes(const std::string& a, const std::string& b, FileKind kind, const DiffSettings& settings);
/// Compares CSV tables with one row per sample or event.
Result<Diff> diff_tables(const std::string& a, const std::string& b, const DiffSettings& settings);
/// Sorts by time; differences without an instant come first.
void sort_differences(Diff& diff);

}  // namespace motionrack::trace
