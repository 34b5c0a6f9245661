// `motionrack serve` as a separate process, with connections to it.
#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace motionrack {

/// One connection to a served rack.
class ServedLink {
  public:
    explicit ServedLink(int port = 0) {
        if (port != 0) connect(port);
    }
    ~ServedLink() { close(); }
    ServedLink(const ServedLink&) = delete;
    ServedLink& operator=(const ServedLink&) = delete;

    void close() {
        if (socket_ >= 0) ::close(std::exchange(socket_, -1));
    }
    bool send(const std::string& method, const std::string& name, const std::string& body) const {
        const std::string text =
            method + " /api/" + name + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port_) +
            (token.empty() ? "" : "\r\nAuthorization: Bearer " + token) +
            "\r\nContent-Type: application/json\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
        return ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
    }
    /// Returns the body of the next answer; discarded if the server has closed the connection.
    nlohmann::json answer() {
        std::string text;
        for (char c; text.size() < 4 || text.compare(text.size() - 4, 4, "\r\n\r\n") != 0; text += c)
            if (::recv(socket_, &c, 1, 0) != 1) return nlohmann::json(nlohmann::json::value_t::discarded);
        const std::size_t at = text.find("Content-Length: ");
        std::string body(at == std::string::npos ? 0 : std::stoul(text.substr(at + 16)), '\0');
        if (::recv(socket_, body.data(), body.size(), MSG_WAITALL) != static_cast<ssize_t>(body.size()))
            return nlohmann::json(nlohmann::json::value_t::discarded);
        if (text.find("Connection: close") != std::string::npos) {  // as after a STOP
            close();
            connect(port_);
        }
        return nlohmann::json::parse(body, nullptr, false);
    }
    nlohmann::json post(const std::string& name, const nlohmann::json& fields = nlohmann::json::object()) {
        return send("POST", name, fields.dump()) ? answer() : nlohmann::json(nlohmann::json::value_t::discarded);
    }
    /// Sends a query, as "card?name=motion".
    nlohmann::json get(const std::string& query) {
        return send("GET", query, "") ? answer() : nlohmann::json(nlohmann::json::value_t::discarded);
    }
    nlohmann::json status() {
        const nlohmann::json all = get("status");
        return all.is_object() ? all.value("status", nlohmann::json()) : nlohmann::json();
    }
    int port() const { return port_; }  ///< 0: not connected

    std::string token;  ///< of a pairing, sent with each request; empty: none

  protected:
    void connect(int port) {
        port_ = port;
        socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port_));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        const timeval half_a_minute{30, 0};
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &half_a_minute, sizeof half_a_minute);
        EXPECT_EQ(::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    }

  private:
    int socket_ = -1, port_ = 0;
};

/// `motionrack serve`, until it is killed.
class Served : public ServedLink {
  public:
    explicit Served(const std::vector<std::string>& arguments, bool must_start = true) {
        int ends[2];
        if (::pipe(ends) != 0) return;
        child_ = ::fork();
        if (child_ == 0) {
            ::dup2(ends[1], 1);
            ::dup2(ends[1], 2);
            ::close(ends[0]);
            ::close(ends[1]);
            std::vector<char*> words{const_cast<char*>(MOTIONRACK_PROGRAM), const_cast<char*>("serve")};
            for (const std::string& one : arguments) words.push_back(const_cast<char*>(one.c_str()));
            words.push_back(nullptr);
            ::execv(MOTIONRACK_PROGRAM, words.data());
            ::_exit(127);
        }
        ::close(ends[1]);
        output_ = ends[0];
        read_until("Ctrl-C");
        const std::size_t at = said.find("http://127.0.0.1:");
        const int port = at == std::string::npos ? 0 : std::stoi(said.substr(at + 17));
        if (port != 0 || must_start) connect(port);
    }
    ~Served() { end(SIGKILL); }
    Served(const Served&) = delete;
    Served& operator=(const Served&) = delete;

    /// Returns the exit code, or minus the signal.
    int end(int signal) {
        if (child_ <= 0) return 0;
        ::kill(child_, signal);
        int status = 0;
        ::waitpid(child_, &status, 0);
        child_ = 0;
        close();
        if (output_ >= 0) ::close(output_);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    /// Blocks its output by filling the pipe.
    void fill_output() const {
        const int in = ::open(("/proc/self/fd/" + std::to_string(output_)).c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
        const std::string block(4096, '.');
        while (::write(in, block.data(), block.size()) > 0) continue;
        while (::write(in, ".", 1) > 0) continue;
        ::close(in);
    }
    /// Closes the reading end of its output.
    void close_output() { ::close(std::exchange(output_, -1)); }
    pid_t process() const { return child_; }

    std::string said;

  private:
    void read_until(const std::string& word) {
        for (char c; said.find(word) == std::string::npos && ::read(output_, &c, 1) == 1;) said += c;
    }
    pid_t child_ = 0;
    int output_ = -1;
};

}  // namespace motionrack
