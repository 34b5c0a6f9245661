#include "asmz.hpp"

#include <algorithm>
#include <utility>

#include "expression.hpp"
#include "instructions.hpp"
#include "terminal.hpp"

namespace asmz {

namespace {

using old_host::Failure;

/// A line of the source: LABEL OPERATION OPERANDS COMMENT.
struct Statement {
    std::string label;
    std::string operation;
    std::vector<std::string> operands;
};

/// From `at` on to the next blank that no quotes enclose; `at` goes behind the blanks that follow.
std::string field(const std::string& line, std::size_t& at) {
    const std::size_t begin = at;
    for (bool quoted = false; at < line.size() && (quoted || line[at] != ' '); ++at)
        if (line[at] == '\'') quoted = !quoted;
    const std::string out = line.substr(begin, at - begin);
    at = std::min(line.find_first_not_of(' ', at), line.size());
    return out;
}

bool has_operands(const std::string& operation) {
    if (operation == "PROG" || operation == "EJECT") return false;
    const Instruction* row = instruction_of(operation);
    return row == nullptr || row->form != Form::none;
}

Statement statement_of(const std::string& line) {
    Statement out;
    std::size_t at = 0;
    if (line[0] != ' ')
        out.label = field(line, at);
    else
        at = line.find_first_not_of(' ');
    out.operation = field(line, at);
    if (!has_operands(out.operation)) return out;
    const std::string all = field(line, at);
    std::string one;
    bool quoted = false;
    for (const char c : all) {
        if (c == '\'') quoted = !quoted;
        if (c == ',' && !quoted)
            out.operands.push_back(std::exchange(one, {}));
        else
            one += c;
    }
    if (!all.empty()) out.operands.push_back(one);
    return out;
}

/// Two passes over the sources: the first gives the symbols, the second the bytes.
class Assembler {
  public:
    Assembler(const std::vector<Source>& sources, std::uint16_t origin) : sources_(sources) { out_.origin = origin; }

    Program run() {
        for (const bool final : {false, true}) {
            place_.final = final;
            out_.bytes.clear();
            out_.zilog = " org " + hex(out_.origin) + "\n";
            out_.start = out_.origin;
            for (const Source& each : sources_) pass(each);
        }
        return out_;
    }

  private:
    void pass(const Source& source) {
        int number = 1;
        for (std::size_t at = 0; at < source.text.size(); ++number) {
            const std::size_t end = std::min(source.text.find('\n', at), source.text.size());
            const std::string line = source.text.substr(at, end - at);
            at = end + 1;
            if (line.find_first_not_of(' ') == std::string::npos || line[0] == '*') continue;
            try {
                statement(statement_of(line));
            } catch (const Failure& failure) {
                throw Failure(source.name + ":" + std::to_string(number) + ": " + failure.what() +
                              ". Nothing was run. Correct the line.");
            }
        }
    }

    void statement(const Statement& line) {
        place_.here = out_.origin + static_cast<int>(out_.bytes.size());
        if (!line.label.empty() && line.operation != "=") define(line.label, place_.here);
        if (const Instruction* row = instruction_of(line.operation)) {
            const Encoded made = encode(*row, line.operands, place_);
            out_.bytes.insert(out_.bytes.end(), made.bytes.begin(), made.bytes.end());
            out_.zilog += made.zilog;
        } else if (has_operands(line.operation)) {
            directive(line);
        }
        if (out_.origin + out_.bytes.size() > 0xF000) throw Failure("the program reaches F000h, where the stack is");
    }

    void directive(const Statement& line) {
        if (line.operands.size() != (line.operation == "DMB" ? 2 : 1) && line.operation != "DA" &&
            line.operation != "DB")
            throw Failure("the operation '" + line.operation + "' with " + std::to_string(line.operands.size()) +
                          " operands is unknown");
        if (line.operation == "=") {
            define(line.label, value(line.operands[0]));
        } else if (line.operation == "END") {
            out_.start = static_cast<std::uint16_t>(value(line.operands[0]));
        } else if (line.operation == "DMB") {
            const int count = value(line.operands[0]);
            if (count < 0) throw Failure("DMB has a negative count");
            for (int i = 0; i < count; ++i) data(value(line.operands[1]));
        } else if (line.operation == "DA" || line.operation == "DB") {
            for (const std::string& each : line.operands) datum(line.operation == "DA", each);
        } else {
            throw Failure("the operation '" + line.operation + "' is unknown");
        }
    }

    void datum(bool word, const std::string& text) {
        if (word) {
            const int number = value(text);
            data(number);
            data(number >> 8);
        } else if (text.size() > 3 && text.front() == '\'' && text.find('\'', 1) == text.size() - 1) {
            for (const char c : text.substr(1, text.size() - 2)) data(static_cast<unsigned char>(c));
        } else {
            data(value(text));
        }
    }

    void data(int number) {
        out_.bytes.push_back(static_cast<std::uint8_t>(number & 0xFF));
        out_.zilog += " db " + hex(number & 0xFF) + "\n";
    }

    void define(const std::string& name, int number) {
        const auto [row, added] = out_.symbols.emplace(name, number);
        if (place_.final ? row->second != number : !added)
            throw Failure("the symbol '" + name + "' has two values, or needs one that comes later");
    }

    int value(const std::string& text) const {
        return value_of(text, place_.here, [this](const std::string& name) {
            const auto row = out_.symbols.find(name);
            if (row == out_.symbols.end() && place_.final) throw Failure("the symbol '" + name + "' is not defined");
            return row == out_.symbols.end() ? 0 : row->second;
        });
    }

    const std::vector<Source>& sources_;
    Program out_;
    Place place_{0, false, [this](const std::string& text) { return value(text); }};
};

}  // namespace

Program assemble(const std::vector<Source>& sources, std::uint16_t origin) {
    return Assembler(sources, origin).run();
}

int symbol(const Program& program, const std::string& name) {
    const auto row = program.symbols.find(name);
    if (row == program.symbols.end())
        throw Failure("The symbol " + name + " is not defined. Nothing was run. Define it in os8.asm.");
    return row->second;
}

}  // namespace asmz
