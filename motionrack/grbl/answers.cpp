#include <fmt/format.h>

#include <motionrack/grbl/answers.hpp>
#include <motionrack/grbl/numbers.hpp>

namespace motionrack::grbl {

void Answers::answer(int error) {
    put(error == error_none ? std::string("ok\r\n") : fmt::format("error:{}\r\n", error));
}

void Answers::push(std::string_view text) {
    put("[MSG:");
    for (const char c : text) out_ += c >= ' ' && c <= '~' && c != '[' && c != ']' ? c : '?';
    put("]\r\n");
}

void Answers::alarm(int number) {
    put(fmt::format("ALARM:{}\r\n", number));
}

}  // namespace motionrack::grbl
