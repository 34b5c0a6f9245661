// Commands of one RTC5 of a rack in Python: shared parts of its methods.
#pragma once

#include <motionrack/cards/rtc5/model/control_commands.hpp>
#include <motionrack/rack/rtc5_card.hpp>
#include <python/src/bindings.hpp>
#include <python/src/rack_lock.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::python {

/// Commands of one card. A query first takes `question_time` of simulated time, as the answer over the bus does.
struct Rtc5 {
    std::shared_ptr<RackHandle> world;
    rtc5::Card* card;  ///< nullptr: free_rtc5_dll
    Duration question_time = microseconds(10);
    std::uint32_t errors = 0, last_error = 0;  ///< error bits of the board

    rtc5::Engine& engine() const {
        if (card == nullptr) refuse("free_rtc5_dll released the card. Nothing was done; select_rtc takes one again.");
        return card->engine();
    }
};
using Rtc5Class = py::class_<Rtc5>;

/// Runs `call`; stores its error bits and rethrows.
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

/// Runs `call` with the engine; checks `refusal` if it fails.
template <class Call>
auto order(Rtc5& self, Call call, const rtc5::Refusal& refusal = rtc5::Refusal::parameter) {
    return keeping_error_bits(self, refusal,
                              [&] { return run_exclusive(*self.world, [&] { return call(self.engine()); }); });
}

/// As above, after the time of a query. `call` returns a Result.
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

/// Returns the positional and keyword arguments of a method in the order of `names`. Throws TypeError for an argument
/// that is not a number, and for an unknown, duplicate or missing keyword; the caller checks their number.
std::vector<double> numbers_given(std::string_view command, const std::vector<std::string_view>& names,
                                  const py::args& by_place, const py::kwargs& by_name);

/// "name(self: motionrack._core.Rtc5, No: int) -> int", for a method whose signature pybind11 does not know.
std::string signature(std::string_view name, const std::vector<std::string>& parameters, std::string_view answer);

/// Binds the control commands of the card's table, one method per row.
void bind_rtc5_controls(Rtc5Class& c);
/// Binds commands for cards, error bits and files, and those with other types than numbers.
void bind_rtc5_files(Rtc5Class& c);

}  // namespace motionrack::python
