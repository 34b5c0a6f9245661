// A point of a sweep: one run, with everything that it is made of in one text, so that any machine computes the same
// row from it.
//
//   PointText ──text_of──► text ──key_of──► key              rack, program, subprograms, tools, faults
//                           └───run_point──► row             ended, time, deviation, axes, hash of the history
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
    std::map<std::string, std::string> subprograms;  ///< texts of those that the program calls and does not have itself
    std::string tools;                               ///< text of a tool table; empty: none
    bool block_delete = false;
    std::vector<std::string> faults;  ///< "X.limit_plus=0@1.5s"
};

/// Of this version of the program, which stands in it: another one may compute another row.
std::string text_of(const PointText& point);
/// Errors: invalid_input, it is no such text; refused, another version made it.
Result<PointText> read_point(std::string_view text);

/// Tells points apart: 32 hexadecimal digits of the text's hash.
std::string key_of(std::string_view text);

/// The results of a point: columns by their names, with numbers as the shortest text that reads back to the same
/// number. A row has the columns of axes that the rack has.
using Row = std::vector<std::pair<std::string, std::string>>;

/// A column that a row may have.
struct ResultColumn {
    std::string name;
    std::string unit;  ///< empty: none
    bool text = false;
};
/// All columns, in the order of tables: ended, time_s, worst_deviation_mm, those of each axis, trace_hash.
std::span<const ResultColumn> result_columns();

/// The cell of that name; empty if the row has none.
std::string_view cell_of(const Row& row, std::string_view column);

/// Runs the point from its start to its end, and nothing else: the same text gives the same row on every machine. What
/// goes wrong in the run is in the row. `stop` may be nullptr. Errors: as read_point; invalid_input, its rack cannot be
/// read; stopped.
Result<Row> run_point(std::string_view text, const std::atomic<bool>* stop);

}  // namespace motionrack::sweep
