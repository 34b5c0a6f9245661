// Indexes of texts, and the subs in them.
#include <algorithm>
#include <motionrack/control/gcode/language/program_texts.hpp>
#include <utility>

namespace motionrack::control::gcode {

ProgramTexts::ProgramTexts(std::string_view text, std::string file, bool block_delete) : block_delete_(block_delete) {
    sources_.push_back(std::make_unique<ProgramSource>());
    sources_.back()->text = text;
    sources_.back()->file = std::move(file);
}

ProgramTexts::ProgramSource& ProgramTexts::add(std::string text, std::string file) {
    ProgramSource& source = *sources_.emplace_back(std::make_unique<ProgramSource>());
    source.kept = std::move(text);
    source.text = source.kept;
    source.file = std::move(file);
    return source;
}

bool ProgramTexts::make_index(ProgramSource& source) {
    source.index = index_owords(source.text, block_delete_);
    for (Problem& problem : source.index->problems) {
        problem.file = source.file;
        faults_.push_back(std::move(problem));
    }
    return faults_.empty();
}

bool ProgramTexts::find(ProgramSource& here, const std::string& label, bool numbered, SubTarget& target) const {
    const auto open_in = [&](ProgramSource* source) {
        if (!source->index) return false;
        const auto& named = numbered ? source->index->programs : source->index->subs;
        const auto found = named.find(label);
        if (found == named.end()) return false;
        target = {source, found->second};
        return true;
    };
    return open_in(&here) ||
           std::any_of(sources_.begin(), sources_.end(), [&](const auto& source) { return open_in(source.get()); });
}

Problem ProgramTexts::take_fault() {
    Problem first = std::move(faults_.front());
    faults_.erase(faults_.begin());
    return first;
}

}  // namespace motionrack::control::gcode
