// Files served by a process (FUSE): system calls on real files that reach the virtual card.
//
//  FOLDER/port    like the file of a PCI card's I/O region: pread and pwrite of 2 bytes at port_base + offset are
//  16-bit
//                  accesses, of 1 byte 8-bit ones
//  FOLDER/uio0    like the interrupt side of a UIO node
//  FOLDER/look    like FOLDER/port, for a test that accesses the card beside the driving program
//  FOLDER/refuse  write a number of 4 bytes: that many next accesses to FOLDER/port fail (ENODEV), like those of a
//                 removed card
//  FOLDER/absent  write a number of 4 bytes: 1: FOLDER/port is an empty slot, which reads FFh and takes nothing
#pragma once

#include <memory>
#include <string>

namespace motionrack::live_test {

class VirtualCard;

inline constexpr unsigned port_base = 0x300;

class ServedFiles {
  public:
    /// Returns nullptr, with a sentence in `why`, if this computer cannot serve files.
    static std::unique_ptr<ServedFiles> serve(VirtualCard& card, const std::string& folder, std::string& why);
    virtual ~ServedFiles() = default;
};

}  // namespace motionrack::live_test
