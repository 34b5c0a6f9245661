#include "expression.hpp"

#include <cctype>

#include "terminal.hpp"

namespace asmz {

namespace {

/// One expression, from its first character to its last.
class Expression {
  public:
    Expression(std::string_view text, int here, const Lookup& lookup) : text_(text), here_(here), lookup_(lookup) {}

    int whole() {
        int value = sum();
        if (take(':')) value = ((value & 0xFF) << 8) | (sum() & 0xFF);
        if (at_ != text_.size()) wrong("'" + std::string(text_.substr(at_)) + "' is not expected");
        return value;
    }

  private:
    [[noreturn]] void wrong(const std::string& what) const {
        throw old_host::Failure(what + " in '" + std::string(text_) + "'");
    }

    bool take(char c) {
        if (at_ == text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }

    int checked(long long value) const {
        if (value < -65536 || value > 65535) wrong("a value is outside -65536 to 65535");
        return static_cast<int>(value);
    }

    int sum() {
        int value = product();
        for (;;) {
            if (take('+'))
                value = checked(value + product());
            else if (take('-'))
                value = checked(value - product());
            else
                return value;
        }
    }

    int product() {
        int value = term();
        while (take('*')) value = checked(static_cast<long long>(value) * term());
        return value;
    }

    int term() {
        if (take('*')) return here_;
        if (take('-')) return -term();
        if (at_ == text_.size()) wrong("a number is missing");
        if (text_[at_] == '\'') {
            if (at_ + 2 >= text_.size() || text_[at_ + 2] != '\'') wrong("a character needs two quotes");
            at_ += 3;
            return static_cast<unsigned char>(text_[at_ - 2]);
        }
        const std::size_t begin = at_;
        while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '.'))
            ++at_;
        const std::string word(text_.substr(begin, at_ - begin));
        if (word.empty()) wrong("a number or a symbol is missing");
        return std::isdigit(static_cast<unsigned char>(word[0])) != 0 ? number(word) : lookup_(word);
    }

    int number(std::string word) const {
        const int base = word.back() == 'H' ? 16 : word.back() == 'Q' ? 8 : 10;
        if (base != 10) word.pop_back();
        long long value = 0;
        for (const char c : word) {
            const int digit = c <= '9' ? c - '0' : c - 'A' + 10;
            if (digit < 0 || digit >= base) wrong("'" + word + "' is not a number");
            value = checked(value * base + digit);
        }
        return static_cast<int>(value);
    }

    std::string_view text_;
    int here_;
    const Lookup& lookup_;
    std::size_t at_ = 0;
};

}  // namespace

int value_of(std::string_view text, int here, const Lookup& lookup) {
    return Expression(text, here, lookup).whole();
}

}  // namespace asmz
