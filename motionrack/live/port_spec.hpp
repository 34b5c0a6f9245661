// Location of a real card's registers on this computer, in text form:
//
//   uio:/dev/uio0                                      map 0 of a UIO node, and its interrupt
//   memory:/sys/bus/pci/devices/.../resource1,stride=4 any mappable file: a PCI memory region
//   port:/sys/bus/pci/devices/.../resource2            a file with accesses of two bytes: a PCI I/O region
//   port:/dev/port,offset=0x300,width=8                the PC's I/O ports
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <string>
#include <string_view>

namespace motionrack::live {

enum class AddressSpace : std::uint8_t {
    uio,     ///< mapped; a map of a UIO node
    memory,  ///< mapped; any file
    port     ///< accessed by pread and pwrite
};

struct PortSpec {
    AddressSpace reach = AddressSpace::memory;
    std::string path;
    std::uint64_t offset = 0;  ///< bytes from the start of the file (uio: of the map) to the card's first register
    std::uint32_t stride = 0;  ///< bytes from one register to the next, 1 .. 4096; 0: the width of the card's registers
    int width = 16;            ///< bits per access: 16, or 8 for a card on its 8-bit bus
    int map = 0;               ///< uio: number of the map, 0 .. 4
    std::string interrupt = {};       ///< the UIO node that counts the card's interrupts; "": none
    Duration gap = nanoseconds(250);  ///< minimum time between two accesses, 0 .. 1 s
};

/// Returns true for the address of a real card ("uio:..", "memory:..", "port:.."), as opposed to the text or path of a
/// rack file. The address may be wrong.
bool names_real_card(std::string_view text);

/// Parses KIND:PATH[,KEY=VALUE]...; keys offset, stride, width, map, interrupt (a path or "none"), gap_ns; numbers
/// decimal or 0x... Errors: invalid_input, with the cause and the format.
Result<PortSpec> read_port_spec(std::string_view text);

/// Returns the format of the text, for messages and help.
std::string_view port_spec_form();

}  // namespace motionrack::live
