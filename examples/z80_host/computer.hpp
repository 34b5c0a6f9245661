// A Z80 at 4 MHz with 64 KiB, the card's ports, and as much of OS8 as the listing calls.
//
//   program ── IN, OUT ──► Machine, which T-states of 250 ns have brought to the same instant
//           └─ SVC n,block = RST 8, a byte, a word ──► 0008h: OUT (0FFh),A; RET ──► Terminal
#pragma once

#include <z80ex/z80ex.h>

#include <array>
#include <cstdint>
#include <exception>
#include <memory>

#include "asmz.hpp"
#include "terminal.hpp"

namespace old_host {

class Computer {
  public:
    static constexpr std::uint64_t t_state_ns = 250;
    static constexpr std::uint16_t stack_top = 0xF000;

    /// Loads the program. Throws Failure if it lacks a symbol of OS8.
    Computer(const asmz::Program& program, Machine& machine, Terminal& terminal);
    Computer(const Computer&) = delete;
    Computer& operator=(const Computer&) = delete;

    /// Runs the program until the last round is over, or it ends itself (false). Throws Failure.
    bool run();

  private:
    struct Numbers {
        int function, buffer, size, row, column, write, random, read, cancel, assign, descriptor;
    };

    std::uint16_t word(int address) const;
    void set_word(int address, int value);
    /// Brings the machine to the instant of the access that ends the present instruction.
    void meet();
    void call_os8();
    void transfer(int block);
    void assign_console(int block);
    template <class Action>
    void guarded(const Action& action);

    static Z80EX_BYTE read_memory(Z80EX_CONTEXT*, Z80EX_WORD address, int m1, void* self);
    static void write_memory(Z80EX_CONTEXT*, Z80EX_WORD address, Z80EX_BYTE value, void* self);
    static Z80EX_BYTE read_port(Z80EX_CONTEXT*, Z80EX_WORD port, void* self);
    static void write_port(Z80EX_CONTEXT*, Z80EX_WORD port, Z80EX_BYTE value, void* self);
    static Z80EX_BYTE read_vector(Z80EX_CONTEXT*, void* self);

    Machine& machine_;
    Terminal& terminal_;
    Numbers os8_;
    std::array<std::uint8_t, 0x10000> memory_{};
    std::unique_ptr<Z80EX_CONTEXT, void (*)(Z80EX_CONTEXT*)> cpu_;
    std::uint64_t states_ = 0;  ///< T-states up to the present opcode
    bool prefixed_ = false;     ///< the present opcode has a prefix
    bool over_ = false;
    bool cancelled_ = false;
    std::exception_ptr failure_;
};

}  // namespace old_host
