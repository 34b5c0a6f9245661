// The surroundings of an old host: a DataBoard 4002 by the C library, the screen of an ADM-3A whose texts are listed
// with the position of the axis, and a user who presses a key three seconds after the program asks for one.
//
//   host program ── port ──► Machine ── mr_read8, mr_write8 ──► card c1 ──► pulses ──► an ideal motor ──► counter
//                └─ byte ──► Terminal ──► a line of output for each text
#pragma once

#include <motionrack/c.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace old_host {

/// A program or a card that cannot go on; what() is the sentence for the user.
struct Failure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A switch that is held for a while; times since the start.
struct Press {
    std::string wire;
    std::uint64_t from_ns = 0;
    std::uint64_t until_ns = 0;
};

/// Arguments of the command line.
struct Request {
    std::string program;  ///< path of the listing
    int rounds = 1;       ///< 1 .. 100: rounds of three keys each
    std::optional<Press> press;
};

/// Reads PROGRAM [ROUNDS [WIRE FROM UNTIL]], the times in s. Throws Failure with the usage.
Request request_of(const std::vector<std::string>& words, const std::string& usage);
/// Reads a file whole. Throws Failure.
std::string file_text(const std::string& path);

class Machine {
  public:
    /// `bus_access_ns`: duration of an access of the host, 0 .. 100,000. Throws Failure.
    Machine(std::uint64_t bus_access_ns, std::optional<Press> press);
    ~Machine() { mr_rack_close(rack_); }
    Machine(const Machine&) = delete;
    Machine& operator=(const Machine&) = delete;

    /// Port 0 .. 255. Takes bus_access_ns. Throws Failure where the card has no such port.
    std::uint8_t in(std::uint32_t port);
    void out(std::uint32_t port, std::uint8_t value);
    /// Lets virtual time run to `ns` since the start; an instant that is past changes nothing. Throws Failure when
    /// the program has put nothing on its screen for 1000 s.
    void pass_to(std::uint64_t ns);
    void pass(std::uint64_t ns) { pass_to(now_ns() + ns); }
    std::uint64_t now_ns() const { return mr_now_ns(rack_); }
    /// The card's counter.
    double counts() const;
    /// The program does something that its user sees.
    void seen() { max_wait_ns_ = now_ns() + 1'000'000'000'000; }
    /// Instant at which pass_to() gives the program up.
    std::uint64_t max_ready_wait_ns() const { return max_wait_ns_; }

  private:
    void set_wire(double level);

    mr_rack* rack_ = nullptr;
    std::optional<Press> press_;
    std::uint64_t max_wait_ns_ = 1'000'000'000'000;
};

class Terminal {
  public:
    Terminal(Machine& machine, int rounds) : machine_(machine), rounds_(rounds) {}

    /// A byte for the screen: 26 clears it, 7 is the bell, 27 '=' row+32 column+32 moves the cursor, CR and LF end a
    /// text; what can be printed stands where the cursor is.
    void put(std::uint8_t byte);
    /// Ends a text; lists it unless it is blank.
    void end_text();
    /// Waits for a key of the user: three seconds. False: the last round is over and he presses none.
    bool key();
    bool over() const { return over_; }

  private:
    void list(const std::string& what);

    Machine& machine_;
    int rounds_;
    int round_ = 1;
    bool over_ = false;
    bool bell_ = false;
    int row_ = 0;
    int column_ = 0;
    int escape_ = 0;  ///< how many bytes of a cursor address are to come, from 3
    std::string text_;
    int text_column_ = 0;
    std::vector<double> stood_;  ///< counts at the keys of this round
};

}  // namespace old_host
