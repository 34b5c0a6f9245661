// Host of calls from Python: a rack in simulated time, or a real card in real time. One thread at a time.
#pragma once

#include <atomic>
#include <motionrack/base/time.hpp>
#include <thread>

namespace motionrack::python {

class Host {
  public:
    virtual ~Host() = default;
    virtual Instant now() = 0;
    /// Called before a call that may move axes. Throws refused if motion is not allowed now.
    virtual void check_call() const {}
    /// Called after it, with the GIL held: clears the stop that ended the call, unless the host keeps it. May throw.
    virtual void end_call() { stop_ = false; }

    /// Ends the running call; any thread.
    void stop() { stop_ = true; }
    bool stopped() const { return stop_; }

    /// thread that holds the lock; see RackLock
    std::atomic<std::thread::id> owner{};

  protected:
    std::atomic<bool> stop_{false};
};

}  // namespace motionrack::python
