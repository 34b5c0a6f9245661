// Reads and interpolates the 2D compensation of encoder counts.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <motionrack/cards/rtc5/model/fly_table.hpp>
#include <optional>

namespace motionrack::rtc5 {

namespace {

std::string_view trimmed(std::string_view line) {
    line = line.substr(0, line.find(';'));
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return line.substr(begin, line.find_last_not_of(" \t\r") - begin + 1);
}

/// Parses four whole numbers of 32 bits, separated by blanks.
std::optional<std::array<std::int32_t, 4>> four_numbers(std::string_view line) {
    std::array<std::int32_t, 4> out{};
    for (std::int32_t& value : out) {
        line.remove_prefix(std::min(line.find_first_not_of(" \t,"), line.size()));
        const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
        if (error != std::errc{}) return std::nullopt;
        line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    }
    return trimmed(line).empty() ? std::optional(out) : std::nullopt;
}

using Points = std::map<std::pair<std::int32_t, std::int32_t>, FlyTable::Shift>;  // (Enc1, Enc0): row by row

Result<Points> points_of(std::string_view text, const std::string& section, const std::string& file) {
    Points points;
    bool inside = false, seen = false;
    int number = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view whole = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++number;
        const std::string_view line = trimmed(whole);
        if (!line.empty() && line.front() == '[') {
            inside = line == section && !seen;
            seen = seen || inside;
            continue;
        }
        if (!inside || line.empty()) continue;
        if (whole.size() > 255)
            return fail(ErrorKind::invalid_input,
                        fmt::format("the line has {} characters; at most 255 are allowed. The table was not loaded",
                                    whole.size()),
                        {number, 0}, file);
        const auto values = four_numbers(line);
        if (!values)
            return fail(ErrorKind::invalid_input,
                        "a line of a compensation table has four whole numbers: Enc0 Enc1 dEnc0 dEnc1. The table was "
                        "not loaded",
                        {number, 0}, file);
        points[{(*values)[1], (*values)[0]}] = {static_cast<double>((*values)[2]), static_cast<double>((*values)[3])};
    }
    if (!seen)
        return fail(ErrorKind::invalid_input,
                    fmt::format("section {} was not found; the table was not loaded", section), {}, file);
    return points;
}

/// Finds the grid cell of `value`; returns its index and the fraction (0 .. 1) within it.
std::pair<std::size_t, double> cell(const std::vector<double>& grid, double value) {
    if (!(value > grid.front())) return {0, 0.0};
    if (value >= grid.back()) return {grid.size() - 2, 1.0};
    const auto above = static_cast<std::size_t>(std::upper_bound(grid.begin(), grid.end(), value) - grid.begin());
    return {above - 1, (value - grid[above - 1]) / (grid[above] - grid[above - 1])};
}

}  // namespace

Result<FlyTable> FlyTable::read(std::string_view text, unsigned number, const std::string& file) {
    MOTIONRACK_TRY(const Points points, points_of(text, fmt::format("[Fly2DTable{}]", number), file));
    FlyTable out;
    for (const auto& [at, shift] : points) {
        out.columns_.push_back(at.second);
        out.rows_.push_back(at.first);
        out.shifts_.push_back(shift);
    }
    for (auto* grid : {&out.columns_, &out.rows_}) {
        std::sort(grid->begin(), grid->end());
        grid->erase(std::unique(grid->begin(), grid->end()), grid->end());
    }
    const std::size_t nodes = out.columns_.size() * out.rows_.size();
    if (out.columns_.size() < 2 || out.rows_.size() < 2 || nodes != points.size())
        return fail(ErrorKind::invalid_input,
                    fmt::format("{} points with {} different Enc0 and {} different Enc1 do not form a full grid (at "
                                "least 2 by 2); the table was not loaded",
                                points.size(), out.columns_.size(), out.rows_.size()),
                    {}, file);
    return out;
}

FlyTable::Shift FlyTable::at(double encoder0, double encoder1) const {
    const auto [column, fx] = cell(columns_, encoder0);
    const auto [row, fy] = cell(rows_, encoder1);
    const Shift *low = &shifts_[row * columns_.size() + column], *high = low + columns_.size();
    const auto between = [fx = fx, fy = fy](double a, double b, double c, double d) {
        const double l = a + (b - a) * fx, h = c + (d - c) * fx;
        return l + (h - l) * fy;
    };
    return {between(low[0].x, low[1].x, high[0].x, high[1].x), between(low[0].y, low[1].y, high[0].y, high[1].y)};
}

}  // namespace motionrack::rtc5
