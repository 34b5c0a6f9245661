// Answers file requests of browsers on this computer.
#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <motionrack/frontends/server/listener.hpp>
#include <motionrack/frontends/server/origin_policy.hpp>
#include <motionrack/frontends/server/site_server.hpp>
#include <motionrack/frontends/server/socket.hpp>
#include <optional>

namespace motionrack::server {

namespace {

constexpr std::chrono::seconds max_wait{60};            ///< timeout of a head, and of sending an answer
constexpr std::chrono::milliseconds accept_pause{100};  ///< after an error, such as no free descriptor

/// State that all connections share.
struct Site {
    explicit Site(Page all) : page(std::move(all)) {}
    Page page;
    OriginPolicy guard{{}, {}};
    std::size_t connections = 0;
};

class SiteConnection final : public std::enable_shared_from_this<SiteConnection> {
  public:
    SiteConnection(asio::ip::tcp::socket socket, std::shared_ptr<Site> site)
        : stream_(std::move(socket)), site_(std::move(site)) {
        ++site_->connections;
    }
    ~SiteConnection() { --site_->connections; }
    SiteConnection(const SiteConnection&) = delete;
    SiteConnection& operator=(const SiteConnection&) = delete;

    void read_head() {
        parser_.emplace();
        stream_.tcp().expires_after(max_wait);
        http::async_read_header(stream_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
            if (!error) self->answer();
        });
    }

  private:
    void answer() {
        const Request& request = parser_->get();
        Peer peer;
        peer.address = peer.local = "127.0.0.1";
        peer.loopback = true;
        const RequestHead head = head_of(request, peer);
        const HttpAnswer one = answer_to(head);
        body_ = one.body;
        response_ = response_of(one, request.method() == http::verb::head, parser_->keep_alive() && parser_->is_done());
        stream_.tcp().expires_after(max_wait);
        http::async_write(stream_, *response_, [self = shared_from_this()](error_code error, std::size_t) {
            if (!error && self->response_->keep_alive()) self->read_head();
        });
    }

    HttpAnswer answer_to(const RequestHead& head) const {
        if (const std::string problem = site_->guard.problem(head); !problem.empty())
            return http_error(403, "denied", problem);
        const Result<RequestTarget> target = read_target(head.target);
        if (!target) return http_answer(panel::error_answer(target.error()));
        return file_answer(site_->page, head.method, target->path);
    }

    Transport stream_;
    std::shared_ptr<Site> site_;
    beast::flat_buffer buffer_{16 * 1024};
    std::optional<http::request_parser<http::string_body>> parser_;
    std::optional<Response> response_;
    std::shared_ptr<const std::string> body_;  ///< response_ points to it
};

}  // namespace

class SiteServer::Inside {
  public:
    explicit Inside(Page page) : site_(std::make_shared<Site>(std::move(page))) {}

    Result<void> open(std::uint16_t port) {
        MOTIONRACK_TRY(acceptor_, take_port(io_, asio::ip::make_address("127.0.0.1"), port));
        port_ = acceptor_.local_endpoint().port();
        accept();
        return {};
    }
    std::uint16_t port() const { return port_; }
    void serve_for(std::chrono::milliseconds time) { io_.run_for(time); }

  private:
    void accept() {
        acceptor_.async_accept([this](error_code error, asio::ip::tcp::socket socket) {
            if (error == asio::error::operation_aborted) return;
            if (error) return pause();
            if (site_->connections < max_connections)
                std::make_shared<SiteConnection>(std::move(socket), site_)->read_head();
            accept();
        });
    }
    void pause() {
        timer_.expires_after(accept_pause);
        timer_.async_wait([this](error_code error) {
            if (!error) accept();
        });
    }

    std::shared_ptr<Site> site_;
    asio::io_context io_{1};
    asio::ip::tcp::acceptor acceptor_{io_};
    asio::steady_timer timer_{io_};
    std::uint16_t port_ = 0;
};

SiteServer::SiteServer(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}

SiteServer::~SiteServer() = default;

Result<std::unique_ptr<SiteServer>> SiteServer::open(Page site, std::uint16_t port) {
    site.mount("", Page(site));
    auto inside = std::make_unique<Inside>(std::move(site));
    MOTIONRACK_CHECK(inside->open(port));
    return std::unique_ptr<SiteServer>(new SiteServer(std::move(inside)));
}

std::string SiteServer::url() const {
    return fmt::format("http://127.0.0.1:{}/", inside_->port());
}

void SiteServer::serve_for(std::chrono::milliseconds time) {
    inside_->serve_for(time);
}

}  // namespace motionrack::server
