// One call from Python into a rack or a real card: one thread at a time, without Python's lock while it runs, Ctrl-C
// heard between runs.
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

/// While one lives its thread has the rack, or the card. Throws a refusal where another thread has it, or where this
/// one is in the middle of a run (a progress call); there it may only look.
class RackLock {
  public:
    /// stopping: waits for the call of another thread, which the stop ends; not from within a call of this thread.
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

/// Runs `call` without Python's lock; it gives a Result<T> or a plain value. `timeout`: a failure of the machine after
/// that time is a time-out. What Python raised meanwhile (KeyboardInterrupt, a progress call's exception) goes on.
template <class Call>
auto run_exclusive(Host& host, Call call, Duration timeout = never);

/// The same for what only looks: it keeps Python's lock and may be called from a progress call.
template <class Call>
auto inspect_rack(RackHandle& world, Call call) {
    const RackLock turn(world, RackLock::Access::read);
    world.rack();
    return call();
}

/// Asks Python whether a signal came (Ctrl-C), now and then; without Python's lock.
class SignalLook {
  public:
    /// Stops the host where one did; its exception goes on when the run has ended.
    void look(Host& host);

  private:
    std::chrono::steady_clock::time_point last_{};
};
/// Lets RackHandle ask Python between runs.
void poll_python(RackHandle& world);
/// What Python raised ends the run, and goes on when it has ended. With Python's lock.
void abort_run(Host& host, py::error_already_set error);
/// Ends the call and throws the exception that Python raised while it ran.
void end_call(Host& host);

/// Whole ticks of 100 ps from Python.
inline Duration ticks(std::int64_t count) {
    return Duration{count};
}
/// Seconds from Python, 0 to 9e8; infinity: never. Throws a refusal beyond that.
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

/// The host of a driver: a rack, unless specialised.
template <class Driver>
struct HostOf {
    using type = RackHandle;
};

/// A driver with the world whose card it drives.
template <class Driver>
struct BoundDriver {
    std::shared_ptr<typename HostOf<Driver>::type> world;
    std::unique_ptr<Driver> driver;
};

/// The card of that name, which must be of this type. Throws a refusal where it is another.
rack::Card& card_of_type(RackHandle& world, const std::string& name, std::string_view type);

/// A member function of `Driver` (or of what it is derived from) as a function for Python, run by run_exclusive().
template <class Driver, class Base, class Value, class... Parameters>
auto call(Value (Base::*function)(Parameters...)) {
    return [function](BoundDriver<Driver>& self, std::decay_t<Parameters>... parameters) {
        return run_exclusive(*self.world, [&] { return (self.driver.get()->*function)(parameters...); });
    };
}

}  // namespace motionrack::python
