// Pseudo-terminal with a symbolic link of its own.
#pragma once

#include <motionrack/base/result.hpp>
#include <string>

namespace motionrack::server {

/// Owns a file descriptor; closes it on destruction.
class OpenFile {
  public:
    explicit OpenFile(int file = -1) : file_(file) {}
    OpenFile(OpenFile&& other) noexcept : file_(other.give()) {}
    OpenFile& operator=(OpenFile&& other) noexcept;
    ~OpenFile();
    int number() const { return file_; }
    int give();

  private:
    int file_;
};

/// Owns the master end. Keeps the other end open too, otherwise the second client would find the line hung up. The line
/// is raw: no echo, line ends unchanged; the baud rate is ignored. Only its owner may open it.
class PseudoTerminal {
  public:
    /// `link`: symbolic link to the other end; a link left by an earlier run of this user is replaced. Errors: io, also
    /// if another kind of file is at the path or another running program owns the link.
    static Result<PseudoTerminal> open(const std::string& link);
    PseudoTerminal(PseudoTerminal&&) = default;
    PseudoTerminal& operator=(PseudoTerminal&&) = default;
    /// Removes the link if it still points to this terminal.
    ~PseudoTerminal();

    OpenFile take_master() { return std::move(master_); }
    /// Discards output that clients have not read; keeps their input.
    void forget_unread();
    /// Client activity since the last call.
    struct ClientActivity {
        bool left = false;  ///< the last client closed it
        bool came = false;  ///< a client opened it while no other had it open; it may have left again
    };
    ClientActivity poll_client();
    int clients() const { return clients_; }
    /// Descriptor that becomes readable on client activity; then call poll_client().
    int watch() const { return watch_.number(); }

  private:
    PseudoTerminal() = default;
    OpenFile reserved_, master_, slave_, watch_;
    std::string name_, link_;
    int clients_ = 0;
};

}  // namespace motionrack::server
