// Runs a program in BASIC II, statement by statement, each of which takes a millisecond.
//
//   Program ──► Interpreter ── INP, OUT ──► Machine
//                          └── PRINT, GET ──► Terminal
#pragma once

#include <map>
#include <string>
#include <vector>

#include "../z80_host/terminal.hpp"
#include "expressions.hpp"
#include "program.hpp"

namespace basic {

class Interpreter final : private Context {
  public:
    Interpreter(const Program& program, old_host::Machine& machine, old_host::Terminal& terminal)
        : program_(program), machine_(machine), terminal_(terminal) {}

    /// Runs it until the last round is over or its end (true), or STOP (false). Throws old_host::Failure with the line.
    bool run();

  private:
    static constexpr std::size_t max_depth = 64;  ///< calls within each other

    struct Loop {
        int limit = 0;
        int step = 1;
    };
    /// The main program, or a function that is being worked on.
    struct Frame {
        bool function = false;
        bool returned = false;
        Value result;
        std::map<std::size_t, Loop> loops;  ///< by the place of FOR
        std::vector<std::size_t> gosubs;    ///< where to go on
    };
    using Statement = void (Interpreter::*)();

    Value variable(const std::string& name) override;
    Value call(const std::string& function, const std::vector<Value>& arguments) override;
    int input(int port) override;

    static const std::map<std::string, Statement>& statements();
    void execute(Frame& frame);
    void statement();
    bool at_end_of_statement() const;
    void skip_line();
    std::string target();
    void store(const std::string& name, const Value& value);
    std::size_t line_at(int number) const;

    void assign();
    void print();
    void if_then();
    void while_loop();
    void wend();
    void for_loop();
    void next();
    void go_to();
    void go_sub();
    void give_back();
    void read();
    void restore();
    void out();
    void get();
    void define();
    void function_end();
    void stop();
    void end();

    const Program& program_;
    old_host::Machine& machine_;
    old_host::Terminal& terminal_;
    Cursor cursor_{program_};
    Expressions values_{cursor_, *this};
    std::map<std::string, Value> variables_;
    std::size_t next_datum_ = 0;
    std::size_t depth_ = 0;
    Frame* frame_ = nullptr;
    bool over_ = false;
    bool stopped_ = false;
};

}  // namespace basic
