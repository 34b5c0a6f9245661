// A program in BASIC II: its words line after line, with its functions, data and ends of loops.
//
//   "1300 Q7=FNGoPosition(1000) ! TO C"  ──►  name Q7, symbol =, function FNGOPOSITION, ( 1000 ), end of line
//
// A word in capitals that the language knows is its own; any other is a variable, so that DATA is a statement and Data
// a number. Capitals and small letters of a variable are the same.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace basic {

enum class Kind { number, text, keyword, name, function, symbol, end_of_line, end };

struct Token {
    Kind kind = Kind::end;
    std::string text;  ///< without quotes; names in capitals
    int number = 0;
    int line = 0;  ///< the number before the line
};

struct Function {
    std::vector<std::string> parameters;
    std::size_t body = 0;  ///< the first token behind its head
    std::size_t end = 0;   ///< FNEND
};

struct Datum {
    int line = 0;
    bool is_text = false;
    int number = 0;
    std::string text;
};

struct Program {
    std::string name;  ///< of its file, for errors
    std::vector<Token> tokens;
    std::map<int, std::size_t> lines;  ///< the first token of each
    std::map<std::string, Function> functions;
    std::vector<Datum> data;
    std::map<std::size_t, std::size_t> partners;  ///< WHILE and WEND, FOR and NEXT, each to the other; DEF to FNEND
};

/// Reads a program. Throws old_host::Failure with the line: a word that is not understood, lines out of order, a loop
/// or function without its end.
Program read(const std::string& name, const std::string& text);

/// Throws old_host::Failure: "NAME: line 20: WHAT".
[[noreturn]] void fail(const std::string& name, int line, const std::string& what);

}  // namespace basic
