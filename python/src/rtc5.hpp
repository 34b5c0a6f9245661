// The commands of one RTC5 of a rack in Python: what its methods share.
#pragma once

#include <motionrack/cards/rtc5/model/control_commands.hpp>
#include <motionrack/rack/rtc5_card.hpp>
#include <python/src/bindings.hpp>
#include <python/src/rack_lock.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::python {

/// The commands of one card. A question takes `question_time` of the rack's time first, as the answer over the bus
/// does.
struct Rtc5 {
    std::shared_ptr<RackHandle> world;
    rtc5::Card* card;  ///< nullptr: free_rtc5_dll
    Duration question_time = microseconds(10);
    std::uint32_t errors = 0, last_error = 0;  ///< the board's bits

    rtc5::Engine& engine() const {
        if (card == nullptr) refuse("free_rtc5_dll let the card go. Nothing was done; select_rtc takes one again.");
        return card->engine();
    }
};
using Rtc5Class = py::class_<Rtc5>;

/// Runs `call` and keeps the bits of its error, which goes on.
template <class Call>
auto keeping_error_bits(Rtc5& self, const rtc5::Refusal& refusal, Call call) {
    self.last_error = 0;
    try {
        return call();
    } catch (const PythonError& raised) {
        self.last_error = self.card == nullptr ? rtc5::error_bit("ACCESS_DENIED")
                                               : rtc5::error_bits_of(raised.error, refusal, self.card->engine());
        self.errors |= self.last_error;
        throw;
    }
}

/// `call` with the engine. `refusal` is looked at when it has failed.
template <class Call>
auto order(Rtc5& self, Call call, const rtc5::Refusal& refusal = rtc5::Refusal::parameter) {
    return keeping_error_bits(self, refusal,
                              [&] { return run_exclusive(*self.world, [&] { return call(self.engine()); }); });
}

/// The same after the time of a question. `call` gives a Result.
template <class Call>
auto ask(Rtc5& self, Call call, const rtc5::Refusal& refusal = rtc5::Refusal::parameter) {
    return keeping_error_bits(self, refusal, [&] {
        return run_exclusive(*self.world, [&]() -> decltype(call(self.engine())) {
            self.engine();
            MOTIONRACK_CHECK(self.world->advance(self.question_time));
            return call(self.engine());
        });
    });
}

/// The numbers that a method was given, by place or by name, in the order of `names`. Throws TypeError: one that is no
/// number, a name that is not there or given twice, one left out by name; how many there are is looked at later.
std::vector<double> numbers_given(std::string_view command, const std::vector<std::string_view>& names,
                                  const py::args& by_place, const py::kwargs& by_name);

/// "name(self: motionrack._core.Rtc5, No: int) -> int", for a method whose signature pybind11 does not know.
std::string signature(std::string_view name, const std::vector<std::string>& parameters, std::string_view answer);

/// The control commands of the card's table, one row, one method.
void bind_rtc5_controls(Rtc5Class& c);
/// Cards, error bits, files, and what takes or gives more than numbers.
void bind_rtc5_files(Rtc5Class& c);

}  // namespace motionrack::python
