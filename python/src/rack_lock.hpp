// One call from Python into a rack or a real card: one thread at a time, without the GIL while it runs; checks for
// Ctrl-C between runs.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <memory>
#include <python/src/python_error.hpp>
#include <python/src/rack_handle.hpp>
#include <type_traits>
#include <utility>

namespace motionrack::python {

namespace py = pybind11;

/// Lock of the rack or card for the current thread. Throws refused if another thread holds it, or if this thread is
/// inside a run (a progress call), which may only read.
class RackLock {
  public:
    /// stop: waits for the call of another thread, which the stop ends; not from within a call of this thread.
    enum class Access : std::uint8_t { read, run, stop };
    RackLock(Host& host, Access what);
    ~RackLock();
    RackLock(const RackLock&) = delete;
    RackLock& operator=(const RackLock&) = delete;

  private:
    void wait(std::thread::id me);

    Host& host_;
    bool mine_ = false;
};

/// Runs `call`, which returns a Result<T> or a plain value, without the GIL. `timeout`: a machine failure after that
/// time is a timeout. Rethrows a Python exception raised meanwhile (KeyboardInterrupt, from a progress call).
template <class Call>
auto run_exclusive(Host& host, Call call, Duration timeout = never);

/// As above for read access: keeps the GIL and may be called from a progress call.
template <class Call>
auto inspect_rack(RackHandle& world, Call call) {
    const RackLock turn(world, RackLock::Access::read);
    world.rack();
    return call();
}

/// Periodically checks Python for signals (Ctrl-C); called without the GIL.
class SignalPoll {
  public:
    /// Stops the host on a signal; its exception propagates after the run.
    void poll(Host& host);

  private:
    std::chrono::steady_clock::time_point last_{};
};
/// Lets RackHandle poll Python between runs.
void poll_python(RackHandle& world);
/// Ends the run because of a Python exception, which propagates after the run. Requires the GIL.
void abort_run(Host& host, py::error_already_set error);
/// Ends the call and throws the Python exception raised during it.
void end_call(Host& host);

/// Converts whole ticks of 100 ps from Python.
inline Duration ticks(std::int64_t count) {
    return Duration{count};
}
/// As above, for a time-out. Throws refused below 0.
Duration timeout_of(std::int64_t count);
/// Converts seconds from Python, 0 to 9e8; infinity: never. Throws refused beyond that.
Duration duration(double seconds);

namespace detail {
template <class T>
struct is_result : std::false_type {};
template <class T>
struct is_result<Result<T>> : std::true_type {};
}  // namespace detail

template <class Call>
auto run_exclusive(Host& host, Call call, Duration timeout) {
    using Value = decltype(call());
    const RackLock turn(host, RackLock::Access::run);
    host.check_call();
    const Instant began = host.now();
    if constexpr (std::is_void_v<Value>) {
        {
            const py::gil_scoped_release free;
            call();
        }
        end_call(host);
    } else {
        Value result = [&] {
            const py::gil_scoped_release free;
            return call();
        }();
        end_call(host);
        if constexpr (detail::is_result<Value>::value) {
            if (!result) {
                const bool machine = result.error().kind == ErrorKind::machine;
                raise(std::move(result).error(), machine && timeout != never && host.now() - began >= timeout);
            }
            if constexpr (!std::is_void_v<typename Value::value_type>) return *std::move(result);
        } else {
            return result;
        }
    }
}

/// Host of a driver: a rack, unless specialised.
template <class Driver>
struct HostOf {
    using type = RackHandle;
};

/// A driver with the rack of its card.
template <class Driver>
struct BoundDriver {
    std::shared_ptr<typename HostOf<Driver>::type> world;
    std::unique_ptr<Driver> driver;
};

/// Returns the card of that name. Throws refused if its type differs.
rack::Card& card_of_type(RackHandle& world, const std::string& name, std::string_view type);

/// Converts a member function of `Driver` (or of its base) to a Python function, run by run_exclusive().
template <class Driver, class Base, class Value, class... Parameters>
auto call(Value (Base::*function)(Parameters...)) {
    return [function](BoundDriver<Driver>& self, std::decay_t<Parameters>... parameters) {
        return run_exclusive(*self.world, [&] { return (self.driver.get()->*function)(parameters...); });
    };
}

}  // namespace motionrack::python
