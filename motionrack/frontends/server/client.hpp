// One WebSocket client: what it says, what it looks at, what waits to be sent to it.
//
//   message ─► token, subscribe, order, query ─► answers ─┐
//   tick ─► picture, unless two wait already (then one more is lost) ─┼─► [ queue ] ─► MessageSink::write, one by one
//   event ────────────────────────────────────────────────┘      too long a queue: the client is let go
//
// The network thread's.
#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <motionrack/frontends/server/service.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace motionrack::server {

/// A text message in two pieces: one of this client's own, and one that many share.
struct Outgoing {
    std::string own;
    std::shared_ptr<const std::string> shared;
    bool picture = false;
};

/// The connection below a client.
class MessageSink {
  public:
    virtual ~MessageSink() = default;
    /// Sends one message, which stays as it is until Client::written().
    virtual void write(const Outgoing& message) = 0;
    /// From now on messages that come in may be so long.
    virtual void allow(std::size_t bytes) = 0;
    /// Says close_with_reason with a code of RFC 6455 and a reason.
    virtual void close(int code, std::string_view reason) = 0;
};

class Client : public std::enable_shared_from_this<Client> {
  public:
    using Time = std::chrono::steady_clock::time_point;

    Client(Service& service, Peer peer, std::string session, MessageSink& wire);

    // ---- from the connection
    void opened();
    void message(std::string_view text, bool is_text);
    void written();
    /// The wire is gone.
    void closed();

    // ---- from Clients
    /// Whether a picture is due; it is then counted as sent or lost, and true means to send it.
    bool due(Time now);
    const std::shared_ptr<panel::ChannelSet>& channels() const { return channels_; }
    void send_picture(std::shared_ptr<const std::string> rest);
    void send_event(std::shared_ptr<const std::string> text);
    /// What time brings: tokens expire, or are revoked; who says no token goes.
    void check_session(Time now);
    void close_with_reason(int code, std::string_view reason);

  private:
    struct Request {
        nlohmann::json id;
        nlohmann::json fields;
    };
    auth::Role role() const;
    panel::Caller caller() const { return {user_, role(), session_}; }
    void token(const Request& request);
    /// Who may operate may send whole programs.
    void allow_for(auth::Role role);
    void subscribe(const Request& request);
    void ask(const Request& request, const std::string& name, bool query);
    void answer(const nlohmann::json& id, panel::Answer answer);
    void refuse(const nlohmann::json& id, int status, std::string_view trouble, std::string sentence);
    void send(Outgoing message);

    Service& service_;
    Peer peer_;
    std::string session_, user_, token_id_;
    MessageSink* wire_;
    auth::RateLimit messages_;
    std::size_t asks_ = 0;
    // what it looks at
    std::shared_ptr<panel::ChannelSet> channels_;
    std::int64_t newest_subscription_ = 0;
    std::chrono::nanoseconds period_;
    Time next_, opened_at_, looked_after_;
    std::int64_t periods_ = 0, lost_ = 0;
    // what waits
    std::deque<Outgoing> queue_;
    std::size_t pictures_ = 0;
    bool leaving_ = false;
    bool seen_ = false;  ///< it has had a role
};

}  // namespace motionrack::server
