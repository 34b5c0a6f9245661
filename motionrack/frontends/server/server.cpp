// Opens the port, runs the network thread and shuts down.
#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/context.hpp>
#include <motionrack/auth/private_files.hpp>
#include <motionrack/frontends/server/listener.hpp>
#include <motionrack/frontends/server/server.hpp>
#include <thread>

namespace motionrack::server {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

constexpr std::chrono::seconds close_timeout{1};

Result<std::unique_ptr<asio::ssl::context>> read_tls(const TlsFiles& files) {
    MOTIONRACK_CHECK(auth::check_readers(files.key, "The key"));
    auto tls = std::make_unique<asio::ssl::context>(asio::ssl::context::tls_server);
    error_code error;
    ::SSL_CTX_set_min_proto_version(tls->native_handle(), TLS1_2_VERSION);
    // Clients cannot fill the memory: sessions are stored by the clients (tickets), idle connections release their
    // buffers.
    ::SSL_CTX_set_session_cache_mode(tls->native_handle(), SSL_SESS_CACHE_OFF);
    ::SSL_CTX_set_mode(tls->native_handle(), SSL_MODE_RELEASE_BUFFERS);
    tls->use_certificate_chain_file(files.certificate, error);
    if (error)
        return fail(
            ErrorKind::io,
            fmt::format("The certificate cannot be used: {}. It is a PEM file, yours first. Nothing was started.",
                        error.message()),
            {}, files.certificate);
    tls->use_private_key_file(files.key, asio::ssl::context::pem, error);
    if (error)
        return fail(ErrorKind::io,
                    fmt::format("The key cannot be used, or is not that of the certificate: {}. It is a PEM file "
                                "without a password. Nothing was started.",
                                error.message()),
                    {}, files.key);
    return tls;
}

}  // namespace

class Server::Inside {
  public:
    Inside(ServerSettings settings, panel::Panel& panel, auth::Authenticator& door, auth::ControlLease& lease,
           Page page)
        : post_(std::make_shared<NetworkExecutor>(
              [this](std::function<void()> work) { asio::post(io_, std::move(work)); })),
          pool_(std::make_shared<ConnectionPool>(
              std::make_shared<PanelService>(std::move(settings), panel, door, lease, std::move(page), post_))) {}
    ~Inside() { stop(); }

    Result<void> open() {
        const ServerSettings& settings = this->settings();
        error_code error;
        const asio::ip::address address = asio::ip::make_address(settings.address, error);
        if (error)
            return fail(ErrorKind::invalid_input,
                        fmt::format("\"{}\" is not an IPv4 or IPv6 address. Nothing was started.", settings.address));
        if (!address.is_loopback() && !settings.tls)
            return fail(ErrorKind::refused,
                        fmt::format("{} can be reached from other computers, which requires TLS. Nothing was started; "
                                    "add --tls-cert and --tls-key, or serve 127.0.0.1.",
                                    settings.address));
        std::unique_ptr<asio::ssl::context> tls;
        if (settings.tls) {
            MOTIONRACK_TRY(tls, read_tls(*settings.tls));
        }
        MOTIONRACK_TRY(tcp::acceptor acceptor, take_port(io_, address, settings.port));
        port_ = acceptor.local_endpoint().port();
        listener_ = std::make_unique<PortListener>(io_, pool_, std::move(acceptor), std::move(tls));
        pool_->service->panel().on_event(
            [post = post_, pool = std::weak_ptr<ConnectionPool>(pool_)](const panel::Event& event) {
                (*post)([pool, event] {
                    if (const auto there = pool.lock()) there->clients.notify(event);
                });
            });
        listener_->begin();
        thread_ = std::thread([this] { io_.run(); });
        return {};
    }

    void stop() {
        if (!thread_.joinable()) return;
        stopped_ = std::chrono::steady_clock::now();
        asio::post(io_, [this] {
            listener_->end();
            wait_for_the_last();
        });
        thread_.join();
        post_->end();
    }

    const ServerSettings& settings() const { return pool_->service->settings(); }
    std::uint16_t port() const { return port_; }
    std::int64_t clients() const { return pool_->clients.count(); }

  private:
    /// Ends the network thread when all connections are closed, after 1 s at most; checks every 5 ms.
    void wait_for_the_last() {
        if (listener_->empty() || std::chrono::steady_clock::now() - stopped_ > close_timeout) return io_.stop();
        goodbye_.expires_after(std::chrono::milliseconds(5));
        goodbye_.async_wait([this](error_code) { wait_for_the_last(); });
    }

    asio::io_context io_{1};
    std::shared_ptr<NetworkExecutor> post_;
    std::shared_ptr<ConnectionPool> pool_;
    std::unique_ptr<PortListener> listener_;
    asio::steady_timer goodbye_{io_};
    std::chrono::steady_clock::time_point stopped_;
    std::uint16_t port_ = 0;
    std::thread thread_;
};

Server::Server(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}

Server::~Server() = default;

Result<std::unique_ptr<Server>> Server::open(ServerSettings settings, panel::Panel& panel, auth::Authenticator& door,
                                             auth::ControlLease& lease, Page page) {
    auto inside = std::make_unique<Inside>(std::move(settings), panel, door, lease, std::move(page));
    MOTIONRACK_CHECK(inside->open());
    return std::unique_ptr<Server>(new Server(std::move(inside)));
}

void Server::stop() {
    inside_->stop();
}

std::uint16_t Server::port() const {
    return inside_->port();
}

std::string Server::url() const {
    const ServerSettings& settings = inside_->settings();
    const bool six = settings.address.find(':') != std::string::npos;
    return fmt::format("{}://{}:{}/", settings.tls ? "https" : "http",
                       six ? fmt::format("[{}]", settings.address) : settings.address, port());
}

std::int64_t Server::clients() const {
    return inside_->clients();
}

}  // namespace motionrack::server
