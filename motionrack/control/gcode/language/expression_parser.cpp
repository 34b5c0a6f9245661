// Operators by precedence, from left to right; brackets and functions by recursion of limited depth.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <motionrack/base/exponential.hpp>
#include <motionrack/base/power.hpp>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/gcode/language/expression_parser.hpp>
#include <motionrack/control/gcode/number.hpp>

namespace motionrack::control::gcode {

enum class ExpressionParser::Operator : unsigned char {
    none,
    power,
    times,
    over,
    modulo,
    plus,
    minus,
    equal,
    unequal,
    greater,
    not_less,
    less,
    not_greater,
    both,
    any,
    one
};

namespace {

/// Maximum nesting of brackets.
constexpr int max_nesting = 100;
/// Numbers with a smaller difference are equal for EQ and NE, and integers for a parameter number.
constexpr double same = 0.0001;

constexpr double degrees = 180 / pi;

/// Precedence of the operators in the order of the enumeration; 0 is the weakest.
constexpr std::array<int, 16> strength = {-1, 4, 3, 3, 3, 2, 2, 1, 1, 1, 1, 1, 1, 0, 0, 0};

/// Returns true if `word` is at `at`, in either case.
bool matches(const char* at, const char* end, std::string_view word) {
    if (static_cast<std::size_t>(end - at) < word.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i)
        if (to_lower(at[i]) != word[i]) return false;
    return true;
}

enum class Function { abs, acos, asin, atan, cos, exists, exp, fix, fup, ln, round, sin, sqrt, tan, none };
constexpr std::array<std::string_view, 14> function_names = {"abs", "acos", "asin", "atan",  "cos", "exists", "exp",
                                                             "fix", "fup",  "ln",   "round", "sin", "sqrt",   "tan"};

/// Returns the function whose name is at `at`, followed by a bracket.
Function function_at(const char* at, const char* end, const char*& bracket) {
    for (std::size_t i = 0; i < function_names.size(); ++i) {
        if (!matches(at, end, function_names[i])) continue;
        const char* p = at + function_names[i].size();
        while (p < end && is_blank(*p)) ++p;
        if (p == end || *p != '[') continue;
        bracket = p;
        return static_cast<Function>(i);
    }
    return Function::none;
}

double calculate(Function function, double x) {
    switch (function) {
        case Function::abs:
            return std::fabs(x);
        case Function::acos:
            return acos(x) * degrees;
        case Function::asin:
            return asin(x) * degrees;
        case Function::cos:
            return sin_cos(x / degrees).cos;
        case Function::exp:
            return exponential(x);
        case Function::fix:
            return std::floor(x);
        case Function::fup:
            return std::ceil(x);
        case Function::ln:
            return natural_log(x);
        case Function::round:
            return std::copysign(std::floor(std::fabs(x) + 0.5), x);
        case Function::sin:
            return sin_cos(x / degrees).sin;
        case Function::sqrt:
            return std::sqrt(x);
        default:
            return tan(x / degrees);
    }
}

/// Returns the required domain of `x` for the function.
const char* domain_of(Function function) {
    switch (function) {
        case Function::acos:
        case Function::asin:
            return "a number from -1 to 1";
        case Function::ln:
            return "a number above 0";
        case Function::sqrt:
            return "0 or more";
        case Function::exp:
            return "700 at most";
        default:
            return "an angle that has one, below 1e9 degrees";
    }
}

}  // namespace

void ExpressionParser::skip(const char*& at) const {
    while (at < end_ && is_blank(*at)) ++at;
}

bool ExpressionParser::fail(const char* at, std::string message) {
    fault_at_ = static_cast<std::size_t>(at - text_.data());
    fault_ = std::move(message);
    return false;
}

bool ExpressionParser::finite(const char* at, double value) {
    if (std::isfinite(value)) return true;
    return fail(at, "the result is out of range; check the values in it");
}

bool ExpressionParser::begins(const char* at) const {
    skip(at);
    while (at < end_ && (*at == '-' || *at == '+')) {
        ++at;
        skip(at);
    }
    if (at == end_) return false;
    const char* bracket = at;
    return *at == '#' || *at == '[' || function_at(at, end_, bracket) != Function::none;
}

bool ExpressionParser::value(const char*& at, double& value) {
    skip(at);
    if (at == end_) return fail(at, "a value is missing here: a number, #1, #<name> or [ ]");
    const char* begin = at;
    const char* bracket_at = at;
    if (++depth_ > max_nesting) return fail(at, fmt::format("more than {} nested brackets, signs or '#'", max_nesting));
    bool good = false;
    if (*at == '[') {
        good = bracket(at, value);
    } else if (*at == '#') {
        ParameterName name;
        good = parameter(at, name);
        if (good && name.number > 0) {
            value = source_.numbered(name.number);
        } else if (good) {
            const auto known = source_.named(name.name);
            if (!known)
                return fail(
                    begin, fmt::format("#<{}> has no value yet; set it before, e.g. #<{}> = 1 (EXISTS[#<{}>] tests it)",
                                       name.name, name.name, name.name));
            value = *known;
        }
    } else if (function_at(at, end_, bracket_at) != Function::none) {
        good = unary(at, value);
    } else if ((*at == '-' || *at == '+') && begins(at)) {
        const bool negative = *at == '-';
        ++at;
        good = this->value(at, value);
        if (negative) value = -value;
    } else {
        const Number number = scan_number(at, end_);
        value = number.value;
        good = number.fault == NumberFault::none;
        if (!good)
            return fail(begin, number.fault == NumberFault::too_large
                                   ? "this number is too large; the largest is 1000000000"
                               : number.fault == NumberFault::two_points
                                   ? "this number has two decimal points"
                                   : "expected a value: a number, #1, #<name>, a function or [ ]");
    }
    --depth_;
    skip(at);
    return good && finite(begin, value);
}

bool ExpressionParser::bracket(const char*& at, double& value) {
    const char* open = at++;
    if (!operation(at, 0, value)) return false;
    if (at < end_ && *at == ']') {
        ++at;
        return true;
    }
    if (at == end_) return fail(open, "this bracket is not closed: ']' is missing");
    return fail(at, "an operator or ']' is expected here; operators are ** * / MOD + - EQ NE GT GE LT LE AND OR XOR");
}

ExpressionParser::Operator ExpressionParser::operator_at(const char* at, const char*& after) const {
    struct Sign {
        std::string_view text;
        Operator what;
    };
    static constexpr Sign signs[] = {
        {"**", Operator::power},   {"*", Operator::times},     {"/", Operator::over},   {"+", Operator::plus},
        {"-", Operator::minus},    {"mod", Operator::modulo},  {"eq", Operator::equal}, {"ne", Operator::unequal},
        {"gt", Operator::greater}, {"ge", Operator::not_less}, {"lt", Operator::less},  {"le", Operator::not_greater},
        {"and", Operator::both},   {"or", Operator::any},      {"xor", Operator::one}};
    for (const Sign& sign : signs) {
        if (!matches(at, end_, sign.text)) continue;
        after = at + sign.text.size();
        return sign.what;
    }
    return Operator::none;
}

/// Parses a value and all following operators that are not weaker than `weakest`.
bool ExpressionParser::operation(const char*& at, int weakest, double& value) {
    if (!this->value(at, value)) return false;
    for (;;) {
        const char* after = at;
        const Operator what = operator_at(at, after);
        const int strong = strength[static_cast<std::size_t>(what)];
        if (what == Operator::none || strong < weakest) return true;
        const char* sign = at;
        at = after;
        double right = 0;
        if (!operation(at, strong + 1, right) || !apply(sign, what, value, right)) return false;
    }
}

bool ExpressionParser::apply(const char* at, Operator what, double& left, double right) {
    switch (what) {
        case Operator::power:
            if (left < 0 && right != std::floor(right))
                return fail(at, fmt::format("{:.6g} ** {:.6g}: a negative number has only whole powers", left, right));
            if (left == 0 && right < 0) return fail(at, fmt::format("0 ** {:.6g} is a division by zero", right));
            left = power(left, right);
            break;
        case Operator::times:
            left *= right;
            break;
        case Operator::over:
            if (right == 0) return fail(at, "division by zero");
            left /= right;
            break;
        case Operator::modulo:
            if (right == 0) return fail(at, "MOD by zero");
            left = std::fmod(left, right);
            if (left < 0) left += std::fabs(right);
            break;
        case Operator::plus:
            left += right;
            break;
        case Operator::minus:
            left -= right;
            break;
        case Operator::equal:
            left = std::fabs(left - right) < same;
            break;
        case Operator::unequal:
            left = std::fabs(left - right) >= same;
            break;
        case Operator::greater:
            left = left > right;
            break;
        case Operator::not_less:
            left = left >= right;
            break;
        case Operator::less:
            left = left < right;
            break;
        case Operator::not_greater:
            left = left <= right;
            break;
        case Operator::both:
            left = left != 0 && right != 0;
            break;
        case Operator::any:
            left = left != 0 || right != 0;
            break;
        case Operator::one:
            left = (left != 0) != (right != 0);
            break;
        case Operator::none:
            break;
    }
    return finite(at, left);
}

bool ExpressionParser::unary(const char*& at, double& value) {
    const char* begin = at;
    const char* open = at;
    const Function function = function_at(at, end_, open);
    at = open;
    if (function == Function::exists) return exists(at, value);
    double x = 0;
    if (!bracket(at, x)) return false;
    if (function == Function::atan) return arc_tangent(at, x, value);
    value = calculate(function, x);
    if (std::isfinite(value)) return true;
    return fail(begin, fmt::format("{} of {:.6g} has no value; it needs {}",
                                   std::string_view(begin, function_names[static_cast<std::size_t>(function)].size()),
                                   x, domain_of(function)));
}

bool ExpressionParser::arc_tangent(const char*& at, double over, double& value) {
    skip(at);
    if (at == end_ || *at != '/')
        return fail(at, "ATAN needs two sides of a triangle: '/' and a second bracket are missing, e.g. ATAN[1]/[2]");
    ++at;
    skip(at);
    if (at == end_ || *at != '[')
        return fail(at, "ATAN needs two sides of a triangle: the second bracket is missing, e.g. ATAN[1]/[2]");
    double under = 0;
    if (!bracket(at, under)) return false;
    value = atan2(over, under) * degrees;
    return true;
}

bool ExpressionParser::exists(const char*& at, double& value) {
    const char* open = at++;
    skip(at);
    if (at == end_ || *at != '#') return fail(at, "EXISTS needs a parameter, e.g. EXISTS[#<depth>]");
    ParameterName name;
    if (!parameter(at, name)) return false;
    value = name.number > 0 || source_.named(name.name).has_value();
    if (at == end_) return fail(open, "this bracket is not closed: ']' is missing");
    if (*at != ']') return fail(at, "EXISTS takes one parameter and nothing else");
    ++at;
    return true;
}

bool ExpressionParser::parameter(const char*& at, ParameterName& name) {
    const char* begin = at++;
    skip(at);
    if (at < end_ && *at == '<') {
        for (++at; at < end_ && *at != '>'; ++at) {
            if (is_blank(*at)) continue;
            if (*at < '!' || *at > '~' || *at == '<' || *at == '#' || *at == '(' || *at == ';')
                return fail(at, "a parameter's name ends with '>'; it has letters, digits and '_'");
            name.name += to_lower(*at);
        }
        if (at == end_) return fail(begin, "this name is not closed: '>' is missing");
        ++at;
        skip(at);
        if (name.name.empty() || name.name.size() > max_name_length)
            return fail(begin, fmt::format("a parameter's name has 1 to {} characters", max_name_length));
        return true;
    }
    double number = 0;
    if (!value(at, number)) return false;
    const double whole = std::floor(number + 0.5);
    if (std::fabs(number - whole) > same || whole < 1 || whole > last_parameter)
        return fail(begin, fmt::format("unknown parameter #{:.6g}; parameters are #1 to #{}", number, last_parameter));
    name.number = static_cast<int>(whole);
    return true;
}

}  // namespace motionrack::control::gcode
