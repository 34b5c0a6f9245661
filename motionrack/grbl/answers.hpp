// Output to a sender: answers, messages and alarms, as whole lines.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace motionrack::grbl {

class Answers {
  public:
    void put(std::string_view text) { out_ += text; }
    /// Answers a line: "ok", or "error:N".
    void answer(int error);
    /// Sends "[MSG:..]": ASCII only, without the characters that end a message.
    void push(std::string_view text);
    /// Sends "ALARM:N".
    void alarm(int number);
    /// Returns the pending output and clears it.
    std::string take() { return std::exchange(out_, {}); }

  private:
    std::string out_;
};

}  // namespace motionrack::grbl
