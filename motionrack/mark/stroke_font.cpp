// Stroke font: letters on a grid 4 wide and 6 high (lower case 4), pitch 6, line spacing 10.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <motionrack/mark/stroke_font.hpp>

namespace motionrack::mark {

namespace {

/// A letter: its strokes as pairs x y, separated by blanks; `a` and `b` stand for y = -1 and y = -2.
struct Glyph {
    char letter;
    std::string_view strokes;
};

constexpr Glyph glyphs[] = {
    {' ', ""},
    {'0', "103041453616050110"},
    {'1', "152620 1030"},
    {'2', "05163645440040"},
    {'3', "0516364544334241301001 1333"},
    {'4', "30360242"},
    {'5', "460603334241301001"},
    {'6', "453616050110304142331302"},
    {'7', "064620"},
    {'8', "13334445361605041302011030414233 1333"},
    {'9', "011030414536160504133344"},
    {'A', "0004264440 0343"},
    {'B', "00063645443303 3342413000"},
    {'C', "4536160501103041"},
    {'D', "00063645413000"},
    {'E', "46060040 0333"},
    {'F', "460600 0333"},
    {'G', "45361605011030414323"},
    {'H', "0006 4046 0343"},
    {'I', "1636 2620 1030"},
    {'J', "4641301001"},
    {'K', "0006 4602 1340"},
    {'L', "060040"},
    {'M', "0006234640"},
    {'N', "00064046"},
    {'O', "103041453616050110"},
    {'P', "00063645443303"},
    {'Q', "103041453616050110 2240"},
    {'R', "00063645443303 2340"},
    {'S', "453616050413334241301001"},
    {'T', "0646 2620"},
    {'U', "060110304146"},
    {'V', "062046"},
    {'W', "0610233046"},
    {'X', "0046 0640"},
    {'Y', "062346 2320"},
    {'Z', "06460040"},
    {'a', "4130100103143443 4440"},
    {'b', "0600 0314344341301001"},
    {'c', "4334140301103041"},
    {'d', "4640 4334140301103041"},
    {'e', "02424334140301103041"},
    {'f', "36261510 0434"},
    {'g', "4334140301103041 444a3b1b"},
    {'h', "0600 0314344340"},
    {'i', "2420 2526"},
    {'j', "242a1b0b 2526"},
    {'k', "0600 3401 1240"},
    {'l', "2620"},
    {'m', "0400 03142320 23344340"},
    {'n', "0400 0314344340"},
    {'o', "103041433414030110"},
    {'p', "040b 0314344341301001"},
    {'q', "444b 4334140301103041"},
    {'r', "0400 03143443"},
    {'s', "43341403123241301001"},
    {'t', "26213041 1434"},
    {'u', "0401103041 4440"},
    {'v', "042044"},
    {'w', "0410223044"},
    {'x', "0044 0440"},
    {'y', "0420 441b"},
    {'z', "04440040"},
    {'.', "2021"},
    {',', "211a"},
    {':', "2021 2324"},
    {';', "211a 2324"},
    {'!', "2622 2021"},
    {'?', "05163645442322 2021"},
    {'-', "0343"},
    {'+', "0343 2521"},
    {'=', "0242 0444"},
    {'/', "0046"},
    {'*', "2521 0442 0244"},
    {'(', "36141230"},
    {')', "16343210"},
    {'#', "1016 3036 0242 0444"},
    {'%', "0046 0506 4041"},
    {'&', "401516262502011031"},
    {'_', "0040"},
    {'\'', "2624"},
    {'"', "1614 3634"},
};
constexpr double letter_pitch = 6, line_pitch = 10, capital_height = 6;

constexpr bool well_formed() {
    for (const Glyph& glyph : glyphs) {
        std::size_t in_stroke = 0;
        for (std::size_t i = 0; i <= glyph.strokes.size(); ++i) {
            const char c = i < glyph.strokes.size() ? glyph.strokes[i] : ' ';
            if (c == ' ') {
                if (in_stroke % 2 != 0 || (in_stroke != 0 && in_stroke < 4)) return false;
                in_stroke = 0;
            } else {
                if (!((c >= '0' && c <= '6') || (in_stroke % 2 == 1 && (c == 'a' || c == 'b')))) return false;
                ++in_stroke;
            }
        }
    }
    return true;
}
static_assert(well_formed(), "every stroke of the font has two points or more, all on the grid");

double on_grid(char c) {
    return c == 'a' ? -1 : c == 'b' ? -2 : c - '0';
}

tl::unexpected<Error> wrong_braces(std::size_t at) {
    return fail(ErrorKind::invalid_input, fmt::format("Character {} of the text: braces may contain n, or n:05 for "
                                                      "five digits with leading zeros. Nothing was marked.",
                                                      at + 1));
}

}  // namespace

Result<std::string> numbered(std::string_view text, std::int64_t number) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '}') return wrong_braces(i);
        if (text[i] != '{') {
            out += text[i];
            continue;
        }
        const std::size_t end = text.find('}', i);
        const std::string_view inside = end == std::string_view::npos ? "" : text.substr(i + 1, end - i - 1);
        std::size_t digits = 0;
        const bool plain = inside == "n";
        if (!plain) {
            const auto digit = [](char c) { return c >= '0' && c <= '9'; };
            if (inside.substr(0, 3) != "n:0" || inside.size() > 5 ||
                !std::all_of(inside.begin() + 3, inside.end(), digit))
                return wrong_braces(i);
            for (const char c : inside.substr(3)) digits = digits * 10 + static_cast<std::size_t>(c - '0');
            if (digits < 1 || digits > 18) return wrong_braces(i);
        }
        const std::string shown = fmt::format("{:0{}}", number, digits);
        if (!plain && shown.size() > digits)
            return fail(ErrorKind::invalid_input,
                        fmt::format("The number {} has more than the {} digits of character {} of "
                                    "the text. Nothing was marked; increase them.",
                                    number, digits, i + 1));
        out += shown;
        i = end;
    }
    return out;
}

Result<Drawing> text_drawing(std::string_view text, double height_mm) {
    Drawing out;
    const double unit = height_mm / capital_height;
    double x = 0, y = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\n') {
            x = 0, y -= line_pitch;
            continue;
        }
        const auto* glyph =
            std::find_if(std::begin(glyphs), std::end(glyphs), [&](const Glyph& g) { return g.letter == text[i]; });
        if (glyph == std::end(glyphs))
            return fail(
                ErrorKind::invalid_input,
                fmt::format("Character {} of the text is not in the font, which has A-Z, a-z, 0-9 and common marks. "
                            "Nothing was marked; draw it as an SVG path.",
                            i + 1));
        const std::string_view strokes = glyph->strokes;
        bool down = false;
        for (std::size_t k = 0; k + 1 < strokes.size();) {
            if (strokes[k] == ' ') {
                down = false, ++k;
                continue;
            }
            const Spot at{(x + on_grid(strokes[k])) * unit, (y + on_grid(strokes[k + 1])) * unit};
            if (down)
                out.strokes.back().elements.push_back({at});
            else
                out.strokes.push_back({at, {}});
            down = true, k += 2;
        }
        x += letter_pitch;
    }
    return out;
}

}  // namespace motionrack::mark
