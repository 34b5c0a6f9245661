// One connection to the server of a machine without a port: a socket pair whose other end belongs to the target. The
// machine, the network and the target take turns on one thread.
//
//   target ──send──► [ socket pair ] ──► Connection ──► Service ──► Panel ──► Machine::run
//          ◄─received────────────────────────────────────────────────────┘     │ every slice: network, then `step`
#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <charconv>
#include <chrono>
#include <functional>
#include <memory>
#include <motionrack/frontends/server/socket.hpp>
#include <motionrack/frontends/server/user_commands.hpp>
#include <motionrack/rack/config.hpp>
#include <string>
#include <string_view>
#include <tests/fuzz/require.hpp>
#include <thread>
#include <utility>

namespace motionrack::fuzz {

class ServedConnection {
  public:
    /// Timeout for work of another thread.
    static constexpr std::chrono::seconds max_wait{8};

    ServedConnection() {
        operate::MachineSettings settings;
        settings.pace = [this](Instant) {
            turn();
            return true;
        };
        machine_ = *operate::Machine::make(config(), std::move(settings));
        auth::AuthSettings door;
        door.on_start_code = [](const std::string&) {};
        door_ = *auth::Authenticator::open(std::move(door));
        token_ = door_->pair(door_->start_code(), "anna", "127.0.0.1", now())->token;
        users_ = door_->users().size();
        panel::PanelSettings panel;
        panel.external = server::door_orders(*door_);
        panel_ = std::make_unique<panel::Panel>(*machine_, lease_, std::move(panel));
        post_ = std::make_shared<server::NetworkExecutor>(
            [this](std::function<void()> work) { boost::asio::post(*io_, std::move(work)); });
        pool_ = std::make_shared<server::ConnectionPool>(
            std::make_shared<server::PanelService>(server_settings(), *panel_, *door_, lease_, server::Page(), post_));
        history_ = machine_->rack().kernel().trace_hash();
        connect();
    }
    ~ServedConnection() {
        ::close(end_);
        for (int i = 0; i < 20; ++i) poll();
        pool_->open_connections.end_all("The target ends.");
        poll();
        post_->end();
        pool_.reset();
    }
    ServedConnection(const ServedConnection&) = delete;
    ServedConnection& operator=(const ServedConnection&) = delete;

    /// Lets all take turns until `step` returns false; returns false on a timeout.
    bool run(std::function<bool()> step) {
        step_ = std::move(step);
        until_ = std::chrono::steady_clock::now() + max_wait;
        is_over_ = false;
        machine_->run();
        return !is_over_;
    }
    void send(std::string_view bytes) { unsent_ += bytes; }
    /// Ends sending after the queued bytes.
    void end_sending() { ends_ = true; }
    bool has_sent() const { return unsent_.empty(); }
    /// All bytes received.
    const std::string& received() const { return received_; }
    /// Returns true if the server has closed the connection.
    bool has_ended() const { return has_ended_; }
    /// Token of a user with all rights.
    const std::string& token() const { return token_; }

    /// An unauthenticated client has changed nothing, except that the machine may have stopped.
    void require_untouched() const {
        const operate::Status& status = machine_->status();
        const bool is_stopped = status.state == operate::MachineState::error_stop;
        require(is_stopped || status.state == operate::MachineState::disabled, "a stranger can do no more than stop");
        for (const operate::AxisStatus& axis : status.axes)
            require(!axis.enabled && axis.pulses == 0, "a stranger moves no axis");
        require(is_stopped || machine_->rack().kernel().trace_hash() == history_, "a stranger changes no wire");
        require(!lease_.holder(), "a stranger takes no control");
        require(door_->users().size() == users_, "a stranger pairs nobody and unpairs nobody");
    }

  private:
    static const rack::RackConfig& config() {
        static const rack::RackConfig one =
            *rack::read_rack_text(
                 "[card.m]\ntype = \"mcx314\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n"
                 "[axis.Y]\ncard = \"m\"\nchannel = \"y\"\n")
                 .config;
        return one;
    }
    server::ServerSettings server_settings() {
        server::ServerSettings out;
        out.limits.requests_at_once = out.limits.messages_at_once = 1e9;
        out.clock = [this] { return now(); };
        return out;
    }
    auth::Timestamps now() const { return {auth::WallTime(passed_), std::chrono::steady_clock::time_point(passed_)}; }
    void connect() {
        int ends[2] = {};
        require(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0, "a pair of sockets can be made");
        end_ = ends[0];
        require(::fcntl(end_, F_SETFL, O_NONBLOCK) == 0, "a socket need not wait");
        boost::asio::ip::tcp::socket socket(*io_);
        socket.assign(boost::asio::ip::tcp::v4(), ends[1]);
        server::Peer peer;
        peer.address = peer.local = peer.network = "127.0.0.1";
        peer.loopback = true;
        server::serve(server::Transport(std::move(socket)), std::move(peer), pool_);
    }

    void poll() {
        io_->restart();
        io_->poll();
    }
    /// Returns true if bytes were sent or received.
    bool exchange() {
        const std::size_t before = unsent_.size() + received_.size();
        const ssize_t sent = unsent_.empty() ? 0 : ::send(end_, unsent_.data(), unsent_.size(), MSG_NOSIGNAL);
        if (sent > 0) unsent_.erase(0, static_cast<std::size_t>(sent));
        if (sent < 0 && errno != EAGAIN) unsent_.clear();  // the server has closed the connection
        if (unsent_.empty() && std::exchange(ends_, false)) ::shutdown(end_, SHUT_WR);
        poll();
        char bytes[65536];
        for (ssize_t some = 0; (some = ::recv(end_, bytes, sizeof bytes, 0)) >= 0;) {
            has_ended_ = some == 0;
            if (has_ended_) break;
            received_.append(bytes, static_cast<std::size_t>(some));
        }
        return unsent_.size() + received_.size() != before;
    }
    void turn() {
        if (!step_) return;
        passed_ += std::chrono::milliseconds(2);
        pool_->service->tick();
        pool_->clients.tick();
        idle_ = exchange() ? 0 : idle_ + 1;
        if (idle_ > 20) std::this_thread::sleep_for(std::chrono::microseconds(100));
        is_over_ = std::chrono::steady_clock::now() > until_;
        if (step_() && !is_over_) return;
        step_ = nullptr;
        machine_->quit();
    }

    auth::ControlLease lease_;
    std::unique_ptr<operate::Machine> machine_;
    std::unique_ptr<auth::Authenticator> door_;
    std::unique_ptr<panel::Panel> panel_;
    std::unique_ptr<boost::asio::io_context> io_ = std::make_unique<boost::asio::io_context>(1);
    std::shared_ptr<server::NetworkExecutor> post_;
    std::shared_ptr<server::ConnectionPool> pool_;
    std::function<bool()> step_;
    std::chrono::steady_clock::time_point until_;
    std::chrono::nanoseconds passed_ = std::chrono::hours(500'000);  ///< time on the clocks seen by the server
    std::string token_, unsent_, received_;
    std::size_t users_ = 0;
    std::uint64_t history_ = 0;
    int end_ = -1, idle_ = 0;
    bool ends_ = false, has_ended_ = false, is_over_ = false;
};

/// An HTTP answer as received.
struct WebAnswer {
    int status = 0;
    std::string head, body;
    bool closes = false;
    bool has(std::string_view field) const { return head.find(field) != std::string::npos; }
};

/// Removes the next answer from the received bytes. Returns false if it is incomplete. `head_only`: answers a HEAD
/// request.
inline bool take_answer(std::string_view& came, bool head_only, WebAnswer& out) {
    const std::size_t end = came.find("\r\n\r\n");
    if (end == std::string_view::npos) return false;
    out.head = came.substr(0, end + 2);
    require(out.head.starts_with("HTTP/1.1 ") && out.head.size() > 13 && out.head[12] == ' ',
            "an answer begins with its status", out.head.substr(0, 100));
    const auto [stop, error] = std::from_chars(out.head.data() + 9, out.head.data() + 12, out.status);
    require(error == std::errc() && stop == out.head.data() + 12 && out.status >= 100 && out.status < 600,
            "a status is a number", out.head.substr(0, 100));
    out.closes = out.has("\r\nConnection: close\r\n");
    std::size_t size = 0;
    if (out.status >= 200) {
        constexpr std::string_view name = "\r\nContent-Length: ";
        const std::size_t at = out.head.find(name);
        require(at != std::string::npos, "an answer says how long it is", out.head);
        std::from_chars(out.head.data() + at + name.size(), out.head.data() + out.head.size(), size);
    }
    if (head_only) size = 0;
    if (came.size() < end + 4 + size) return false;
    out.body = came.substr(end + 4, size);
    came.remove_prefix(end + 4 + size);
    if (out.status < 400 || head_only) return true;
    const nlohmann::json body = nlohmann::json::parse(out.body, nullptr, false);
    require(body.is_object() && body.contains("error") && body["error"].contains("message") &&
                body["error"]["message"].get<std::string>().size() > 10,
            "a refusal is a sentence in JSON", out.body);
    return true;
}

}  // namespace motionrack::fuzz
