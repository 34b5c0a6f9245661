// Point of a sweep: one run with all its inputs in one text, so that every machine computes the same row from it.
//
//   PointText ──text_of──► text ──key_of──► key              rack, program, subprograms, tools, faults
//                          └───run_point──► row             ended, time, deviation, axes, trace hash
#pragma once

#include <atomic>
#include <map>
#include <motionrack/base/result.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace motionrack::sweep {

struct PointText {
    std::string rack;                                ///< text of a rack file
    std::string program;                             ///< text of a part program
    std::map<std::string, std::string> subprograms;  ///< texts of subprograms called from outside the program
    std::string tools;                               ///< text of a tool table; empty: none
    bool block_delete = false;
    std::vector<std::string> faults;  ///< "X.limit_plus=0@1.5s"
};

/// The text contains the program version, because another version may compute another row.
std::string text_of(const PointText& point);
/// Errors: invalid_input if it is not such a text; refused if another version wrote it.
Result<PointText> read_point(std::string_view text);

/// Identifies a point: 32 hexadecimal digits of the text's hash.
std::string key_of(std::string_view text);

/// Results of a point by column name; numbers as the shortest text that reads back as the same number. A row has the
/// columns of the rack's axes.
using Row = std::vector<std::pair<std::string, std::string>>;

/// A possible column of a row.
struct ResultColumn {
    std::string name;
    std::string unit;  ///< empty: no unit
    bool text = false;
};
/// All columns in table order: ended, time_s, max_deviation_mm, those of each axis, trace_hash.
std::span<const ResultColumn> result_columns();

/// Returns the cell of that name; empty if missing.
std::string_view cell_of(const Row& row, std::string_view column);

/// Runs the point from start to end, independent of anything else: the same text gives the same row on every machine.
/// The row includes errors of the run. `stop` may be nullptr. Errors: as read_point; invalid_input if its rack is
/// invalid; stopped.
Result<Row> run_point(std::string_view text, const std::atomic<bool>* stop);

}  // namespace motionrack::sweep
