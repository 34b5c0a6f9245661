// A pseudo-terminal under a name of its own.
#pragma once

#include <motionrack/base/result.hpp>
#include <string>

namespace motionrack::server {

/// Closes a file when it goes.
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

/// The master's end is ours; the other is held open too, or who comes after the first client would find the line hung
/// up. It is raw: no echo, no line ends changed; a baud rate that is set means nothing. Only its owner may open it.
class PseudoTerminal {
  public:
    /// `link`: a symbolic link to the other end; one that an earlier run of this user has left is replaced. Errors: io,
    /// also where anything else is in its place, or another program that runs has the link.
    static Result<PseudoTerminal> open(const std::string& link);
    PseudoTerminal(PseudoTerminal&&) = default;
    PseudoTerminal& operator=(PseudoTerminal&&) = default;
    /// Takes the link away, if it is still the one that leads here.
    ~PseudoTerminal();

    OpenFile take_master() { return std::move(master_); }
    /// Throws away what clients have not read; what they wrote is heard.
    void forget_unread();
    /// What clients have done since the last look.
    struct Look {
        bool left = false;  ///< the last one has closed it
        bool came = false;  ///< and, or before that, one has opened it as the only one
    };
    Look look();
    int clients() const { return clients_; }
    /// Readable when there is something to look at.
    int watch() const { return watch_.number(); }

  private:
    PseudoTerminal() = default;
    OpenFile reserved_, master_, slave_, watch_;
    std::string name_, link_;
    int clients_ = 0;
};

}  // namespace motionrack::server
