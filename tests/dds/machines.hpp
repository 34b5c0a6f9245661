// Several computers on one network, made of Linux namespaces:
//
//   machine 0    machine 1    machine 2        each with a network, a host name and an address
//     eth0         eth0         eth0           10.77.0.(n + 1) of its own
//      |            |            |
//      p0 -------- br0 --------- p2            the test's own network
//
// Other processes do not see these networks, and the kernel removes them when the test's process ends for any reason.
#pragma once

#include <sys/types.h>

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace motionrack::dds_test {

using Command = std::vector<std::string>;

/// A program on a machine; its standard output is lines of JSON. It is killed on destruction.
class Child {
  public:
    Child(pid_t process, int output) : process_(process), output_(output) {}
    ~Child();
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    Child(Child&& other) noexcept;
    Child& operator=(Child&&) = delete;

    /// Reads until a line fulfils `condition`. Returns false if the program ends first or prints no line for a minute.
    using Condition = std::function<bool(const nlohmann::json&)>;
    bool wait_for(const Condition& condition);
    /// As wait_for, for an event of this kind; returns true at once if such a line was read before, and makes it
    /// last().
    bool wait_for_event(const std::string& kind);
    /// Reads until the program ends. Returns its exit code, or -1 if a signal ended it.
    int finish();
    void send(int signal);
    /// Returns true if an event of this kind was among the lines read.
    bool reported(const std::string& kind) const { return events_.count(kind) != 0; }
    /// Returns the last lines read, for a message.
    std::string said() const;
    const nlohmann::json& last() const { return last_; }

  private:
    bool read_line();
    pid_t process_;
    int output_;
    std::string rest_, said_;
    nlohmann::json last_;
    std::map<std::string, nlohmann::json> events_;  ///< the last line of each kind
};

/// Returns a condition for wait_for: the line reports an event of this kind.
Child::Condition is_event(const std::string& kind);

class Machines {
  public:
    /// Makes `count` machines; if that is not permitted here, why_not() has the reason.
    explicit Machines(int count);
    ~Machines();
    Machines(const Machines&) = delete;
    Machines& operator=(const Machines&) = delete;

    const std::string& why_not() const { return why_not_; }
    Child start(int machine, const Command& command);
    /// Connects or disconnects the cable of a machine.
    void set_link(int machine, bool up);
    /// Makes packets to a machine get lost. Returns false if this kernel cannot do so.
    bool begin_loss(int machine);
    void end_loss(int machine);

  private:
    bool make(int count);
    bool add_machine();
    bool run(int machine, const Command& command);
    std::vector<pid_t> holders_;
    std::string why_not_;
};

}  // namespace motionrack::dds_test
