#include "expressions.hpp"

#include <utility>

namespace basic {

std::string Cursor::shown() const {
    switch (here().kind) {
        case Kind::number:
            return "the number " + std::to_string(here().number);
        case Kind::text:
            return "the text \"" + here().text + "\"";
        case Kind::end_of_line:
        case Kind::end:
            return "the end of the line";
        default:
            return "'" + here().text + "'";
    }
}

int Expressions::checked(long long number) const {
    if (number < -32768 || number > 32767)
        cursor_.wrong("the number " + std::to_string(number) + " is outside -32768 to 32767");
    return static_cast<int>(number);
}

int Expressions::number_of(const Value& value) const {
    if (value.is_text) cursor_.wrong("the text \"" + value.text + "\" stands where a number is needed");
    return value.number;
}

std::string Expressions::text_of(const Value& value) const {
    if (!value.is_text) cursor_.wrong("the number " + std::to_string(value.number) + " stands where a text is needed");
    return value.text;
}

int Expressions::character(int code) const {
    if (code < 0 || code > 255) cursor_.wrong("the code " + std::to_string(code) + " is outside 0 to 255");
    return code;
}

// ---- from the weakest operator to the strongest

Value Expressions::value() {
    if (++depth_ > max_depth) cursor_.wrong("more than " + std::to_string(max_depth) + " brackets are open");
    Value left = conjunction();
    while (cursor_.take(Kind::keyword, "OR")) left = of(number_of(left) | number_of(conjunction()));
    --depth_;
    return left;
}

Value Expressions::conjunction() {
    Value left = negation();
    while (cursor_.take(Kind::keyword, "AND")) left = of(number_of(left) & number_of(negation()));
    return left;
}

Value Expressions::negation() {
    bool negated = false;
    while (cursor_.take(Kind::keyword, "NOT")) negated = !negated;
    const Value value = comparison();
    return negated ? of(~number_of(value)) : value;
}

Value Expressions::comparison() {
    const Value left = sum();
    if (cursor_.here().kind != Kind::symbol) return left;
    for (const char* each : {"=", "<>", "<=", ">=", "<", ">"})
        if (cursor_.take(Kind::symbol, each)) return compared(each, left, sum());
    return left;
}

Value Expressions::compared(const std::string& with, const Value& left, const Value& right) const {
    if (left.is_text != right.is_text) cursor_.wrong("a text is compared with a number");
    const int order = left.is_text ? left.text.compare(right.text) : left.number - right.number;
    const bool found = (order < 0 && with.find('<') != std::string::npos) ||
                       (order > 0 && with.find('>') != std::string::npos) ||
                       (order == 0 && with.find('=') != std::string::npos);
    return of(found ? -1 : 0);
}

Value Expressions::sum() {
    Value left = product();
    for (;;) {
        if (cursor_.take(Kind::symbol, "-")) {
            left = of(number_of(left) - number_of(product()));
        } else if (cursor_.take(Kind::symbol, "+")) {
            const Value right = product();
            left = left.is_text ? Value{true, 0, left.text + text_of(right)} : of(number_of(left) + number_of(right));
        } else {
            return left;
        }
    }
}

Value Expressions::product() {
    Value left = sign();
    for (;;) {
        if (cursor_.take(Kind::symbol, "*")) {
            left = of(static_cast<long long>(number_of(left)) * number_of(sign()));
        } else if (cursor_.take(Kind::symbol, "/")) {
            const int divisor = number_of(sign());
            if (divisor == 0) cursor_.wrong("a number is divided by 0");
            left = of(number_of(left) / divisor);
        } else {
            return left;
        }
    }
}

Value Expressions::sign() {
    bool negative = false;
    for (;;) {
        if (cursor_.take(Kind::symbol, "-"))
            negative = !negative;
        else if (!cursor_.take(Kind::symbol, "+"))
            break;
    }
    const Value value = primary();
    return negative ? of(-static_cast<long long>(number_of(value))) : value;
}

Value Expressions::primary() {
    const Token& token = cursor_.here();
    switch (token.kind) {
        case Kind::number:
            ++cursor_.at;
            return of(token.number);
        case Kind::text:
            ++cursor_.at;
            return {true, 0, token.text};
        case Kind::name:
            ++cursor_.at;
            return context_.variable(token.text);
        case Kind::function:
            return function();
        case Kind::keyword:
            return built_in(token.text);
        default:
            break;
    }
    if (!cursor_.take(Kind::symbol, "(")) cursor_.wrong(cursor_.shown() + " stands where a value is needed");
    const Value inside = value();
    cursor_.need(")");
    return inside;
}

// ---- functions

Value Expressions::function() {
    const std::string name = cursor_.here().text;
    ++cursor_.at;
    std::vector<Value> arguments;
    if (cursor_.take(Kind::symbol, "(")) {
        do arguments.push_back(value());
        while (cursor_.take(Kind::symbol, ","));
        cursor_.need(")");
    }
    const int outer = std::exchange(depth_, 0);
    Value result = context_.call(name, arguments);
    depth_ = outer;
    return result;
}

Value Expressions::built_in(const std::string& name) {
    if (name != "INP" && name != "CUR" && name != "SPACE$" && name != "CHR$" && name != "ASCII" && name != "SWAP%")
        cursor_.wrong("'" + name + "' stands where a value is needed");
    ++cursor_.at;
    cursor_.need("(");
    const Value first = value();
    Value out;
    if (name == "INP") {
        out = of(context_.input(number_of(first)));
    } else if (name == "CUR") {
        cursor_.need(",");
        const int column = number();
        out = {true, 0, "\x1b="};
        for (const int place : {number_of(first), column}) out.text += static_cast<char>(character(place + 32));
    } else if (name == "SPACE$") {
        out = {true, 0, std::string(static_cast<std::size_t>(character(number_of(first))), ' ')};
    } else if (name == "CHR$") {
        out = {true, 0, std::string(1, static_cast<char>(character(number_of(first))))};
    } else if (name == "ASCII") {
        if (text_of(first).empty()) cursor_.wrong("ASCII has an empty text");
        out = of(static_cast<unsigned char>(first.text[0]));
    } else {
        const auto bits = static_cast<unsigned>(number_of(first)) & 0xFFFFU;
        const unsigned swapped = ((bits & 0xFFU) << 8U) | (bits >> 8U);
        out = of(swapped > 32767 ? static_cast<int>(swapped) - 65536 : static_cast<int>(swapped));
    }
    cursor_.need(")");
    return out;
}

}  // namespace basic
