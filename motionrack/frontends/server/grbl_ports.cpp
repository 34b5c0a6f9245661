#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <motionrack/auth/rate_limit.hpp>
#include <motionrack/frontends/server/grbl_connection.hpp>
#include <motionrack/frontends/server/grbl_ports.hpp>
#include <motionrack/frontends/server/pseudo_terminal.hpp>
#include <motionrack/frontends/server/sender_port.hpp>
#include <motionrack/grbl/input_parser.hpp>
#include <motionrack/grbl/introduction.hpp>
#include <mutex>
#include <thread>
#include <vector>

namespace motionrack::server {

namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

using TcpLine = GrblConnection<tcp::socket>;
using TerminalLine = GrblConnection<asio::posix::stream_descriptor>;

/// A client connected by TCP.
struct Visitor {
    std::shared_ptr<TcpLine> line;
    std::string address;
    std::chrono::steady_clock::time_point since;
    grbl::Introduction introduction;
    bool is_sender = false;    ///< identified as a sender
    bool within_line = false;  ///< part of the last line was ignored: its rest must not be executed

    /// Notes whether ignored bytes end within a line.
    void ignore(const std::string& bytes) {
        for (const char c : bytes)
            if (ends_line(c))
                within_line = false;
            else if (static_cast<unsigned char>(c) < 0x80 && !is_realtime(c))
                within_line = true;
    }
    /// Removes the rest of a partly ignored line from the bytes; keeps its real-time bytes.
    void drop_rest_of_line(std::string& bytes) {
        std::string kept;
        std::size_t at = 0;
        for (; within_line && at < bytes.size(); ++at) {
            within_line = !ends_line(bytes[at]);
            if (is_realtime(bytes[at])) kept += bytes[at];
        }
        if (at > 0 && bytes.compare(at - 1, 2, "\r\n") == 0) ++at;
        bytes.replace(0, at, kept);
    }

  private:
    static bool is_realtime(char c) { return grbl::realtime_of(static_cast<std::uint8_t>(c)).has_value(); }
    /// A reset (0x18) ends the line in which it is received.
    static bool ends_line(char c) { return c == '\n' || c == '\r' || c == '\x18'; }
};

}  // namespace

/// Runs on the network thread, except construction, port() and sender().
class GrblPorts::Inside {
  public:
    Inside(const GrblPortSettings& settings, operate::Machine& machine, auth::ControlLease& lease)
        : settings_(settings), machine_(machine), lease_(lease) {}
    ~Inside() {
        io_->stop();
        if (thread_.joinable()) thread_.join();
    }

    Result<void> open() {
        if (settings_.port) MOTIONRACK_CHECK(open_tcp(*settings_.port));
        if (!settings_.link.empty()) MOTIONRACK_CHECK(open_terminal());
        thread_ = std::thread([io = io_] { io->run(); });
        return {};
    }
    std::uint16_t port() const { return port_number_; }
    std::string sender() const {
        const std::lock_guard<std::mutex> alone(lock_);
        std::string out = tcp_sender_;
        if (terminal_sender_) out += out.empty() ? "pty" : ", pty";
        return out.empty() ? "none" : out;
    }

  private:
    /// Makes a port. The motion thread, which may outlive this object, posts its output to the network thread.
    std::shared_ptr<SenderPort> make_port(std::function<void(const PortMessage&)> send) {
        auto port = std::make_shared<SenderPort>(machine_, lease_, settings_);
        port->send = [io = io_, send = std::move(send)](PortMessage said) {
            asio::post(*io, [send, said = std::move(said)] { send(said); });
        };
        machine_.listen([port](const operate::Status&) { port->tick(); },
                        [port](const operate::StopReport& report) { port->stopped(report); });
        return port;
    }
    /// Returns a function that resumes reading; the motion thread calls it after it has processed the input.
    template <class Connection>
    std::function<void()> reading_on(const std::shared_ptr<Connection>& connection) {
        return [io = io_, connection = std::weak_ptr<Connection>(connection)] {
            asio::post(*io, [connection] {
                if (const auto there = connection.lock(); there && there->on_bytes) there->read_on();
            });
        };
    }

    // ---- TCP
    Result<void> open_tcp(std::uint16_t port) {
        const tcp::endpoint place(asio::ip::address_v4::loopback(), port);
        error_code trouble;
        acceptor_.open(place.protocol(), trouble);
        if (!trouble) acceptor_.set_option(tcp::acceptor::reuse_address(true), trouble);
        if (!trouble) acceptor_.bind(place, trouble);
        if (!trouble) acceptor_.listen(16, trouble);
        if (trouble)
            return fail(ErrorKind::io, fmt::format("The Grbl port 127.0.0.1:{} was not opened: {}. Choose another "
                                                   "port, or end the program that uses it.",
                                                   port, trouble.message()));
        port_number_ = acceptor_.local_endpoint().port();
        tcp_port_ = make_port([this](const PortMessage& said) { broadcast(said); });
        accept_on();
        return {};
    }
    void accept_on() {
        acceptor_.async_accept([this](error_code trouble, tcp::socket socket) {
            if (trouble == asio::error::operation_aborted) return;
            if (!trouble) {
                accept(std::move(socket));
                return accept_on();
            }
            // Probably out of file descriptors: retry later.
            pause_.expires_after(std::chrono::milliseconds(50));
            pause_.async_wait([this](error_code stopped) {
                if (!stopped) accept_on();
            });
        });
    }
    void accept(tcp::socket socket) {
        error_code trouble;
        const tcp::endpoint from = socket.remote_endpoint(trouble);
        if (trouble || !close_idle()) return;
        socket.set_option(tcp::no_delay(true), trouble);
        auto visitor = std::make_shared<Visitor>();
        visitor->line = std::make_shared<TcpLine>(std::move(socket), settings_.waiting);
        visitor->address = fmt::format("{}:{}", from.address().to_string(), from.port());
        visitor->since = std::chrono::steady_clock::now();
        visitors_.push_back(visitor);
        visitor->line->on_end = [this, raw = visitor.get()] { gone(raw); };
        visitor->line->on_bytes = [this, raw = visitor.get()](std::string bytes) { received(*raw, std::move(bytes)); };
        if (writer_ == nullptr)
            let_write(*visitor);
        else
            let_look_on(*visitor);
        visitor->line->read_on();
    }
    /// If the port is full, closes the oldest visitor that has not identified as a sender. Returns false if all have.
    bool close_idle() {
        if (visitors_.size() <= settings_.observers) return true;
        const auto oldest =
            std::find_if(visitors_.begin(), visitors_.end(), [](const auto& visitor) { return !visitor->is_sender; });
        if (oldest == visitors_.end()) return false;
        const auto line = (*oldest)->line;
        line->end();
        return true;
    }
    /// Processes input; it has no effect before the client has identified as a sender.
    void received(Visitor& visitor, std::string bytes) {
        using Verdict = grbl::Introduction::Verdict;
        const bool known = visitor.is_sender;
        if (!known) {
            const Verdict verdict = visitor.introduction.receive(bytes);
            if (verdict == Verdict::stranger) return turn_away(visitor);
            if (verdict == Verdict::open) return visitor.line->read_on();
            visitor.is_sender = true;
            bytes = visitor.introduction.take_bytes();
        }
        if (is_held_in_silence() || (writer_ == nullptr && !known)) let_write(visitor);
        if (writer_ == &visitor)
            visitor.drop_rest_of_line(bytes);
        else
            visitor.ignore(bytes);
        tcp_port_->receive(std::move(bytes), &visitor == writer_, visitor.address, reading_on(visitor.line));
    }
    /// True while the writer is a connection that has not spoken as a sender for too long.
    bool is_held_in_silence() const {
        return writer_ != nullptr && !writer_->is_sender &&
               std::chrono::steady_clock::now() - writer_->since >= settings_.silence;
    }
    void turn_away(Visitor& visitor) {
        if (settings_.on_unknown_sender && unknown_senders_.take("", std::chrono::steady_clock::now()))
            settings_.on_unknown_sender(visitor.address);
        const auto line = visitor.line;  // kept alive, because its end removes the visitor
        line->end();
    }
    void let_write(Visitor& visitor) {
        if (writer_ != nullptr) let_look_on(*writer_);
        writer_ = &visitor;
        visitor.line->awaits_greeting = true;
        name_tcp_sender("tcp " + visitor.address);
        tcp_port_->came("sender " + visitor.address, visitor.address, fmt::format("grbl-tcp-{}", ++connections_));
    }
    void let_look_on(Visitor& visitor) {
        visitor.line->awaits_greeting = false;
        visitor.line->write({std::make_shared<const std::string>(
            settings_.resets_stop_all
                ? "[MSG:Another sender has control. This one is an observer: only ? ! and resets are accepted]\r\n"
                : "[MSG:Another sender has control. This one is an observer: only ? and ! are accepted]\r\n")});
    }
    /// Removes a closed visitor. The place of a writer that never identified as a sender goes to the sender that has
    /// waited longest; the place of a sender stays free for its return.
    void gone(Visitor* visitor) {
        const bool gives_way = visitor == writer_ && !visitor->is_sender;
        if (visitor == writer_) {
            writer_ = nullptr;
            name_tcp_sender("");
            tcp_port_->left();
        }
        std::erase_if(visitors_, [&](const auto& one) { return one.get() == visitor; });
        const auto next =
            std::find_if(visitors_.begin(), visitors_.end(), [](const auto& one) { return one->is_sender; });
        if (gives_way && next != visitors_.end()) let_write(**next);
    }
    void broadcast(const PortMessage& said) {
        for (const auto& visitor : std::vector<std::shared_ptr<Visitor>>(visitors_))
            if (!visitor->line->write(said)) visitor->line->end();
    }
    void name_tcp_sender(std::string name) {
        const std::lock_guard<std::mutex> alone(lock_);
        tcp_sender_ = std::move(name);
    }

    // ---- pseudo-terminal
    Result<void> open_terminal() {
        auto made = PseudoTerminal::open(settings_.link);
        if (!made) return tl::unexpected<Error>(made.error());
        terminal_.emplace(std::move(*made));
        terminal_port_ = make_port([this](const PortMessage& said) {
            if (terminal_->clients() > 0) terminal_line_->write(said);  // drops output that does not fit
        });
        terminal_line_ = std::make_shared<TerminalLine>(
            asio::posix::stream_descriptor(*io_, terminal_->take_master().give()), settings_.waiting);
        terminal_line_->on_bytes = [this](std::string bytes) {
            look_for_clients();
            if (deaf_ && terminal_->clients() > 0) bytes.clear();
            terminal_port_->receive(std::move(bytes), true, settings_.link, reading_on(terminal_line_));
        };
        watch_.assign(::dup(terminal_->watch()));
        watch_on();
        terminal_line_->read_on();
        return {};
    }
    void watch_on() {
        watch_.async_wait(asio::posix::stream_descriptor::wait_read, [this](error_code trouble) {
            if (trouble) return;
            look_for_clients();
            watch_on();
        });
    }
    void look_for_clients() {
        const PseudoTerminal::ClientActivity seen = terminal_->poll_client();
        if (seen.left) {
            name_terminal_sender(false);
            terminal_port_->left();
            terminal_line_->awaits_greeting = true;
            deaf_ = true;
            timer_.expires_after(settling);
            timer_.async_wait([this](error_code trouble) {
                if (trouble) return;
                deaf_ = false;
                if (terminal_->clients() > 0) begin_client();
            });
        }
        if (seen.came && terminal_->clients() > 0 && !deaf_) begin_client();
    }
    void begin_client() {
        terminal_line_->awaits_greeting = true;
        terminal_line_->forget_waiting();
        terminal_->forget_unread();
        name_terminal_sender(true);
        terminal_port_->came("sender on " + settings_.link, settings_.link, fmt::format("grbl-pty-{}", ++connections_));
    }
    void name_terminal_sender(bool there) {
        const std::lock_guard<std::mutex> alone(lock_);
        terminal_sender_ = there;
    }

    const GrblPortSettings settings_;
    operate::Machine& machine_;
    auth::ControlLease& lease_;
    std::shared_ptr<asio::io_context> io_ = std::make_shared<asio::io_context>(1);
    tcp::acceptor acceptor_{*io_};
    asio::steady_timer pause_{*io_};
    asio::posix::stream_descriptor watch_{*io_};
    std::shared_ptr<SenderPort> tcp_port_, terminal_port_;
    std::vector<std::shared_ptr<Visitor>> visitors_;  ///< in order of connection
    Visitor* writer_ = nullptr;
    auth::RateLimit unknown_senders_{1, 1};
    /// A client's input may arrive shortly after it has disconnected. For this time after a disconnect, the next client
    /// is neither read nor greeted.
    static constexpr std::chrono::milliseconds settling{50};
    std::optional<PseudoTerminal> terminal_;
    asio::steady_timer timer_{*io_};
    bool deaf_ = false;
    std::shared_ptr<TerminalLine> terminal_line_;
    std::int64_t connections_ = 0;
    std::uint16_t port_number_ = 0;
    mutable std::mutex lock_;
    std::string tcp_sender_;
    bool terminal_sender_ = false;
    std::thread thread_;
};

GrblPorts::GrblPorts(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
GrblPorts::~GrblPorts() = default;

Result<std::unique_ptr<GrblPorts>> GrblPorts::open(const GrblPortSettings& settings, operate::Machine& machine,
                                                   auth::ControlLease& lease) {
    auto inside = std::make_unique<Inside>(settings, machine, lease);
    MOTIONRACK_CHECK(inside->open());
    return std::unique_ptr<GrblPorts>(new GrblPorts(std::move(inside)));
}

std::uint16_t GrblPorts::port() const {
    return inside_->port();
}
std::string GrblPorts::sender() const {
    return inside_->sender();
}

}  // namespace motionrack::server
