// The instructions of ASMZ: their operands, their bytes and their names in Zilog's words.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace asmz {

/// Operands of an instruction, and their places in its bytes.
enum class Form {
    none,
    word,        ///< nn
    near,        ///< an address up to 128 bytes away
    byte,        ///< n
    reg,         ///< r, in bits 0 to 2
    reg_high,    ///< r, in bits 3 to 5
    port_reg,    ///< (C) and r in bits 3 to 5, behind EDh
    pair,        ///< rr
    push,        ///< rr or A, which is AF
    reg_byte,    ///< r,n
    reg_reg,     ///< r,r
    load,        ///< r,(HL) or A,(DE)
    store,       ///< A,nn
    store_pair,  ///< HL,nn
    pair_word,   ///< rr,nn
    bit,         ///< the bit's value and r, behind CBh
    service,     ///< n,nn: restart 8, then the byte and the word
};

struct Instruction {
    std::string_view name;
    Form form;
    int code;
    std::string_view zilog;  ///< @ stands for the first operand, # for the second
};

/// How many operands each form has: 0 .. 2.
std::size_t operands_of(Form form);
/// Null: ASMZ does not have it.
const Instruction* instruction_of(const std::string& name);

struct Encoded {
    std::vector<std::uint8_t> bytes;
    std::string zilog;
};

/// State of the assembler that the encoder needs.
struct Place {
    int here = 0;        ///< address of the instruction
    bool final = false;  ///< all symbols have their values
    std::function<int(const std::string& expression)> value;
};

/// Throws old_host::Failure with the reason.
Encoded encode(const Instruction& row, const std::vector<std::string>& operands, const Place& place);

/// 0x1234.
std::string hex(int value);

}  // namespace asmz
