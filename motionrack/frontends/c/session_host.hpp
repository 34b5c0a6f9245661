// Time of a rack for a function library behind the C interface: while it passes, recordings are sampled and conditions
// reported.
#pragma once

#include <motionrack/base/port.hpp>
#include <motionrack/rack/session.hpp>
#include <optional>
#include <string_view>

namespace motionrack::c {

/// Clock and interrupt of a card as seen by a program with the rack; stores the first error.
class SessionHost : public Interrupt {
  public:
    /// `session` and the text of `card` must outlive the object.
    SessionHost(rack::Session& session, std::string_view card) : session_(session), card_(card) {}

    bool wait(Duration timeout) override {
        const auto active = keep(session_.wait(card_, static_cast<std::uint64_t>(timeout.count() + 9) / 10));
        return active && *active;
    }
    void pass(Duration duration) override {
        keep(session_.advance(static_cast<std::uint64_t>(duration.count() + 9) / 10));
    }
    Instant now() const override { return session_.rack().kernel().now(); }
    /// Stops waiting after an error.
    bool stop_requested() const override { return error_.has_value(); }
    const std::optional<Error>& error() const { return error_; }
    void forget_error() { error_.reset(); }

  protected:
    template <class Value>
    Result<Value> keep(Result<Value> result) {
        if (!result && !error_) error_ = result.error();
        return result;
    }

    rack::Session& session_;
    std::string_view card_;

  private:
    std::optional<Error> error_;
};

}  // namespace motionrack::c
