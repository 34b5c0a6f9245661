// The host of calls from Python: a rack in virtual time, or a real card in the computer's. One thread at a time.
#pragma once

#include <atomic>
#include <motionrack/base/time.hpp>
#include <thread>

namespace motionrack::python {

class Host {
  public:
    virtual ~Host() = default;
    virtual Instant now() = 0;
    /// Before a call that may move something. Throws a refusal where none is taken now.
    virtual void check_call() const {}
    /// After one, with Python's lock: a stop that ended it is over, unless a host keeps it. May throw.
    virtual void end_call() { stop_ = false; }

    /// Ends what runs; any thread may.
    void stop() { stop_ = true; }
    bool stopped() const { return stop_; }

    /// The thread that has it; see RackLock.
    std::atomic<std::thread::id> owner{};

  protected:
    std::atomic<bool> stop_{false};
};

}  // namespace motionrack::python
