// A strict reader of VCD files, limited to IEEE 1364: the grammar of the header, each change in the form of its
// variable, ascending times.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace motionrack::test {

struct StrictVcd {
    struct Variable {
        std::string name;  ///< with its scopes: "X.X_step"
        bool is_real = false;
        std::int64_t rises = 0;  ///< edges of a wire from 0 to 1
        std::int64_t rises_at_start =
            0;  ///< those at the first time; readers that take samples see only the level after them
        char level = 'x';
        double number = 0;
        std::int64_t changes = 0;
    };
    std::map<std::string, Variable> variables;  ///< by identifier code
    std::string unit;                           ///< "100 ns"
    std::int64_t end = -1;                      ///< the last time
    std::string wrong;                          ///< first violation; empty: none

    explicit StrictVcd(const std::string& text) : words_(text) {
        read_head();
        if (wrong.empty()) read_changes();
    }

    /// Returns the variable of this name; nullptr if there is none.
    const Variable* find(const std::string& name) const {
        for (const auto& [code, variable] : variables)
            if (variable.name == name) return &variable;
        return nullptr;
    }

  private:
    bool refuse(const std::string& what) {
        if (wrong.empty()) wrong = what;
        return false;
    }
    std::vector<std::string> to_end() {
        std::vector<std::string> out;
        for (std::string word; words_ >> word && word != "$end";) out.push_back(word);
        return out;
    }

    void read_head() {
        std::vector<std::string> scopes;
        for (std::string word; words_ >> word;) {
            const std::vector<std::string> rest = to_end();
            if (word == "$enddefinitions") {
                if (!scopes.empty() || unit.empty() || !rest.empty()) refuse("the head ends too early");
                return;
            }
            if (word == "$timescale" && rest.size() == 2) {
                unit = rest[0] + ' ' + rest[1];
            } else if (word == "$scope" && rest.size() == 2 && rest[0] == "module") {
                scopes.push_back(rest[1]);
            } else if (word == "$upscope" && rest.empty() && !scopes.empty()) {
                scopes.pop_back();
            } else if (word == "$var" && rest.size() == 4) {
                declare(rest, scopes);
            } else if (word != "$version" && word != "$comment" && word != "$date") {
                refuse("'" + word + "' is not of the head");
            }
        }
        refuse("the head does not end");
    }

    void declare(const std::vector<std::string>& words, const std::vector<std::string>& scopes) {
        const bool is_wire = words[0] == "wire" && words[1] == "1", is_real = words[0] == "real" && words[1] == "64";
        if (!is_wire && !is_real) refuse("a variable of the type " + words[0] + " " + words[1]);
        std::string name;
        for (const std::string& scope : scopes) name += scope + '.';
        if (!variables.try_emplace(words[2], Variable{name + words[3], is_real}).second)
            refuse("the code " + words[2] + " stands for two variables");
    }

    void read_changes() {
        for (std::string word; words_ >> word && wrong.empty();) {
            if (word == "$dumpvars" || word == "$end") continue;
            if (word[0] == '#') {
                const std::int64_t at = std::strtoll(word.c_str() + 1, nullptr, 10);
                if (at <= end) refuse("time " + word + " does not rise");
                if (end < 0) begin_ = at;
                end = at;
            } else if (word[0] == 'r') {
                std::string code;
                words_ >> code;
                const auto found = variables.find(code);
                if (found == variables.end() || !found->second.is_real)
                    refuse("a number for '" + code + "'");
                else
                    found->second.number = std::strtod(word.c_str() + 1, nullptr), ++found->second.changes;
            } else if (word[0] == '0' || word[0] == '1') {
                const auto found = variables.find(word.substr(1));
                if (found == variables.end() || found->second.is_real)
                    refuse("a level for '" + word.substr(1) + "'");
                else
                    take(found->second, word[0]);
            } else {
                refuse("'" + word + "' is neither a time nor a change");
            }
        }
    }

    void take(Variable& variable, char level) {
        const bool rises = variable.level == '0' && level == '1';
        variable.rises += rises;
        variable.rises_at_start += rises && end == begin_;
        variable.level = level;
        ++variable.changes;
    }

    std::istringstream words_;
    std::int64_t begin_ = -1;  ///< the first time
};

}  // namespace motionrack::test
