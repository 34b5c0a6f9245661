// Parses SVG path data and transforms.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/mark/svg.hpp>
#include <optional>
#include <vector>

namespace motionrack::mark {

namespace {

tl::unexpected<DataError> wrong(std::size_t at, std::string message) {
    return tl::unexpected<DataError>(DataError{at, std::move(message)});
}
bool blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}
bool digit(char c) {
    return c >= '0' && c <= '9';
}
char shown(char c) {
    return c >= ' ' && c < 127 ? c : '?';
}

/// Returns the number of parameters of a command; -1: unknown command.
int numbers_of(char upper) {
    switch (upper) {
        case 'M':
        case 'L':
        case 'T':
            return 2;
        case 'H':
        case 'V':
            return 1;
        case 'C':
            return 6;
        case 'S':
        case 'Q':
            return 4;
        case 'A':
            return 7;
        case 'Z':
            return 0;
        default:
            return -1;
    }
}

struct PathState {
    Spot control;     ///< control point of the last curve
    char last = 'M';  ///< last command, upper case
};

Spot mirrored(Spot at, Spot control) {
    return {2 * at.x - control.x, 2 * at.y - control.y};
}

/// Draws an SVG arc: converts its end points to the centre as in the SVG implementation notes.
void arc(Pen& pen, double rx, double ry, double turn_deg, bool large, bool sweep_positive, Spot to) {
    const Spot from = pen.at();
    rx = std::fabs(rx), ry = std::fabs(ry);
    if (from.x == to.x && from.y == to.y) return;
    if (rx == 0 || ry == 0) return pen.line_to(to);
    const double turn = turn_deg * (pi / 180);
    const SinCos t = sin_cos(turn);
    const double hx = (from.x - to.x) / 2, hy = (from.y - to.y) / 2;
    const double u = t.cos * hx + t.sin * hy, v = t.cos * hy - t.sin * hx;
    const double need = (u / rx) * (u / rx) + (v / ry) * (v / ry);
    if (need > 1) rx *= std::sqrt(need), ry *= std::sqrt(need);
    double q = std::sqrt(std::max(0.0, 1 / std::min(need, 1.0) - 1));
    if (need > 1) q = 0;
    if (large == sweep_positive) q = -q;
    const double cu = q * rx * v / ry, cv = -q * ry * u / rx;
    const Spot centre{t.cos * cu - t.sin * cv + (from.x + to.x) / 2, t.sin * cu + t.cos * cv + (from.y + to.y) / 2};
    const double begin = atan2((v - cv) / ry, (u - cu) / rx), end = atan2((-v - cv) / ry, (-u - cu) / rx);
    double sweep = end - begin;
    if (sweep_positive && sweep < 0) sweep += 2 * pi;
    if (!sweep_positive && sweep > 0) sweep -= 2 * pi;
    pen.ellipse_to(centre, rx, ry, turn, begin, sweep, to);
}

void draw(Pen& pen, PathState& s, char upper, bool relative, const std::array<double, 7>& n) {
    const Spot at = pen.at(), base = relative ? at : Spot{};
    const auto point = [&](std::size_t i) { return Spot{base.x + n[i], base.y + n[i + 1]}; };
    Spot control = at;
    switch (upper) {
        case 'M':
            pen.move_to(point(0));
            control = pen.at();
            break;
        case 'L':
            pen.line_to(point(0));
            break;
        case 'H':
            pen.line_to({base.x + n[0], at.y});
            break;
        case 'V':
            pen.line_to({at.x, base.y + n[0]});
            break;
        case 'C':
            control = point(2);
            pen.cubic_to(point(0), control, point(4));
            break;
        case 'S':
            control = point(0);
            pen.cubic_to(s.last == 'C' || s.last == 'S' ? mirrored(at, s.control) : at, control, point(2));
            break;
        case 'Q':
            control = point(0);
            pen.quadratic_to(control, point(2));
            break;
        case 'T':
            control = s.last == 'Q' || s.last == 'T' ? mirrored(at, s.control) : at;
            pen.quadratic_to(control, point(0));
            break;
        case 'A':
            arc(pen, n[0], n[1], n[2], n[3] != 0, n[4] != 0, point(5));
            break;
        default:
            pen.close();
            break;
    }
    s.control = control;
    s.last = upper;
}

}  // namespace

void Scan::skip() {
    bool comma = false;
    while (!done() && (blank(text_[at_]) || (text_[at_] == ',' && !comma))) comma |= text_[at_++] == ',';
}

bool Scan::number_next() const {
    std::size_t i = at_;
    if (i < text_.size() && (text_[i] == '+' || text_[i] == '-')) ++i;
    if (i < text_.size() && text_[i] == '.') ++i;
    return i < text_.size() && digit(text_[i]);
}

tl::expected<double, DataError> Scan::number() {
    if (!number_next())
        return wrong(
            at_, done() ? "a number is missing at the end" : fmt::format("expected a number, not '{}'", shown(peek())));
    const std::size_t begin = at_;
    if (text_[at_] == '+') ++at_;
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    at_ = static_cast<std::size_t>(end - text_.data());
    if (error != std::errc{} || !(std::fabs(value) <= 1e9)) return wrong(begin, "a number is beyond 1e9");
    return value;
}

tl::expected<bool, DataError> Scan::arc_flag() {
    if (peek() != '0' && peek() != '1') return wrong(at_, "expected a flag of an arc, 0 or 1");
    return take() == '1';
}

tl::expected<void, DataError> draw_path(std::string_view data, Pen& pen) {
    Scan scan(data);
    PathState state;
    char command = '\0';
    bool begun = false;
    for (scan.skip(); !scan.done(); scan.skip()) {
        const std::size_t at = scan.at();
        const bool again = scan.number_next();
        if (!again) {
            command = scan.take();
        } else if (command == 'M' || command == 'm') {
            command = command == 'M' ? 'L' : 'l';
        }
        const char upper = static_cast<char>(command >= 'a' && command <= 'z' ? command - 32 : command);
        const int count = numbers_of(upper);
        if (count < 0 || (again && count == 0))
            return wrong(
                at, again ? "a number without a command" : fmt::format("'{}' is not a path command", shown(command)));
        if (!begun && upper != 'M') return wrong(at, "a path must begin with M or m");
        begun = true;
        std::array<double, 7> numbers{};
        for (int i = 0; i < count; ++i) {
            scan.skip();
            if (upper == 'A' && (i == 3 || i == 4)) {
                const auto flag = scan.arc_flag();
                if (!flag) return tl::unexpected(flag.error());
                numbers[static_cast<std::size_t>(i)] = *flag ? 1 : 0;
                continue;
            }
            const auto number = scan.number();
            if (!number) return tl::unexpected(number.error());
            numbers[static_cast<std::size_t>(i)] = *number;
        }
        draw(pen, state, upper, upper != command, numbers);
    }
    return {};
}

namespace {

/// Returns the transform of that name; empty if the parameter count is wrong.
std::optional<Affine> transform_of(std::string_view name, const std::vector<double>& n) {
    const std::size_t k = n.size();
    const auto tangent = [](double degrees) {
        const SinCos s = sin_cos(degrees * (pi / 180));
        return s.sin / s.cos;
    };
    if (name == "matrix" && k == 6) return Affine{n[0], n[1], n[2], n[3], n[4], n[5]};
    if (name == "translate" && (k == 1 || k == 2)) return Affine{1, 0, 0, 1, n[0], k == 2 ? n[1] : 0};
    if (name == "scale" && (k == 1 || k == 2)) return Affine{n[0], 0, 0, k == 2 ? n[1] : n[0], 0, 0};
    if (name == "skewX" && k == 1) return Affine{1, 0, tangent(n[0]), 1, 0, 0};
    if (name == "skewY" && k == 1) return Affine{1, tangent(n[0]), 0, 1, 0, 0};
    if (name == "rotate" && (k == 1 || k == 3)) {
        const SinCos t = sin_cos(n[0] * (pi / 180));
        const Affine turn{t.cos, t.sin, -t.sin, t.cos, 0, 0};
        if (k == 1) return turn;
        return Affine{1, 0, 0, 1, n[1], n[2]}.after(turn).after({1, 0, 0, 1, -n[1], -n[2]});
    }
    return std::nullopt;
}

}  // namespace

tl::expected<Affine, DataError> read_transform(std::string_view data) {
    Scan scan(data);
    Affine out;
    for (scan.skip(); !scan.done(); scan.skip()) {
        const std::size_t begin = scan.at();
        while (!scan.done() && scan.peek() != '(' && !blank(scan.peek())) scan.take();
        const std::string_view name = data.substr(begin, scan.at() - begin);
        scan.skip();
        if (scan.peek() != '(') return wrong(scan.at(), "a '(' is missing in the transform");
        scan.take();
        std::vector<double> numbers;
        for (scan.skip(); !scan.done() && scan.peek() != ')'; scan.skip()) {
            const auto number = scan.number();
            if (!number) return tl::unexpected(number.error());
            numbers.push_back(*number);
            if (numbers.size() > 6) return wrong(begin, "a transform with more than six numbers");
        }
        if (scan.done()) return wrong(scan.at(), "a ')' is missing in the transform");
        scan.take();
        const auto one = transform_of(name, numbers);
        if (!one)
            return wrong(begin,
                         "the transforms are matrix (6 numbers), translate and scale (1 or 2), rotate (1 or 3), "
                         "skewX and skewY (1)");
        out = out.after(*one);
    }
    return out;
}

}  // namespace motionrack::mark
