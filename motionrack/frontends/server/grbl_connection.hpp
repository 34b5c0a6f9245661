// Connection between a port and one sender, over TCP or a pseudo-terminal.
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

/// Output of a port. `greets`: starts with the banner for a new client, which must not receive earlier output.
struct PortMessage {
    std::shared_ptr<const std::string> text;
    bool greets = false;
};

/// One end of a connection to a client: reads while a reader is attached, writes in order, buffers a bounded amount for
/// slow clients.
template <class Stream>
class GrblConnection : public std::enable_shared_from_this<GrblConnection<Stream>> {
  public:
    GrblConnection(Stream stream, std::size_t max_waiting) : stream_(std::move(stream)), max_waiting_(max_waiting) {}

    bool awaits_greeting = false;  ///< discards output before the banner

    std::function<void(std::string)> on_bytes;  ///< receives the bytes of one read; call read_on() for the next
    std::function<void()> on_end;

    void read_on() {
        stream_.async_read_some(boost::asio::buffer(in_),
                                [self = this->shared_from_this()](boost::system::error_code trouble, std::size_t got) {
                                    if (trouble) return self->end();
                                    if (self->on_bytes) self->on_bytes(std::string(self->in_.data(), got));
                                });
    }
    /// Queues output, or discards it before the banner. Returns false, without queueing, if the buffer is full.
    bool write(const PortMessage& said) {
        if (said.greets) awaits_greeting = false;
        if (awaits_greeting) return true;
        if (waiting_ + said.text->size() > max_waiting_) return false;
        waiting_ += said.text->size();
        out_.push_back(said.text);
        if (out_.size() == 1) write_on();
        return true;
    }
    /// Discards the queued output, except the write in progress.
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
