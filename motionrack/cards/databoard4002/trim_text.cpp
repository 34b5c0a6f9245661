#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <motionrack/cards/databoard4002/trim_text.hpp>
#include <string>
#include <vector>

namespace motionrack::databoard4002 {

namespace {

std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
    std::vector<std::string_view> out;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
        out.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return out;
}

template <class Number>
bool read_whole(std::string_view text, Number& value) {
    const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), value);
    return bad == std::errc() && end == text.data() + text.size();
}

}  // namespace

Result<Trim> trim_from_text(std::string_view text) {
    if (text.find_first_not_of(" \t\n") == std::string_view::npos) return default_trim;
    Trim out;
    for (const std::string_view row : split(text, ",")) {
        std::vector<std::string_view> words = split(row, " \t\n");
        std::erase(words, std::string_view());
        const auto refuse = [&](const std::string& why) {
            return fail(ErrorKind::invalid_input,
                        fmt::format("Row {} of the trim table, \"{}\", {}. A row is a voltage in V "
                                    "and a rate, as in \"0.01 13799, 0.025 14051\".",
                                    out.size + 1, row, why));
        };
        double volts = 0;
        std::int32_t rate = 0;
        if (words.size() != 2 || !read_whole(words[0], volts) || !read_whole(words[1], rate))
            return refuse("is not two numbers");
        if (!(volts > 0 && volts <= 10)) return refuse("has a voltage outside 0 to 10 V");
        if (rate < 1 || rate > max_rate) return refuse(fmt::format("has a rate outside 1 to {}", max_rate));
        if (out.size == static_cast<int>(out.rows.size()))
            return refuse(fmt::format("is one too many; at most {} are allowed", out.rows.size()));
        const auto microvolts = static_cast<std::int32_t>(std::lround(volts * 1e6));
        const TrimRow before = out.size > 0 ? out.rows[static_cast<std::size_t>(out.size) - 1] : TrimRow{};
        if (microvolts <= before.microvolts || rate <= before.rate)
            return refuse("does not rise above the row before it, in voltage and in rate");
        out.rows[static_cast<std::size_t>(out.size++)] = {microvolts, rate};
    }
    return out;
}

}  // namespace motionrack::databoard4002
