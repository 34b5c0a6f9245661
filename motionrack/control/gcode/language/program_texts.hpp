// The texts of a program: its own, and those of the files of its subprograms.
#pragma once

#include <memory>
#include <motionrack/control/gcode/language/oword_index.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace motionrack::control::gcode {

class ProgramTexts {
  public:
    struct ProgramSource {
        std::string kept;  ///< storage of `text`, unless it is the program
        std::string_view text;
        std::string file;
        std::optional<OWordIndex> index;
    };
    /// A sub or a numbered program.
    struct SubTarget {
        ProgramSource* source;
        std::int32_t location;
    };

    /// `text` of the program must stay valid.
    ProgramTexts(std::string_view text, std::string file, bool block_delete);

    ProgramSource& program() { return *sources_.front(); }
    const ProgramSource& program() const { return *sources_.front(); }
    std::size_t size() const { return sources_.size(); }
    /// Adds the text of a file.
    ProgramSource& add(std::string text, std::string file);
    /// Indexes the O words of a text. Returns false if there is any fault.
    bool make_index(ProgramSource& source);
    /// Finds a sub or a numbered program in the indexed texts, first in `here`. Returns false if none has it.
    bool find(ProgramSource& here, const std::string& label, bool numbered, SubTarget& target) const;

    /// Returns true if O words of a text do not match, as an if without endif.
    bool has_faults() const { return !faults_.empty(); }
    void add_fault(Problem fault) { faults_.push_back(std::move(fault)); }
    /// Removes and returns the first fault. Requires has_faults().
    Problem take_fault();

  private:
    bool block_delete_;
    std::vector<std::unique_ptr<ProgramSource>> sources_;  ///< the first one is the program
    std::vector<Problem> faults_;
};

}  // namespace motionrack::control::gcode
