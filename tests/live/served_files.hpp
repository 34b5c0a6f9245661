// Files that a process serves (FUSE): real system calls on real files, each of which reaches the virtual card.
//
//   FOLDER/port    as the file of a PCI card's I/O region: pread and pwrite of 2 bytes at port_base + offset are 16-bit
//                  accesses, of 1 byte 8-bit ones
//   FOLDER/uio0    as the interrupt side of a UIO node
//   FOLDER/look    as FOLDER/port, for a test that looks at the card beside the program that drives it
//   FOLDER/refuse  a number of 4 bytes, written: so many accesses to FOLDER/port fail from now on (ENODEV), as of a
//                  card that was pulled out
#pragma once

#include <memory>
#include <string>

namespace motionrack::live_test {

class VirtualCard;

inline constexpr unsigned port_base = 0x300;

class ServedFiles {
  public:
    /// nullptr, with a sentence in `why`, where this computer does not let files be served.
    static std::unique_ptr<ServedFiles> serve(VirtualCard& card, const std::string& folder, std::string& why);
    virtual ~ServedFiles() = default;
};

}  // namespace motionrack::live_test
