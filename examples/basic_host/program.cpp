#include "program.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "../z80_host/terminal.hpp"

namespace basic {

namespace {

constexpr std::array<std::string_view, 32> keywords = {
    "AND",     "ASCII",  "CHR$",   "CUR",  "DATA", "DEF",   "ELSE", "END", "FNEND", "FOR",   "GET",
    "GOSUB",   "GOTO",   "IF",     "INP",  "LET",  "NEXT",  "NOT",  "OR",  "OUT",   "PRINT", "READ",
    "RESTORE", "RETURN", "SPACE$", "STEP", "STOP", "SWAP%", "THEN", "TO",  "WEND",  "WHILE",
};

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

std::string capitals(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

// ---- words

/// Cuts lines into tokens.
class Reader {
  public:
    Reader(Program& out, const std::string& text) : out_(out), text_(text) {}

    void read() {
        while (at_ < text_.size()) line();
        add(Kind::end, {});
    }

  private:
    char here() const { return at_ < text_.size() ? text_[at_] : '\n'; }
    [[noreturn]] void wrong(const std::string& what) const {
        fail(out_.name, number_, what + ". Nothing was run. Correct the line.");
    }
    void add(Kind kind, std::string text, int number = 0) {
        out_.tokens.push_back({kind, std::move(text), number, number_});
    }

    int integer() {
        long long value = 0;
        while (is_digit(here())) {
            value = value * 10 + (text_[at_++] - '0');
            if (value > 65535) wrong("a number is greater than 65535");
        }
        return static_cast<int>(value);
    }

    void line() {
        while (here() == ' ' || here() == '\r') ++at_;
        if (here() == '\n') {
            ++at_;
            return;
        }
        if (!is_digit(here())) wrong("the line behind it has no number");
        const int number = integer();
        if (number <= number_) wrong("line " + std::to_string(number) + " follows, which is not greater");
        number_ = number;
        out_.lines[number] = out_.tokens.size();
        while (here() != '\n' && here() != '!') token();
        while (here() != '\n') ++at_;
        ++at_;
        add(Kind::end_of_line, {});
    }

    void token() {
        const char c = here();
        if (c == ' ' || c == '\r')
            ++at_;
        else if (is_digit(c))
            add(Kind::number, {}, integer());
        else if (is_letter(c))
            word();
        else if (c == '"')
            quoted();
        else
            symbol();
    }

    void word() {
        const std::size_t begin = at_;
        while (is_letter(here()) || is_digit(here())) ++at_;
        if (here() == '$' || here() == '%') ++at_;
        const std::string word = text_.substr(begin, at_ - begin);
        const bool own = std::find(keywords.begin(), keywords.end(), word) != keywords.end();
        if (own)
            add(Kind::keyword, word);
        else
            add(word.size() > 2 && word.compare(0, 2, "FN") == 0 ? Kind::function : Kind::name, capitals(word));
    }

    void quoted() {
        const std::size_t end = std::min(text_.find('"', at_ + 1), text_.find('\n', at_));
        if (end == std::string::npos || text_[end] != '"') wrong("a text has no second quote");
        add(Kind::text, text_.substr(at_ + 1, end - at_ - 1));
        at_ = end + 1;
    }

    void symbol() {
        const std::string two = text_.substr(at_, 2);
        if (two == "<>" || two == "<=" || two == ">=") {
            add(Kind::symbol, two);
            at_ += 2;
            return;
        }
        if (std::string_view("+-*/=<>(),;:").find(here()) == std::string_view::npos)
            wrong(std::string("the character '") + here() + "' is not understood");
        add(Kind::symbol, std::string(1, text_[at_++]));
    }

    Program& out_;
    const std::string& text_;
    std::size_t at_ = 0;
    int number_ = 0;
};

// ---- functions, data and ends of loops

/// Finds functions, the ends of loops, and data.
class Pairs {
  public:
    explicit Pairs(Program& out) : out_(out) {}

    void find() {
        for (std::size_t at = 0; at < out_.tokens.size(); ++at) {
            const Token& token = out_.tokens[at];
            if (token.kind != Kind::keyword) continue;
            if (token.text == "WHILE" || token.text == "FOR") open_.push_back(at);
            if (token.text == "WEND") close(at, "WHILE");
            if (token.text == "NEXT") close(at, "FOR");
            if (token.text == "DEF") define(at);
            if (token.text == "FNEND") end_function(at);
            if (token.text == "DATA") data(at);
        }
        if (!open_.empty()) unclosed(open_.back());
    }

  private:
    [[noreturn]] void wrong(std::size_t at, const std::string& what) const {
        fail(out_.name, out_.tokens[at].line, what + ". Nothing was run. Correct the program.");
    }
    [[noreturn]] void unclosed(std::size_t at) const {
        const std::string& word = out_.tokens[at].text;
        wrong(at, word + " has no " + (word == "FOR" ? "NEXT" : word == "DEF" ? "FNEND" : "WEND"));
    }
    bool is(std::size_t at, std::string_view symbol) const {
        return out_.tokens[at].kind == Kind::symbol && out_.tokens[at].text == symbol;
    }

    void close(std::size_t at, const std::string& opener) {
        if (open_.empty() || out_.tokens[open_.back()].text != opener)
            wrong(at, out_.tokens[at].text + " has no " + opener);
        out_.partners[at] = open_.back();
        out_.partners[open_.back()] = at;
        open_.pop_back();
    }

    void define(std::size_t at) {
        if (!open_.empty()) wrong(at, "DEF stands inside " + out_.tokens[open_.back()].text);
        open_.push_back(at);
        function_ = out_.tokens[at + 1].text;
        if (out_.tokens[at + 1].kind != Kind::function) wrong(at, "DEF has no name that begins with FN");
        if (out_.functions.count(function_) != 0) wrong(at, function_ + " is defined twice");
        Function& made = out_.functions[function_];
        made.body = at + 2;
        if (!is(made.body, "(")) return;
        do {
            ++made.body;
            if (out_.tokens[made.body].kind != Kind::name) wrong(at, "a parameter of " + function_ + " is not a name");
            made.parameters.push_back(out_.tokens[made.body++].text);
        } while (is(made.body, ","));
        if (!is(made.body, ")")) wrong(at, "the parameters of " + function_ + " have no ')'");
        ++made.body;
    }

    void end_function(std::size_t at) {
        if (open_.empty()) wrong(at, "FNEND has no DEF");
        if (out_.tokens[open_.back()].text != "DEF") unclosed(open_.back());
        out_.partners[open_.back()] = at;
        open_.pop_back();
        out_.functions[function_].end = at;
    }

    void data(std::size_t at) {
        do {
            ++at;
            Datum datum{out_.tokens[at].line, false, 0, {}};
            const bool negative = is(at, "-");
            if (negative) ++at;
            const Token& token = out_.tokens[at];
            if (token.kind != Kind::number && (token.kind != Kind::text || negative))
                wrong(at, "DATA has something that is neither a number nor a text");
            datum.is_text = token.kind == Kind::text;
            datum.number = negative ? -token.number : token.number;
            datum.text = token.text;
            out_.data.push_back(datum);
            ++at;
        } while (is(at, ","));
    }

    Program& out_;
    std::vector<std::size_t> open_;
    std::string function_;
};

}  // namespace

void fail(const std::string& name, int line, const std::string& what) {
    throw old_host::Failure(name + ": line " + std::to_string(line) + ": " + what);
}

Program read(const std::string& name, const std::string& text) {
    Program out;
    out.name = name;
    Reader(out, text).read();
    Pairs(out).find();
    return out;
}

}  // namespace basic
