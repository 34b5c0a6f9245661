// Reads and writes a tool table.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <motionrack/control/gcode/number.hpp>
#include <motionrack/control/gcode/program_lines.hpp>
#include <motionrack/control/gcode/tools.hpp>

namespace motionrack::control::gcode {

namespace {

char to_capital(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c & ~0x20) : c;
}

/// Destination of a word's value: `value`, or `whole` with its maximum for integers; null if a tool has no such letter.
struct Slot {
    double* value = nullptr;
    std::int32_t* whole = nullptr;
    std::int32_t max = 0;
};

Slot slot_of(char letter, Tool& tool) {
    switch (letter) {
        case 'T':
            return {nullptr, &tool.number, largest_tool};
        case 'P':
            return {nullptr, &tool.pocket, largest_tool};
        case 'Q':
            return {nullptr, &tool.orientation, 9};
        case 'D':
            return {&tool.diameter_mm};
        case 'I':
            return {&tool.front_angle};
        case 'J':
            return {&tool.back_angle};
        default:
            break;
    }
    const auto* axis = std::find(axis_letters.begin(), axis_letters.end(), letter);
    return axis == axis_letters.end() ? Slot{}
                                      : Slot{&tool.offset[static_cast<std::size_t>(axis - axis_letters.begin())]};
}

/// Reads one line; `problem` is empty if it is valid.
struct LineReader {
    std::string_view text;
    Tool tool = {};
    std::uint32_t seen = 0;
    std::string problem = {};
    std::size_t column = 0;

    bool read();
    bool word(const char*& at, const char* end);
    bool wrong(const char* at, std::string why) {
        column = static_cast<std::size_t>(at - text.data()) + 1;
        problem = std::move(why);
        return false;
    }
};

bool LineReader::word(const char*& at, const char* end) {
    const char* begin = at;
    const char letter = to_capital(*at++);
    const bool is_letter = letter >= 'A' && letter <= 'Z';
    const Slot slot = slot_of(letter, tool);
    const bool missing_axis = letter == 'U' || letter == 'V' || letter == 'W';
    if (!slot.value && !slot.whole && !missing_axis)
        return wrong(
            begin, fmt::format(
                       "'{}' is not a word of a tool table; these are T P X Y Z A B C D I J Q, and ';' begins a remark",
                       *begin));
    if (is_letter && (seen >> (letter - 'A') & 1) != 0) return wrong(begin, fmt::format("{} is there twice", letter));
    seen |= std::uint32_t{1} << (letter - 'A');
    const Number number = scan_number(at, end);
    if (number.fault != NumberFault::none)
        return wrong(begin, fmt::format("{} needs a number, e.g. {}1", letter, letter));
    if (missing_axis)
        return number.value == 0 || wrong(begin, fmt::format("{} must be 0: axes are X Y Z A B C", letter));
    if (slot.value) {
        *slot.value = number.value;
        return true;
    }
    if (number.value < 0 || number.value > slot.max || number.value != std::floor(number.value))
        return wrong(begin, fmt::format("{} is a whole number from 0 to {}", letter, slot.max));
    *slot.whole = static_cast<std::int32_t>(number.value);
    return true;
}

bool LineReader::read() {
    const char* at = text.data();
    const char* end = at + text.size();
    for (;;) {
        while (at < end && is_blank(*at)) ++at;
        if (at == end || *at == ';') break;
        if (!word(at, end)) return false;
    }
    if (seen == 0) return true;
    if ((seen >> ('T' - 'A') & 1) == 0 || tool.number == 0)
        return wrong(text.data(), "the line has no tool number (T1 to T99999)");
    return true;
}

}  // namespace

const Tool* ToolTable::find(std::int32_t number) const {
    const auto found =
        std::find_if(tools_.begin(), tools_.end(), [&](const Tool& tool) { return tool.number == number; });
    return found == tools_.end() ? nullptr : &*found;
}

bool ToolTable::put(const Tool& tool) {
    if (const Tool* there = find(tool.number)) {
        tools_[static_cast<std::size_t>(there - tools_.data())] = tool;
        return true;
    }
    if (tools_.size() >= max_tools) return false;
    tools_.push_back(tool);
    return true;
}

Result<ToolTable> read_tool_table(std::string_view text, const std::string& file) {
    ToolTable table;
    ProgramLines lines(text);
    for (std::string_view line; lines.next(line);) {
        LineReader reader{line};
        const bool good = reader.read();
        if (good && reader.seen == 0) continue;
        if (good && table.find(reader.tool.number))
            reader.wrong(line.data(),
                         fmt::format("tool T{} is defined twice; each tool needs its own number", reader.tool.number));
        else if (good && !table.put(reader.tool))
            reader.wrong(line.data(), fmt::format("a tool table has {} tools at most", max_tools));
        if (!reader.problem.empty())
            return fail(ErrorKind::invalid_input, fmt::format("{}; the tool table was not used", reader.problem),
                        {lines.number(), static_cast<int>(reader.column)}, file);
    }
    return table;
}

std::string to_text(const Tool& tool) {
    std::string out = fmt::format("T{} P{}", tool.number, tool.pocket);
    const auto add = [&out](char letter, double value) {
        if (value == 0) return;
        std::array<char, 400> digits;  // the smallest double needs 343 digits
        const auto [end, error] =
            std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed);
        MOTIONRACK_ASSERT(error == std::errc());
        out.append({' ', letter}).append(digits.data(), end);
    };
    for (std::size_t axis = 0; axis < axis_count; ++axis) add(axis_letters[axis], tool.offset[axis]);
    add('D', tool.diameter_mm);
    add('I', tool.front_angle);
    add('J', tool.back_angle);
    add('Q', tool.orientation);
    return out;
}

}  // namespace motionrack::control::gcode
