// Expressions of BASIC II: numbers, texts, AND OR NOT, = <> < > <= >=, + - * /, functions.
//
// Numbers are whole, -32768 .. 32767; a division leaves its remainder out; true is -1, false 0.
#pragma once

#include <string>
#include <vector>

#include "program.hpp"

namespace basic {

struct Value {
    bool is_text = false;
    int number = 0;
    std::string text;
};

/// The word that is looked at, and errors in its line.
struct Cursor {
    const Program& program;
    std::size_t at = 0;

    const Token& here() const { return program.tokens[at]; }
    bool is(Kind kind, const char* text) const { return here().kind == kind && here().text == text; }
    bool take(Kind kind, const char* text) {
        const bool taken = is(kind, text);
        at += taken ? 1 : 0;
        return taken;
    }
    /// Throws unless the symbol follows, which it takes.
    void need(const char* symbol) {
        if (!take(Kind::symbol, symbol)) wrong("'" + std::string(symbol) + "' is missing");
    }
    /// The word as the error messages have it.
    std::string shown() const;
    [[noreturn]] void wrong(const std::string& what) const {
        fail(program.name, here().line, what + ". The program was ended.");
    }
};

/// Services of the interpreter that expressions use.
class Context {
  public:
    virtual ~Context() = default;
    /// A variable that has no value yet is 0 or "".
    virtual Value variable(const std::string& name) = 0;
    virtual Value call(const std::string& function, const std::vector<Value>& arguments) = 0;
    virtual int input(int port) = 0;
};

class Expressions {
  public:
    static constexpr int max_depth = 16;  ///< brackets within each other, in one function

    Expressions(Cursor& cursor, Context& context) : cursor_(cursor), context_(context) {}

    /// The expression at the cursor, which goes behind it. Throws old_host::Failure with the line.
    Value value();
    int number() { return number_of(value()); }
    /// A number as the language has it; throws if it is outside.
    int checked(long long number) const;

  private:
    Value conjunction();
    Value negation();
    Value comparison();
    Value sum();
    Value product();
    Value sign();
    Value primary();
    Value built_in(const std::string& name);
    Value function();
    Value compared(const std::string& with, const Value& left, const Value& right) const;
    std::string text_of(const Value& value) const;
    int number_of(const Value& value) const;
    int character(int code) const;
    Value of(long long number) const { return {false, checked(number), {}}; }

    Cursor& cursor_;
    Context& context_;
    int depth_ = 0;
};

}  // namespace basic
