#include "interpreter.hpp"

#include <cstdio>

namespace basic {

namespace {

constexpr std::uint64_t statement_ns = 1'000'000;

bool names_text(const std::string& name) {
    return name.back() == '$';
}

}  // namespace

// ---- the run

bool Interpreter::run() {
    Frame frame;
    execute(frame);
    return !stopped_;
}

void Interpreter::execute(Frame& frame) {
    Frame* const outer = frame_;
    frame_ = &frame;
    while (!over_ && !frame.returned) {
        if (cursor_.here().kind == Kind::end) {
            over_ = true;
        } else if (cursor_.here().kind == Kind::end_of_line || cursor_.is(Kind::symbol, ":")) {
            ++cursor_.at;
        } else {
            machine_.pass(statement_ns);
            statement();
        }
    }
    frame_ = outer;
}

const std::map<std::string, Interpreter::Statement>& Interpreter::statements() {
    static const std::map<std::string, Statement> table = {
        {"DATA", &Interpreter::skip_line},  {"DEF", &Interpreter::define},         {"ELSE", &Interpreter::skip_line},
        {"END", &Interpreter::end},         {"FNEND", &Interpreter::function_end}, {"FOR", &Interpreter::for_loop},
        {"GET", &Interpreter::get},         {"GOSUB", &Interpreter::go_sub},       {"GOTO", &Interpreter::go_to},
        {"IF", &Interpreter::if_then},      {"LET", &Interpreter::assign},         {"NEXT", &Interpreter::next},
        {"OUT", &Interpreter::out},         {"PRINT", &Interpreter::print},        {"READ", &Interpreter::read},
        {"RESTORE", &Interpreter::restore}, {"RETURN", &Interpreter::give_back},   {"STOP", &Interpreter::stop},
        {"WEND", &Interpreter::wend},       {"WHILE", &Interpreter::while_loop}};
    return table;
}

/// One statement; the cursor goes behind it, or where it leads.
void Interpreter::statement() {
    if (cursor_.here().kind == Kind::name) return assign();
    if (cursor_.take(Kind::symbol, ";")) return print();
    const auto row = statements().find(cursor_.here().text);
    if (cursor_.here().kind != Kind::keyword || row == statements().end())
        cursor_.wrong(cursor_.shown() + " stands where a statement is needed");
    ++cursor_.at;
    (this->*row->second)();
}

bool Interpreter::at_end_of_statement() const {
    return cursor_.here().kind == Kind::end_of_line || cursor_.is(Kind::symbol, ":") ||
           cursor_.is(Kind::keyword, "ELSE");
}

void Interpreter::skip_line() {
    while (cursor_.here().kind != Kind::end_of_line) ++cursor_.at;
}

std::size_t Interpreter::line_at(int number) const {
    const auto row = program_.lines.find(number);
    if (row == program_.lines.end()) cursor_.wrong("line " + std::to_string(number) + " does not exist");
    return row->second;
}

// ---- variables and functions

Value Interpreter::variable(const std::string& name) {
    const auto row = variables_.find(name);
    return row == variables_.end() ? Value{names_text(name), 0, {}} : row->second;
}

void Interpreter::store(const std::string& name, const Value& value) {
    if (names_text(name) != value.is_text)
        cursor_.wrong(name +
                      (value.is_text ? " is a number and was given a text" : " is a text and was given a number"));
    variables_[name] = value;
}

/// The name of a variable that is to be given a value.
std::string Interpreter::target() {
    if (cursor_.here().kind != Kind::name) cursor_.wrong(cursor_.shown() + " stands where a variable is needed");
    return program_.tokens[cursor_.at++].text;
}

/// Parameters are the function's own while it runs, and of all that it calls.
Value Interpreter::call(const std::string& function, const std::vector<Value>& arguments) {
    const auto row = program_.functions.find(function);
    if (row == program_.functions.end()) cursor_.wrong(function + " is not defined");
    const Function& made = row->second;
    if (arguments.size() != made.parameters.size())
        cursor_.wrong(function + " has " + std::to_string(made.parameters.size()) + " parameters and was given " +
                      std::to_string(arguments.size()));
    if (++depth_ > max_depth) cursor_.wrong("more than 64 functions wait for each other");
    std::vector<Value> outer;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        outer.push_back(variable(made.parameters[i]));
        store(made.parameters[i], arguments[i]);
    }
    const std::size_t back = cursor_.at;
    cursor_.at = made.body;
    Frame frame;
    frame.function = true;
    execute(frame);
    cursor_.at = back;
    for (std::size_t i = 0; i < arguments.size(); ++i) variables_[made.parameters[i]] = outer[i];
    --depth_;
    return frame.result;
}

int Interpreter::input(int port) {
    if (port < 0 || port > 255) cursor_.wrong("INP has the port " + std::to_string(port) + "; it must be 0 to 255");
    try {
        return machine_.in(static_cast<std::uint32_t>(port));
    } catch (const old_host::Failure& failure) {
        cursor_.wrong(failure.what());
    }
}

void Interpreter::out() {
    const int port = values_.number();
    cursor_.need(",");
    const int value = values_.number();
    if (port < 0 || port > 255) cursor_.wrong("OUT has the port " + std::to_string(port) + "; it must be 0 to 255");
    try {
        machine_.out(static_cast<std::uint32_t>(port), static_cast<std::uint8_t>(value & 0xFF));
    } catch (const old_host::Failure& failure) {
        cursor_.wrong(failure.what());
    }
}

// ---- statements

void Interpreter::assign() {
    const std::string name = target();
    cursor_.need("=");
    store(name, values_.value());
}

void Interpreter::print() {
    bool line_end = true;
    std::string text;
    while (!at_end_of_statement()) {
        line_end = !cursor_.take(Kind::symbol, ";");
        if (!line_end) continue;
        const Value value = values_.value();
        text += value.is_text ? value.text : std::to_string(value.number);
    }
    if (line_end) text += "\r\n";
    for (const char c : text) terminal_.put(static_cast<std::uint8_t>(c));
    if (!line_end) terminal_.end_text();
}

void Interpreter::if_then() {
    const bool holds = values_.number() != 0;
    cursor_.take(Kind::keyword, "THEN");
    if (!holds) {
        int inner = 0;
        for (; cursor_.here().kind != Kind::end_of_line; ++cursor_.at) {
            if (cursor_.is(Kind::keyword, "IF")) ++inner;
            if (cursor_.is(Kind::keyword, "ELSE") && inner-- == 0) break;
        }
        if (!cursor_.take(Kind::keyword, "ELSE")) return;
    }
    if (cursor_.here().kind == Kind::number) go_to();
}

void Interpreter::while_loop() {
    const std::size_t own = cursor_.at - 1;
    if (values_.number() == 0) cursor_.at = program_.partners.at(own) + 1;
}

void Interpreter::wend() {
    cursor_.at = program_.partners.at(cursor_.at - 1);
}

void Interpreter::for_loop() {
    const std::size_t own = cursor_.at - 1;
    const std::string name = target();
    cursor_.need("=");
    store(name, values_.value());
    if (!cursor_.take(Kind::keyword, "TO")) cursor_.wrong("FOR has no TO");
    Loop loop;
    loop.limit = values_.number();
    if (cursor_.take(Kind::keyword, "STEP")) loop.step = values_.number();
    frame_->loops[own] = loop;
    const int first = values_.checked(variable(name).number);
    if (loop.step >= 0 ? first <= loop.limit : first >= loop.limit) return;
    cursor_.at = program_.partners.at(own) + 1;  // NEXT and its variable
    if (cursor_.here().kind == Kind::name) ++cursor_.at;
}

void Interpreter::next() {
    const std::size_t begin = program_.partners.at(cursor_.at - 1);
    const std::string& name = program_.tokens[begin + 1].text;
    if (cursor_.here().kind == Kind::name && target() != name) cursor_.wrong("NEXT is not of the variable " + name);
    const auto loop = frame_->loops.find(begin);
    if (loop == frame_->loops.end()) cursor_.wrong("NEXT was reached without its FOR");
    const int value = values_.checked(static_cast<long long>(variable(name).number) + loop->second.step);
    store(name, {false, value, {}});
    if (loop->second.step >= 0 ? value > loop->second.limit : value < loop->second.limit) return;
    const std::size_t line = cursor_.at;
    cursor_.at = begin;
    while (!at_end_of_statement() && cursor_.at < line) ++cursor_.at;
}

void Interpreter::go_to() {
    if (cursor_.here().kind != Kind::number) cursor_.wrong(cursor_.shown() + " stands where a line number is needed");
    cursor_.at = line_at(cursor_.here().number);
}

void Interpreter::go_sub() {
    if (frame_->gosubs.size() >= max_depth) cursor_.wrong("more than 64 GOSUB wait for RETURN");
    frame_->gosubs.push_back(cursor_.at + 1);
    go_to();
}

void Interpreter::give_back() {
    if (!at_end_of_statement()) {
        if (!frame_->function) cursor_.wrong("RETURN gives a value outside a function");
        frame_->result = values_.value();
        frame_->returned = true;
        return;
    }
    if (frame_->gosubs.empty()) cursor_.wrong("RETURN has no GOSUB");
    cursor_.at = frame_->gosubs.back();
    frame_->gosubs.pop_back();
}

void Interpreter::read() {
    do {
        const std::string name = target();
        if (next_datum_ == program_.data.size()) cursor_.wrong("READ has found no more DATA");
        const Datum& datum = program_.data[next_datum_++];
        store(name, {datum.is_text, datum.is_text ? 0 : values_.checked(datum.number), datum.text});
    } while (cursor_.take(Kind::symbol, ","));
}

void Interpreter::restore() {
    int line = 0;
    if (!at_end_of_statement()) {
        line = values_.number();
        line_at(line);
    }
    next_datum_ = 0;
    while (next_datum_ < program_.data.size() && program_.data[next_datum_].line < line) ++next_datum_;
}

void Interpreter::get() {
    const std::string name = target();
    over_ = !terminal_.key();
    store(name, {true, 0, " "});
}

void Interpreter::define() {
    cursor_.at = program_.partners.at(cursor_.at - 1) + 1;
}

void Interpreter::function_end() {
    cursor_.wrong("FNEND was reached without RETURN");
}

void Interpreter::stop() {
    std::printf("STOP in line %d.\n", cursor_.here().line);
    over_ = stopped_ = true;
}

void Interpreter::end() {
    over_ = true;
}

}  // namespace basic
