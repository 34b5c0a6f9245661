// Parts that all connections share: access rights, routes, limits. Independent of sockets and motion.
//
//  head ──admit──► an immediate answer (rejected, page, STOP)
//              └─► limit of the body ──handle──► the panel's answer
//
// Runs on the network thread, except post().
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <motionrack/auth/authenticator.hpp>
#include <motionrack/auth/control_lease.hpp>
#include <motionrack/auth/rate_limit.hpp>
#include <motionrack/frontends/server/http.hpp>
#include <motionrack/frontends/server/origin_policy.hpp>
#include <motionrack/frontends/server/page.hpp>
#include <motionrack/frontends/server/settings.hpp>
#include <motionrack/frontends/server/unknown_sender_log.hpp>
#include <motionrack/panel/operation_specs.hpp>
#include <motionrack/panel/panel.hpp>
#include <mutex>
#include <optional>
#include <string>

namespace motionrack::server {

/// Posts work to the network thread from any thread; ignored after the network has ended.
class NetworkExecutor {
  public:
    explicit NetworkExecutor(std::function<void(std::function<void()>)> post) : post_(std::move(post)) {}
    void operator()(std::function<void()> work) const {
        const std::lock_guard<std::mutex> alone(lock_);
        if (post_) post_(std::move(work));
    }
    void end() {
        const std::lock_guard<std::mutex> alone(lock_);
        post_ = nullptr;
    }

  private:
    mutable std::mutex lock_;
    std::function<void(std::function<void()>)> post_;
};

/// Result of checking the head of a request.
struct Admission {
    std::optional<HttpAnswer> answer;  ///< set: complete answer, the body is ignored
    std::size_t body_limit = 0;
    const panel::OperationSpec* row = nullptr;  ///< requested operation; nullptr: pairing
    panel::Caller caller;
};

bool is_query(const panel::OperationSpec& row);

class PanelService {
  public:
    PanelService(ServerSettings settings, panel::Panel& panel, auth::Authenticator& door, auth::ControlLease& lease,
                 Page page, std::shared_ptr<NetworkExecutor> post);

    // ---- HTTP
    /// Checks the head of a request. Answers it (rejected, page, STOP), or admits its body.
    Admission admit(const RequestHead& head);
    /// Executes an admitted request; `reply` is called once, on the network thread.
    void handle(const RequestHead& head, const Admission& admission, const std::string& body,
                std::function<void(HttpAnswer)> reply);
    /// Returns nothing if the head may become a WebSocket, else the answer.
    std::optional<HttpAnswer> refuse_stream(const RequestHead& head);

    // ---- WebSocket
    /// Forwards an operation to the panel; `reply` is called once, on the network thread. Audited unless it is a query.
    void ask(panel::Caller caller, const std::string& address, const panel::OperationSpec& row,
             const nlohmann::json& fields, std::function<void(panel::Answer)> reply);
    /// Executes STOP. Never rejected, never limited.
    void stop(panel::Caller caller, const std::string& address);
    /// Handles the end of a connection.
    void left(const std::string& session);
    /// Role of a client without a token.
    auth::Role role_without_token(const Peer& peer) const {
        return peer.loopback ? settings_.loopback_role : auth::Role::none;
    }
    auth::AuthResult<auth::Identity> authenticate(const std::string& token, const Peer& peer);

    /// `is_known`: the client was authenticated, or the server needs no token; others may write only a limited number
    /// of audit entries.
    void audit(const std::string& user, const std::string& address, std::string what, const panel::Answer& answer,
               bool is_known);
    /// Writes due summaries of unauthenticated clients to the audit. The server calls it every 5 ms.
    void tick() { unknown_senders_.tick(now().steady); }
    const ServerSettings& settings() const { return settings_; }
    auth::Timestamps now() const { return settings_.clock(); }
    panel::Panel& panel() { return panel_; }
    auth::Authenticator& door() { return door_; }
    auth::ControlLease& lease() { return lease_; }
    const std::shared_ptr<NetworkExecutor>& post() const { return post_; }

  private:
    std::optional<HttpAnswer> refuse(const RequestHead& head);
    /// Returns true for a client with a token, and for all of this computer on a server without authentication.
    static bool is_known(const panel::Caller& caller) {
        return !caller.user.empty() || caller.role == auth::Role::maintain;
    }
    Admission admit_api(const RequestHead& head, const RequestTarget& target);
    HttpAnswer pair(const RequestHead& head, const std::string& body);
    HttpAnswer forget(const RequestHead& head);

    ServerSettings settings_;
    panel::Panel& panel_;
    auth::Authenticator& door_;
    auth::ControlLease& lease_;
    Page page_;
    OriginPolicy guard_;
    std::shared_ptr<NetworkExecutor> post_;
    auth::RateLimit requests_, reported_;
    UnknownSenderLog unknown_senders_;
    std::string openapi_;
};

}  // namespace motionrack::server
