// One call from Python into a rack: one thread at a time, without Python's lock while it runs, Ctrl-C heard between
// runs.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <python/src/raised.hpp>
#include <python/src/world.hpp>
#include <type_traits>
#include <utility>

namespace motionrack::python {

namespace py = pybind11;

/// While one lives its thread has the rack. Throws a refusal where another thread has it, or where this one is in the
/// middle of a run (a progress call); there it may only look.
class Turn {
  public:
    enum class For : std::uint8_t { looking, moving };
    Turn(World& world, For what);
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

  private:
    World& world_;
    bool mine_ = false;
};

/// Runs `call` without Python's lock; it gives a Result<T> or a plain value. `timeout`: a failure of the machine after
/// that time is a time-out. What Python raised meanwhile (KeyboardInterrupt, a progress call's exception) goes on.
template <class Call>
auto alone(World& world, Call call, Duration timeout = never);

/// The same for what only looks: it keeps Python's lock and may be called from a progress call.
template <class Call>
auto looking(World& world, Call call) {
    const Turn turn(world, Turn::For::looking);
    world.rack();
    return call();
}

/// Lets World ask Python between runs.
void attend(World& world);
/// What Python raised ends the run, and goes on when it has ended. With Python's lock.
void stop_because(World& world, py::error_already_set error);
/// Throws what Python raised while the world ran; the world goes on afterwards.
void raise_what_python_raised(World& world);

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
auto alone(World& world, Call call, Duration timeout) {
    using Value = decltype(call());
    const Turn turn(world, Turn::For::moving);
    const Instant began = world.now();
    if constexpr (std::is_void_v<Value>) {
        {
            const py::gil_scoped_release free;
            call();
        }
        raise_what_python_raised(world);
    } else {
        Value result = [&] {
            const py::gil_scoped_release free;
            return call();
        }();
        raise_what_python_raised(world);
        if constexpr (detail::is_result<Value>::value) {
            if (!result) {
                const bool machine = result.error().trouble == Trouble::machine;
                raise(std::move(result).error(), machine && timeout != never && world.now() - began >= timeout);
            }
            if constexpr (!std::is_void_v<typename Value::value_type>) return *std::move(result);
        } else {
            return result;
        }
    }
}

/// A driver with the world whose card it drives.
template <class Driver>
struct Driven {
    std::shared_ptr<World> world;
    std::unique_ptr<Driver> driver;
};

/// The card of that name, which must be of this type. Throws a refusal where it is another.
rack::Card& card_of_type(World& world, const std::string& name, std::string_view type);

/// A member function of `Driver` (or of what it is derived from) as a function for Python, run by alone().
template <class Driver, class Base, class Value, class... Parameters>
auto call(Value (Base::*function)(Parameters...)) {
    return [function](Driven<Driver>& self, std::decay_t<Parameters>... parameters) {
        return alone(*self.world, [&] { return (self.driver.get()->*function)(parameters...); });
    };
}

}  // namespace motionrack::python
