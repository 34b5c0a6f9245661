// The line between a port and one sender, on TCP or a pseudo-terminal.
#pragma once

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>
#include <boost/system/error_code.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace motionrack::server {

/// What a port says; `greets`: it begins with the banner for a new client, who is not to see what comes before it.
struct PortMessage {
    std::shared_ptr<const std::string> text;
    bool greets = false;
};

/// One end of a line to a client: reads while somebody listens to it, writes in order, and keeps so much for a client
/// that is slow.
template <class Stream>
class SenderLine : public std::enable_shared_from_this<SenderLine<Stream>> {
  public:
    SenderLine(Stream stream, std::size_t max_waiting) : stream_(std::move(stream)), max_waiting_(max_waiting) {}

    bool awaits_greeting = false;  ///< hears nothing before it

    std::function<void(std::string)> on_bytes;  ///< read_on() asks for more
    std::function<void()> on_end;

    void read_on() {
        stream_.async_read_some(boost::asio::buffer(in_),
                                [self = this->shared_from_this()](boost::system::error_code trouble, std::size_t got) {
                                    if (trouble) return self->end();
                                    if (self->on_bytes) self->on_bytes(std::string(self->in_.data(), got));
                                });
    }
    /// False: too much waits already.
    bool write(const PortMessage& said) {
        if (said.greets) awaits_greeting = false;
        if (awaits_greeting) return true;
        if (waiting_ + said.text->size() > max_waiting_) return false;
        waiting_ += said.text->size();
        out_.push_back(said.text);
        if (out_.size() == 1) write_on();
        return true;
    }
    /// Of what waits, only what is on its way.
    void forget_waiting() {
        if (out_.size() > 1) out_.erase(out_.begin() + 1, out_.end());
        waiting_ = out_.empty() ? 0 : out_.front()->size();
    }
    void end() {
        boost::system::error_code ignored;
        stream_.close(ignored);
        on_bytes = nullptr;
        if (const auto call = std::exchange(on_end, nullptr)) call();
    }

  private:
    void write_on() {
        boost::asio::async_write(stream_, boost::asio::buffer(*out_.front()),
                                 [self = this->shared_from_this()](boost::system::error_code trouble, std::size_t) {
                                     if (trouble) return self->end();
                                     self->waiting_ -= self->out_.front()->size();
                                     self->out_.pop_front();
                                     if (!self->out_.empty()) self->write_on();
                                 });
    }

    Stream stream_;
    std::size_t max_waiting_, waiting_ = 0;
    std::array<char, 65536> in_{};
    std::deque<std::shared_ptr<const std::string>> out_;
};

}  // namespace motionrack::server
