#include "instructions.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "terminal.hpp"

namespace asmz {

namespace {

using old_host::Failure;

constexpr std::array<Instruction, 30> instructions = {{
    {"CALL", Form::word, 0xCD, "call @"},
    {"CI", Form::byte, 0xFE, "cp @"},
    {"CNZ", Form::word, 0xC4, "call nz,@"},
    {"CR", Form::reg, 0xB8, "cp @"},
    {"DECD", Form::pair, 0x0B, "dec @"},
    {"DJNZ", Form::near, 0x10, "djnz @"},
    {"INCD", Form::pair, 0x03, "inc @"},
    {"INCR", Form::reg_high, 0x04, "inc @"},
    {"INP", Form::byte, 0xDB, "in a,(@)"},
    {"INPR", Form::port_reg, 0x40, "in @,(c)"},
    {"JMP", Form::word, 0xC3, "jp @"},
    {"JNZS", Form::near, 0x20, "jr nz,@"},
    {"JZS", Form::near, 0x28, "jr z,@"},
    {"L", Form::load, 0x46, "ld @,#"},
    {"LA", Form::pair_word, 0x01, "ld @,#"},
    {"LDI", Form::pair_word, 0x01, "ld @,#"},
    {"LI", Form::reg_byte, 0x06, "ld @,#"},
    {"LR", Form::reg_reg, 0x40, "ld @,#"},
    {"NI", Form::byte, 0xE6, "and @"},
    {"OR", Form::reg, 0xB0, "or @"},
    {"OUT", Form::byte, 0xD3, "out (@),a"},
    {"OUTR", Form::port_reg, 0x41, "out (c),@"},
    {"POP", Form::push, 0xC1, "pop @"},
    {"PUSH", Form::push, 0xC5, "push @"},
    {"RET", Form::none, 0xC9, "ret"},
    {"RNZ", Form::none, 0xC0, "ret nz"},
    {"ST", Form::store, 0x32, "ld (#),@"},
    {"STD", Form::store_pair, 0x22, "ld (#),@"},
    {"SVC", Form::service, 0xCF, "rst 8\n db @\n dw #"},
    {"TBT", Form::bit, 0x40, "bit @,#"},
}};

int index_of(const std::string& name, std::string_view names) {
    const std::size_t at = name.size() == 1 && name != "." ? names.find(name) : std::string_view::npos;
    if (at == std::string_view::npos) throw Failure("'" + name + "' is not a register here");
    return static_cast<int>(at);
}

int reg(const std::string& name) {
    return index_of(name, "BCDEHL.A");
}

int pair(const std::string& name) {
    constexpr std::array<std::string_view, 3> pairs = {"BC", "DE", "HL"};
    const auto* found = std::find(pairs.begin(), pairs.end(), name);
    if (found == pairs.end()) throw Failure("'" + name + "' is not a pair of registers");
    return static_cast<int>(found - pairs.begin());
}

std::string small(std::string text) {
    for (char& c : text) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    return text;
}

/// Bytes of one instruction, and the names of its operands.
class Encoder {
  public:
    explicit Encoder(const Place& place) : place_(place) {}

    void with_one(const Instruction& row, const std::string& operand) {
        first = small(operand);
        switch (row.form) {
            case Form::word:
                put(row.code), word(operand, first);
                break;
            case Form::near:
                put(row.code), near(operand);
                break;
            case Form::byte:
                put(row.code), byte(operand, first);
                break;
            case Form::reg:
                put(row.code | reg(operand));
                break;
            case Form::reg_high:
                put(row.code | reg(operand) << 3);
                break;
            case Form::port_reg:
                put(0xED), put(row.code | reg(operand) << 3);
                break;
            case Form::pair:
                put(row.code | pair(operand) << 4);
                break;
            default:  // push
                put(row.code | (operand == "A" ? 3 : pair(operand)) << 4);
                if (operand == "A") first = "af";
        }
    }

    void with_two(const Instruction& row, const std::string& one, const std::string& two) {
        first = small(one), second = small(two);
        switch (row.form) {
            case Form::reg_byte:
                put(row.code | reg(one) << 3), byte(two, second);
                break;
            case Form::reg_reg:
                put(row.code | reg(one) << 3 | reg(two));
                break;
            case Form::load:
                if (two != "(HL)" && (two != "(DE)" || one != "A")) throw Failure("L has no form " + one + "," + two);
                put(two == "(HL)" ? row.code | reg(one) << 3 : 0x1A);
                break;
            case Form::pair_word:
                put(row.code | pair(one) << 4), word(two, second);
                break;
            case Form::bit:
                put(0xCB), put(row.code | bit(one) << 3 | reg(two));
                break;
            case Form::service:
                put(row.code), byte(one, first), word(two, second);
                break;
            default:  // store, store_pair
                if (one != (row.form == Form::store ? "A" : "HL")) throw Failure("'" + one + "' cannot be stored so");
                put(row.code), word(two, second);
        }
    }

    void put(int number) { bytes.push_back(static_cast<std::uint8_t>(number & 0xFF)); }

    std::vector<std::uint8_t> bytes;
    std::string first;
    std::string second;

  private:
    void byte(const std::string& text, std::string& shown) {
        const int number = place_.value(text);
        if (number < -128 || number > 255) throw Failure(std::to_string(number) + " is more than a byte");
        put(number);
        shown = hex(number & 0xFF);
    }

    void word(const std::string& text, std::string& shown) {
        const int number = place_.value(text);
        put(number), put(number >> 8);
        shown = hex(number);
    }

    void near(const std::string& text) {
        const int address = place_.value(text), distance = address - place_.here - 2;
        if (place_.final && (distance < -128 || distance > 127))
            throw Failure(text + " is " + std::to_string(distance) + " bytes away; it must be -128 to 127");
        put(distance);
        first = hex(address);
    }

    int bit(const std::string& text) {
        const int value = place_.value(text);
        for (int number = 0; number < 8; ++number)
            if (value == 1 << number) {
                first = std::to_string(number);
                return number;
            }
        if (place_.final) throw Failure(text + " is not the value of one bit");
        return 0;
    }

    const Place& place_;
};

}  // namespace

std::string hex(int value) {
    char text[16];
    std::snprintf(text, sizeof text, "0x%04x", static_cast<unsigned>(value) & 0xFFFF);
    return text;
}

std::size_t operands_of(Form form) {
    return form == Form::none ? 0 : form <= Form::push ? 1 : 2;
}

const Instruction* instruction_of(const std::string& name) {
    for (const Instruction& each : instructions)
        if (each.name == name) return &each;
    return nullptr;
}

Encoded encode(const Instruction& row, const std::vector<std::string>& operands, const Place& place) {
    const std::size_t expected = operands_of(row.form);
    if (operands.size() != expected)
        throw Failure(std::string(row.name) + " has " + std::to_string(operands.size()) + " operands; it needs " +
                      std::to_string(expected));
    Encoder encoder(place);
    if (expected == 0) encoder.put(row.code);
    if (expected == 1) encoder.with_one(row, operands[0]);
    if (expected == 2) encoder.with_two(row, operands[0], operands[1]);
    Encoded out{encoder.bytes, " "};
    for (const char c : row.zilog)
        out.zilog += c == '@' ? encoder.first : c == '#' ? encoder.second : std::string(1, c);
    out.zilog += '\n';
    return out;
}

}  // namespace asmz
