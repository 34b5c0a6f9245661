// One WebSocket client: its messages, its subscriptions and its send queue.
//
//  message ─► token, subscribe, command, query ─► answers ─┐
//  tick ─► snapshot, unless two are queued (then one is lost) ─┼─► [ queue ] ─► MessageSink::write, one by one
//  event ──────────────────────────────────────────────────┘      queue too long: closes the client
//
// Runs on the network thread.
#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <motionrack/frontends/server/service.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace motionrack::server {

/// A text message in two parts: one for this client, and one that many clients share.
struct OutgoingMessage {
    std::string own;
    std::shared_ptr<const std::string> shared;
    bool picture = false;  ///< a snapshot
};

/// Connection below a client.
class MessageSink {
  public:
    virtual ~MessageSink() = default;
    /// Sends one message. The message must not change until Client::written().
    virtual void write(const OutgoingMessage& message) = 0;
    /// Sets the maximum size of incoming messages from now on.
    virtual void allow(std::size_t bytes) = 0;
    /// Closes the WebSocket with a status code (RFC 6455) and a reason.
    virtual void close(int code, std::string_view reason) = 0;
};

class Client : public std::enable_shared_from_this<Client> {
  public:
    using Time = std::chrono::steady_clock::time_point;

    Client(PanelService& service, Peer peer, std::string session, MessageSink& wire);

    // ---- from the connection
    void opened();
    void message(std::string_view text, bool is_text);
    void written();
    /// Ends the session; call it after the connection has closed.
    void closed();

    // ---- from Clients
    /// Returns true if a snapshot is due and the queue has room for it. Counts each skipped snapshot as lost.
    bool due(Time now);
    const std::shared_ptr<panel::ChannelSet>& channels() const { return channels_; }
    void send_picture(std::shared_ptr<const std::string> rest);
    void send_event(std::shared_ptr<const std::string> text);
    /// Checks for expired and revoked tokens; closes clients that have sent no token.
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
    /// Sets the maximum message size for a role; operators may send whole programs.
    void allow_for(auth::Role role);
    void subscribe(const Request& request);
    void ask(const Request& request, const std::string& name, bool query);
    void answer(const nlohmann::json& id, panel::Answer answer);
    void refuse(const nlohmann::json& id, int status, std::string_view trouble, std::string sentence);
    void send(OutgoingMessage message);

    PanelService& service_;
    Peer peer_;
    std::string session_, user_, token_id_;
    MessageSink* wire_;
    auth::RateLimit messages_;
    std::size_t asks_ = 0;
    // subscriptions
    std::shared_ptr<panel::ChannelSet> channels_;
    std::int64_t newest_subscription_ = 0;
    std::chrono::nanoseconds period_;
    Time next_, opened_at_, looked_after_;
    std::int64_t periods_ = 0, lost_ = 0;
    // send queue
    std::deque<OutgoingMessage> queue_;
    std::size_t pictures_ = 0;
    bool leaving_ = false;
    bool seen_ = false;  ///< the client has had a role
};

}  // namespace motionrack::server
