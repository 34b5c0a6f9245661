// An assembler for the language of the DataBoard's ASMZ, as far as the listing of the 4002's demonstration uses it.
//
//   LABEL     LDI     HL,C2:'L'     COMMENT          * in column 1: a comment line
//             | DA 14000,1          words            :  high byte : low byte
//             | DB 'TEXT'           bytes            *  the address of the statement, where a number is expected
//             | DMB 20,' '          a byte so often  17Q octal, 17H hexadecimal
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace asmz {

struct Source {
    std::string name;  ///< for errors
    std::string text;
};

struct Program {
    std::uint16_t origin = 0;
    std::uint16_t start = 0;          ///< the operand of END, or the origin
    std::vector<std::uint8_t> bytes;  ///< from the origin on
    std::string zilog;                ///< the same in Zilog's words, for another assembler
    std::map<std::string, int> symbols;
};

/// Assembles the sources one after the other, from `origin` on. Throws old_host::Failure with file and line.
Program assemble(const std::vector<Source>& sources, std::uint16_t origin);

/// The value of a symbol. Throws old_host::Failure if the program does not define it.
int symbol(const Program& program, const std::string& name);

}  // namespace asmz
