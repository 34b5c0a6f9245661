#include "computer.hpp"

#include <algorithm>

namespace old_host {

namespace {

constexpr int service_port = 0xFF;
constexpr int halt = 0x76;
/// T-states of the instructions with an access, from the opcode (behind a prefix of 4) to its end.
constexpr std::uint64_t direct_states = 11, prefixed_states = 8;

}  // namespace

Computer::Computer(const asmz::Program& program, Machine& machine, Terminal& terminal)
    : machine_(machine),
      terminal_(terminal),
      os8_{asmz::symbol(program, "S0.FC"),    asmz::symbol(program, "S1.BAD"),   asmz::symbol(program, "S1.BSZ"),
           asmz::symbol(program, "S1.ROW"),   asmz::symbol(program, "S1.COL"),   asmz::symbol(program, "S1F.WRIT"),
           asmz::symbol(program, "S1F.RND"),  asmz::symbol(program, "S1F.READ"), asmz::symbol(program, "S6F.CAN"),
           asmz::symbol(program, "S7F.ASGN"), asmz::symbol(program, "S7.FD")},
      cpu_(z80ex_create(read_memory, this, write_memory, this, read_port, this, write_port, this, read_vector, this),
           z80ex_destroy) {
    memory_[0] = halt;  // where the program would return to
    constexpr std::array<std::uint8_t, 3> entry = {0xD3, service_port, 0xC9};
    std::copy(entry.begin(), entry.end(), memory_.begin() + 8);
    std::copy(program.bytes.begin(), program.bytes.end(), memory_.begin() + program.origin);
    z80ex_reset(cpu_.get());
    z80ex_set_reg(cpu_.get(), regPC, program.start);
    z80ex_set_reg(cpu_.get(), regSP, stack_top - 2);
}

bool Computer::run() {
    while (!over_ && !failure_) {
        states_ += static_cast<std::uint64_t>(z80ex_step(cpu_.get()));
        prefixed_ = z80ex_last_op_type(cpu_.get()) != 0;
        if (z80ex_doing_halt(cpu_.get()) != 0)
            throw Failure("The program has halted at " + std::to_string(z80ex_get_reg(cpu_.get(), regPC)) +
                          ". It was ended.");
        if (states_ * t_state_ns > machine_.max_ready_wait_ns()) machine_.pass_to(states_ * t_state_ns);
    }
    if (failure_) std::rethrow_exception(failure_);
    return !cancelled_;
}

std::uint16_t Computer::word(int address) const {
    const auto at = static_cast<std::uint16_t>(address);
    return static_cast<std::uint16_t>(memory_[at] | memory_[static_cast<std::uint16_t>(at + 1)] << 8);
}

void Computer::set_word(int address, int value) {
    memory_[static_cast<std::uint16_t>(address)] = static_cast<std::uint8_t>(value & 0xFF);
    memory_[static_cast<std::uint16_t>(address + 1)] = static_cast<std::uint8_t>((value >> 8) & 0xFF);
}

// ---- OS8

void Computer::call_os8() {
    machine_.pass_to(states_ * t_state_ns);
    const int stack = z80ex_get_reg(cpu_.get(), regSP), parameters = word(stack);
    set_word(stack, parameters + 3);
    const int service = memory_[static_cast<std::uint16_t>(parameters)], block = word(parameters + 1);
    const int function = memory_[static_cast<std::uint16_t>(block + os8_.function)];
    if (service == 1)
        transfer(block);
    else if (service == 6 && function == os8_.cancel)
        over_ = cancelled_ = true;
    else if (service == 7 && function == os8_.assign)
        assign_console(block);
    else
        throw Failure("The program calls SVC " + std::to_string(service) + " with function " +
                      std::to_string(function) +
                      ", which is not one of 1, 6 and 7 as the listing uses them. It was "
                      "ended.");
}

void Computer::transfer(int block) {
    const int function = memory_[static_cast<std::uint16_t>(block + os8_.function)], buffer = word(block + os8_.buffer);
    if ((function & os8_.read) != 0) {
        over_ = !terminal_.key();
        states_ = machine_.now_ns() / t_state_ns;
        memory_[static_cast<std::uint16_t>(buffer)] = ' ';
        return;
    }
    if ((function & os8_.write) == 0) return;
    if ((function & os8_.random) != 0) {
        for (const int byte : {27, int{'='}, 32 + memory_[static_cast<std::uint16_t>(block + os8_.row)],
                               32 + memory_[static_cast<std::uint16_t>(block + os8_.column)]})
            terminal_.put(static_cast<std::uint8_t>(byte));
    }
    const int size = word(block + os8_.size);
    for (int i = 0; i < size; ++i) terminal_.put(memory_[static_cast<std::uint16_t>(buffer + i)]);
    terminal_.end_text();
}

void Computer::assign_console(int block) {
    std::string name;
    const int descriptor = word(block + os8_.descriptor);
    for (int i = 0; i < 4; ++i) name += static_cast<char>(memory_[static_cast<std::uint16_t>(descriptor + i)]);
    if (name != "CON ") throw Failure("The program assigns '" + name + "', not the console 'CON '. It was ended.");
}

// ---- the processor's bus

/// z80ex is C: exceptions are rethrown after it has returned.
template <class Action>
void Computer::guarded(const Action& action) {
    if (failure_) return;
    try {
        action();
    } catch (...) {
        failure_ = std::current_exception();
    }
}

void Computer::meet() {
    const std::uint64_t end = states_ + (prefixed_ ? prefixed_states : direct_states);
    machine_.pass_to((end - 1) * t_state_ns);
}

Z80EX_BYTE Computer::read_memory(Z80EX_CONTEXT*, Z80EX_WORD address, int, void* self) {
    return static_cast<Computer*>(self)->memory_[address];
}

void Computer::write_memory(Z80EX_CONTEXT*, Z80EX_WORD address, Z80EX_BYTE value, void* self) {
    static_cast<Computer*>(self)->memory_[address] = value;
}

Z80EX_BYTE Computer::read_port(Z80EX_CONTEXT*, Z80EX_WORD port, void* self) {
    auto& computer = *static_cast<Computer*>(self);
    Z80EX_BYTE value = 0xFF;
    computer.guarded([&] {
        computer.meet();
        value = computer.machine_.in(port & 0xFF);
    });
    return value;
}

void Computer::write_port(Z80EX_CONTEXT*, Z80EX_WORD port, Z80EX_BYTE value, void* self) {
    auto& computer = *static_cast<Computer*>(self);
    computer.guarded([&] {
        if ((port & 0xFF) == service_port) return computer.call_os8();
        computer.meet();
        computer.machine_.out(port & 0xFF, value);
    });
}

Z80EX_BYTE Computer::read_vector(Z80EX_CONTEXT*, void*) {
    return 0xFF;
}

}  // namespace old_host
